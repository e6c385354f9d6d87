#include "experiments/mitsuba/render_script.h"

namespace relight::mitsuba {

// The formula is that of common/brdf/phong.glsl; the lobe's samples below the horizon count as black, as ours
// do.
const std::string& render_script() {
  static const std::string script = R"python(#!/usr/bin/env python3
"""Renders the scene.xml beside this file with Mitsuba 3 and writes linear radiance as EXR."""
import argparse
import pathlib

import mitsuba as mi

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--spp", type=int, default=256, help="paths a pixel")
parser.add_argument("--seed", type=int, default=0)
parser.add_argument("--variant", default="llvm_ad_rgb", help="an RGB variant of Mitsuba: scalar_rgb needs no LLVM")
parser.add_argument("--out", default="mitsuba.exr")
arguments = parser.parse_args()
mi.set_variant(arguments.variant)

import drjit as dr  # noqa: E402  (Dr.Jit follows the variant)


class Phong(mi.BSDF):
    """diffuse/pi + glossy (n+2)/(2 pi) cos^n(alpha), the same on both sides of the surface; alpha is the angle
    between the outgoing direction and the mirror direction of the incoming one."""

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.diffuse = props.get_texture("diffuse")
        self.glossy = props.get_texture("glossy")
        self.exponent = props["exponent"]
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        self.m_components = [mi.BSDFFlags.GlossyReflection | sides, mi.BSDFFlags.DiffuseReflection | sides]
        self.m_flags = self.m_components[0] | self.m_components[1]

    def colours(self, si, active):
        """Both albedos, and the probability of sampling the glossy lobe."""
        diffuse, glossy = self.diffuse.eval(si, active), self.glossy.eval(si, active)
        total = dr.mean(diffuse) + dr.mean(glossy)
        return diffuse, glossy, dr.mean(glossy) / dr.maximum(total, 1e-20)

    @staticmethod
    def turned(wi, w):
        """w as seen from the side on which wi is."""
        return mi.Vector3f(w.x, w.y, dr.mulsign(w.z, wi.z))

    def lobe(self, wi, wo):
        """cos^n(alpha); wi and wo on the front."""
        c = dr.maximum(wi.z * wo.z - wi.x * wo.x - wi.y * wo.y, 0)
        return dr.power(c, self.exponent)

    def eval_pdf(self, ctx, si, wo, active=True):
        wi, wo = self.turned(si.wi, si.wi), self.turned(si.wi, wo)
        active &= (wi.z > 0) & (wo.z > 0)
        diffuse, glossy, share = self.colours(si, active)
        lobe = self.lobe(wi, wo) * dr.inv_two_pi
        value = (diffuse * dr.inv_pi + glossy * ((self.exponent + 2) * lobe)) * wo.z
        pdf = (1 - share) * wo.z * dr.inv_pi + share * (self.exponent + 1) * lobe
        return dr.select(active, value, 0), dr.select(active, pdf, 0)

    def eval(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[1]

    def sample(self, ctx, si, sample1, sample2, active=True):
        share = self.colours(si, active)[2]
        wi = self.turned(si.wi, si.wi)
        cosine = dr.power(sample2.x, 1 / (self.exponent + 1))
        sine, phi = dr.safe_sqrt(1 - cosine * cosine), dr.two_pi * sample2.y
        mirror = mi.Frame3f(mi.Vector3f(-wi.x, -wi.y, wi.z))
        glossy = mirror.to_world(mi.Vector3f(sine * dr.cos(phi), sine * dr.sin(phi), cosine))
        wo = dr.select(sample1 < share, glossy, mi.warp.square_to_cosine_hemisphere(sample2))
        bs = mi.BSDFSample3f()
        bs.wo = self.turned(si.wi, wo)
        value, bs.pdf = self.eval_pdf(ctx, si, bs.wo, active & (wo.z > 0))
        bs.eta = 1
        bs.sampled_component = dr.select(sample1 < share, mi.UInt32(0), mi.UInt32(1))
        bs.sampled_type = dr.select(sample1 < share, mi.UInt32(+mi.BSDFFlags.GlossyReflection),
                                    mi.UInt32(+mi.BSDFFlags.DiffuseReflection))
        return bs, value / dr.maximum(bs.pdf, 1e-20)

    def to_string(self):
        return f"relight_phong[exponent={self.exponent}]"


mi.register_bsdf("relight_phong", Phong)
scene = mi.load_file(str(pathlib.Path(__file__).resolve().parent / "scene.xml"))
image = mi.render(scene, spp=arguments.spp, seed=arguments.seed)
mi.Bitmap(image).write(arguments.out)
)python";
  return script;
}

}  // namespace relight::mitsuba
