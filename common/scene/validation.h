// Checks and repairs a scene that came from files, so that everything after loading may rely on: finite
// positions, valid indices, triangles with area, unit normals, finite uvs, albedos (diffuse + glossy,
// textures included) within [0,1]. What was changed is counted in scene.repairs; what cannot be repaired is
// an Error.
#pragma once

#include "common/scene/scene.h"

namespace relight {

// The whole sequence below, in order. Throws Error if an index is out of range, a material value is not a
// number, or no triangle is left. Run finish_scene afterwards.
void repair_scene(Scene& scene);

// Out-of-range vertex, material, object or texture indices: Error naming the triangle.
void require_valid_indices(const Scene& scene);
// Removes triangles with a NaN or infinite corner, without area, and duplicates.
void remove_faulty_triangles(Scene& scene);
// Gives corners without a usable normal (zero, NaN, infinite) the angle-weighted mean of the triangles around
// the vertex whose normals are within `crease_degrees` of its own; brings other normals to unit length.
void repair_normals(Scene& scene, float crease_degrees = 45.0f);
// NaN and infinite uvs become (0, 0).
void repair_uvs(Scene& scene);
// Joins vertices that are equal in position, normal and uv, and drops vertices that no triangle uses.
void compact_vertices(Scene& scene);
// Clamps negative values to 0, and scales the diffuse albedo so that diffuse (times the brightest texel) +
// glossy <= 1.
void repair_materials(Scene& scene);
// Warns of a scene so far from the origin that floats blur it: rays start 32 units in the last place of the
// largest coordinate off their surface, and from a thousandth of the scene's size on that shows (tests:
// Invariance).
void warn_of_far_origin(Scene& scene);

}  // namespace relight
