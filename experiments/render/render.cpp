#include "experiments/render/render.h"

#include <cmath>

#include "common/image/exr.h"
#include "experiments/compare/not_simulated.h"
#include "experiments/compare/run_method.h"
#include "experiments/session/output_folder.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

const Image& chosen_image(const Relit& relit, const std::string& name) {
  if (name == "direct") return relit.direct;
  return name == "indirect" ? relit.indirect : relit.total;
}

void check_output(const RenderOptions& options) {
  if (options.image != "direct" && options.image != "indirect" && options.image != "total") {
    usage_fail("--image '{}': valid: direct, indirect, total", options.image);
  }
  const std::filesystem::path out = options.out;
  if (out.extension() != ".exr" && out.extension() != ".png") {
    usage_fail("--out '{}': the name must end in .exr or .png", options.out);
  }
  require_writable_folder("--out", out.has_parent_path() ? out.parent_path() : ".");
}

int64_t non_finite_pixels(const Image& image) {
  int64_t count = 0;
  for (const glm::vec3& p : image.pixels) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) ++count;
  }
  return count;
}

}  // namespace

std::string render(const RenderOptions& options, const MethodList& methods) {
  const Method& method = find_method(methods, options.method);
  require_preset(options.preset, {&method});
  const MethodPlan plan = plan_method(method, parse_settings(options.settings, {&method}), options.preset);
  check_output(options);
  Session session(options.session, Session::Gpu::needed);
  const MethodRun run = run_method(plan, session, 1);
  if (!run.failure.empty()) fail("{} failed: {}", method.name(), run.failure);
  const Image& image = chosen_image(run.relit, options.image);
  const std::filesystem::path out = options.out;
  if (out.extension() == ".png") {
    write_png(out, image, session.scene().exposure);
  } else {
    write_exr(out, image, {{"relight.method", method.name()}, {"relight.image", options.image}});
  }
  const int64_t bad = non_finite_pixels(image);
  if (bad > 0)
    fail("{} of {}: {} pixels are not finite ('{}' was written)", options.image, method.name(), bad,
         options.out);
  return fmt::format(
      "{}: precompute {:.2f} s, relight {:.1f} ms, carries {}\nnot simulated: {}\nimage   {}\n",
      method.name(), run.precompute_s, run.relight_ms.front(), plan.paths.to_string(),
      fmt::join(not_simulated(plan.paths, session.scene()), "; "), options.out);
}

}  // namespace relight
