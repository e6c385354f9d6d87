// Each broken file of the corpus with the message it must give: file, line, field, value, valid choices.
#include "common/scene/scene_file.h"
#include "tests/scene/corpus.h"

namespace relight {
namespace {

struct BrokenFile {
  const char* name;
  std::vector<std::string> parts;
};
void PrintTo(const BrokenFile& file, std::ostream* out) { *out << file.name; }

class BrokenFiles : public testing::TestWithParam<BrokenFile> {};

INSTANTIATE_TEST_SUITE_P(
    Meshes, BrokenFiles,
    testing::Values(
        BrokenFile{"bad_index.obj", {"bad_index.obj", "vertex index out of range"}},
        BrokenFile{"empty.obj", {"empty.obj", "too small"}},
        BrokenFile{"points_only.obj", {"points_only.obj", "no triangle"}},
        BrokenFile{"not_a_mesh.obj", {"not_a_mesh.obj", "no triangle"}},
        BrokenFile{"only_nan_coordinates.obj", {"only_nan_coordinates.obj", "no triangle is left"}},
        BrokenFile{"nan_material.obj", {"nan_material.obj", "'broken'", "diffuse", "nan", "finite"}},
        BrokenFile{"bad_index.ply", {"bad_index.ply", "face 0", "vertex index 7", "3 vertices"}},
        BrokenFile{"negative_index.ply", {"negative_index.ply", "face 0", "vertex index", "3 vertices"}},
        BrokenFile{"not_a_mesh.ply", {"not_a_mesh.ply", "magic number"}},
        BrokenFile{"header_without_end.ply", {"header_without_end.ply", "truncated", "end_header"}},
        BrokenFile{"truncated_vertices.ply",
                   {"truncated_vertices.ply", "truncated", "4 of element 'vertex'", "after 1"}},
        BrokenFile{"truncated_faces.ply",
                   {"truncated_faces.ply", "truncated", "2 of element 'face'", "after 1"}},
        BrokenFile{"not_a_mesh.glb", {"not_a_mesh.glb", "No suitable reader"}},
        BrokenFile{"truncated.glb", {"truncated.glb"}},
        BrokenFile{"truncated_buffer.glb", {"truncated_buffer.glb", "gltf"}},
        BrokenFile{"nowhere.obj", {"nowhere.obj", "no such mesh file"}},
        BrokenFile{"four_colours.png", {"four_colours.png", "cornell", ".toml", ".obj"}}));

INSTANTIATE_TEST_SUITE_P(
    SceneFiles, BrokenFiles,
    testing::Values(
        BrokenFile{"unknown_key.toml", {"unknown_key.toml:6", "camera.fov", "fov_y_degrees", "target"}},
        BrokenFile{"unknown_top_key.toml", {"unknown_top_key.toml:4", "cmaera", "camera", "lighting"}},
        BrokenFile{"wrong_type.toml", {"wrong_type.toml:5", "camera.eye", "left", "three numbers"}},
        BrokenFile{"wrong_element_type.toml",
                   {"wrong_element_type.toml:5", "camera.eye[2]", "far", "not a number"}},
        BrokenFile{"wrong_range.toml", {"wrong_range.toml:1", "exposure", "-1", "> 0"}},
        BrokenFile{"albedo_out_of_range.toml", {"albedo_out_of_range.toml:6", "diffuse[1]", "1.5", "<= 1"}},
        BrokenFile{"albedo_sum_above_one.toml",
                   {"albedo_sum_above_one.toml:4", "material[1]", "1.2", "<= 1"}},
        BrokenFile{"unknown_model.toml",
                   {"unknown_model.toml:6", "material[1].model", "blinn",
                    "phong, ashikhmin_shirley, lafortune, ggx"}},
        BrokenFile{"parameter_of_another_model.toml",
                   {"parameter_of_another_model.toml:7", "material[1].exponent", "'ggx'", "alpha_u"}},
        BrokenFile{"model_without_parameters.toml",
                   {"model_without_parameters.toml:4", "exponent_u and exponent_v"}},
        BrokenFile{"alpha_out_of_range.toml", {"alpha_out_of_range.toml:7", "alpha_u", "1e-05", ">= 0.001"}},
        BrokenFile{"four_lobes.toml", {"material[1].lobe", "4 lobes", "1 to 3"}},
        BrokenFile{"lobe_without_axis.toml", {"lobe_without_axis.toml:9", "lobe[1].c", "cz > 0"}},
        BrokenFile{"lobe_too_bright.toml", {"lobe_too_bright.toml:4", "lobes reflect most", "<= 1"}},
        BrokenFile{"unknown_material.toml", {"unknown_material.toml:5", "Granite", "DefaultMaterial"}},
        BrokenFile{"wrong_light_type.toml",
                   {"wrong_light_type.toml:5", "lighting.lamp[1].type", "candle", "omni, spot"}},
        BrokenFile{"spot_outer_below_inner.toml",
                   {"spot_outer_below_inner.toml:9", "inner_degrees", "30", "20"}},
        BrokenFile{"spot_without_axis.toml", {"spot_without_axis.toml:5", "direction or target"}},
        BrokenFile{"light_without_position.toml", {"light_without_position.toml:4", "position", "missing"}},
        BrokenFile{"negative_intensity.toml", {"negative_intensity.toml:7", "intensity[1]", "-2", ">= 0"}},
        BrokenFile{"not_toml.toml", {"not_toml.toml:1", "not valid TOML"}},
        BrokenFile{"missing_mesh.toml", {"missing_mesh.toml:2", "mesh[1].file", "nowhere.obj"}},
        BrokenFile{"mesh_is_a_picture.toml", {"mesh_is_a_picture.toml:2", "four_colours.png", ".obj, .gltf"}},
        BrokenFile{"mesh_not_an_array.toml", {"mesh_not_an_array.toml:1", "[[mesh]]"}},
        BrokenFile{"unset_variable.toml",
                   {"unset_variable.toml:2", "RELIGHT_VARIABLE_THAT_IS_NOT_SET", "not set"}},
        BrokenFile{"nothing_to_show.toml", {"nothing_to_show.toml", "[[mesh]]"}},
        BrokenFile{"unknown_base.toml", {"unknown_base.toml:1", "cathedral", "cornell, colonnade"}},
        BrokenFile{"missing_environment.toml",
                   {"missing_environment.toml:5", "environment.file", "nowhere.hdr"}},
        BrokenFile{"camera_without_direction.toml", {"camera_without_direction.toml:4", "eye and target"}},
        BrokenFile{"nowhere.toml", {"nowhere.toml", "no such file"}}));

// Red if a broken file crashes, is accepted, or its message loses the place or the valid choices.
TEST_P(BrokenFiles, AreRefusedWithAMessageThatSaysWhereAndWhat) {
  testing_corpus::expect_error([] { load_scene(testing_corpus::path(GetParam().name)); }, GetParam().parts);
}

// Red if a lighting file's typo is ignored.
TEST(BrokenLightingFiles, AreRefusedWithAMessageThatSaysWhereAndWhat) {
  const Scene scene = load_scene("cornell");
  const auto load = [&](const char* name) {
    return [&scene, name] { load_lighting(scene, testing_corpus::path(name)); };
  };
  testing_corpus::expect_error(load("lights_unknown_key.toml"),
                               {"lights_unknown_key.toml:5", "light[1].colour", "intensity"});
  testing_corpus::expect_error(load("lights_missing.toml"), {"lights_missing.toml", "'light' is missing"});
  testing_corpus::expect_error(load("nowhere.toml"), {"nowhere.toml", "no such file"});
  testing_corpus::expect_error([&] { load_lighting(scene, "dusk"); }, {"dusk", "near, omni, spot"});
}

struct Repaired {
  const char* name;
  std::map<std::string, int64_t> counts;
  size_t triangles;
};
void PrintTo(const Repaired& file, std::ostream* out) { *out << file.name; }

class RepairedFiles : public testing::TestWithParam<Repaired> {};
INSTANTIATE_TEST_SUITE_P(
    Meshes, RepairedFiles,
    testing::Values(Repaired{"truncated.obj", {{"points_and_lines_left_out", 1}}, 6},
                    Repaired{"nan_coordinate.obj", {{"non_finite_triangles_removed", 2}}, 12},
                    Repaired{"nan_vertex.ply", {{"non_finite_triangles_removed", 1}}, 1},
                    Repaired{"duplicates_and_slivers.obj",
                             {{"duplicate_triangles_removed", 2}, {"zero_area_triangles_removed", 2}},
                             1},
                    Repaired{"missing_texture.obj", {{"textures_missing", 1}}, 1},
                    Repaired{"bad_normals_and_uvs.obj",
                             {{"vertices_given_a_computed_normal", 2}, {"normals_brought_to_unit_length", 1}},
                             2},
                    Repaired{"wrong_materials.obj",
                             {{"clear_glass_triangles_left_out", 2},
                              {"materials_with_albedo_above_1_scaled", 2},
                              {"materials_with_negative_values_clamped", 1}},
                             6}));

// Red if a repair is not done, or done and not counted.
TEST_P(RepairedFiles, AreRepairedAndCounted) {
  const Scene scene = load_scene(testing_corpus::path(GetParam().name));
  EXPECT_EQ(scene.triangles.size(), GetParam().triangles);
  for (const auto& [what, expected] : GetParam().counts) {
    const auto found = scene.repairs.counts.find(what);
    ASSERT_NE(found, scene.repairs.counts.end()) << what << " is not counted\n" << describe_scene(scene);
    EXPECT_EQ(found->second, expected) << what;
    EXPECT_NE(describe_scene(scene).find(what), std::string::npos);
  }
  for (const glm::vec3& n : scene.normals) EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
}

// Red if a missing library or texture passes without a word.
TEST(IncompleteFiles, WarnNamingWhatIsMissing) {
  const auto warned = [](const char* file, const char* what) {
    for (const std::string& warning : load_scene(testing_corpus::path(file)).repairs.warnings)
      if (warning.find(what) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(warned("missing_library.obj", "nowhere.mtl"));
  EXPECT_TRUE(warned("missing_texture.obj", "nowhere.png"));
  EXPECT_TRUE(warned("wrong_materials.obj", "light passes straight through"));
  EXPECT_FALSE(warned("textured.obj", ""));
}

}  // namespace
}  // namespace relight
