#include "common/gpu/shader_source.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/gpu/program.h"
#include "common/gpu/shader_log.h"
#include "tests/gpu/contexts.h"

namespace relight {
namespace {

namespace fs = std::filesystem;

// A folder of shader files that is the whole source tree for its lifetime.
class TemporaryShaders {
 public:
  TemporaryShaders()
      : folder_(fs::temp_directory_path() / ("relight_shaders_" + std::to_string(::getpid()))),
        dir_(folder_.string()) {
    fs::create_directories(folder_);
  }
  ~TemporaryShaders() { fs::remove_all(folder_); }
  void write(const std::string& path, const std::string& text) {
    fs::create_directories((folder_ / path).parent_path());
    std::ofstream(folder_ / path) << text;
  }

 private:
  fs::path folder_;
  test::ShaderDir dir_;
};

template <typename F>
std::string error_of(F f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in:\n" << text;
}

// Red if line numbers after an #include are off by one, or the file of an included line is wrong.
TEST(ShaderErrors, NameFileLineAndSourceLine) {
  TemporaryShaders shaders;
  shaders.write("a/main.glsl",
                "#include \"a/helper.glsl\"\nlayout(local_size_x = 1) in;\n"
                "void main() {\n  broken_main = 1;\n}\n");
  shaders.write("a/helper.glsl", "float helper() { return 1.0; }\n");
  const auto context = gpu::Context::create("osmesa");
  const std::string in_main = error_of([] { gpu::Program::compute("a/main.glsl"); });
  expect_contains(in_main, "a/main.glsl:4:");
  expect_contains(in_main, "\n      broken_main = 1;\n");
  shaders.write("a/main.glsl",
                "#include \"a/helper.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() { helper(); }\n");
  shaders.write("a/helper.glsl", "\n\nfloat helper() { return broken_helper; }\n");
  const std::string in_helper = error_of([] { gpu::Program::compute("a/main.glsl"); });
  expect_contains(in_helper, "a/helper.glsl:3:");
  expect_contains(in_helper, "return broken_helper;");
  EXPECT_EQ(in_helper.find("main.glsl:"), std::string::npos) << in_helper;
}

// Red if a driver's log format is not understood.
TEST(ShaderErrors, UnderstandTheFormatsOfSeveralDrivers) {
  const gpu::ShaderSource source{
      "#version 450 core\nfirst\nsecond\nother\n", {"x.glsl", "y.glsl"}, {{-1, 0}, {0, 7}, {0, 8}, {1, 1}}};
  EXPECT_EQ(gpu::explain_shader_log("0:3(7): error: e", source), "x.glsl:8: error: e\n    second\n");
  EXPECT_EQ(gpu::explain_shader_log("0(4) : error C1: e", source), "y.glsl:1: error C1: e\n    other\n");
  EXPECT_EQ(gpu::explain_shader_log("ERROR: 0:2: e", source), "x.glsl:7: e\n    first\n");
  EXPECT_EQ(gpu::explain_shader_log("0:1(1): error: e", source), "0:1(1): error: e\n");
  EXPECT_EQ(gpu::explain_shader_log("something else", source), "something else\n");
}

// Red if a cycle recurses for ever or a file is pasted twice.
TEST(ShaderSource, IncludeCyclesEndAndEachFileIsTakenOnce) {
  TemporaryShaders shaders;
  shaders.write("a.glsl", "#include \"b.glsl\"\n#include \"b.glsl\"\nint a;\n");
  shaders.write("b.glsl", "#include \"a.glsl\"\nint b;\n");
  const gpu::ShaderSource source = gpu::load_shader("a.glsl");
  EXPECT_EQ(source.files, (std::vector<std::string>{"a.glsl", "b.glsl"}));
  EXPECT_EQ(source.text.find("int b;"), source.text.rfind("int b;"));
}

// Red if a missing include is reported without the place that asked for it.
TEST(ShaderSource, UnknownIncludesNameTheFileAndLineThatAsked) {
  TemporaryShaders shaders;
  shaders.write("a.glsl", "int a;\n#include \"missing.glsl\"\n");
  const std::string error = error_of([] { gpu::load_shader("a.glsl"); });
  expect_contains(error, "a.glsl:2:");
  expect_contains(error, "missing.glsl");
}

// Red if a malformed #include reaches the driver or is dropped.
TEST(ShaderSource, IncludesWithoutAQuotedPathAreRefused) {
  TemporaryShaders shaders;
  shaders.write("a.glsl", "  # include <b.glsl>\n");
  expect_contains(error_of([] { gpu::load_shader("a.glsl"); }), "a.glsl:1: #include needs a quoted path");
}

// Red if the table of embedded shaders is empty or the message does not list it.
TEST(ShaderSource, UnknownPathsListTheKnownOnes) {
  const std::string error = error_of([] { gpu::load_shader("common/no_such.glsl"); });
  expect_contains(error, "common/no_such.glsl");
  expect_contains(error, "common/brdf/brdf.glsl");
  expect_contains(error, "common/lights/light_models.glsl");
}

// Red if the embedded text differs from the file (semicolons and brackets are special to CMake lists).
TEST(ShaderSource, EmbeddedTextEqualsTheFile) {
  ASSERT_GT(gpu::embedded_shader_count, 0);
  for (int i = 0; i < gpu::embedded_shader_count; ++i) {
    std::ifstream file(fs::path(RELIGHT_SOURCE_DIR) / gpu::embedded_shaders[i].path);
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_EQ(text.str(), gpu::embedded_shaders[i].text) << gpu::embedded_shaders[i].path;
  }
}

// Red if a define is lost or comes after the code.
TEST(ShaderSource, DefinesComeBeforeTheCode) {
  TemporaryShaders shaders;
  shaders.write("a.glsl", "int x = WIDTH;\n");
  const std::string text = gpu::load_shader("a.glsl", {"WIDTH 7"}).text;
  EXPECT_EQ(text.rfind("#version 450 core\n", 0), 0u);
  EXPECT_LT(text.find("#define WIDTH 7\n"), text.find("int x"));
}

}  // namespace
}  // namespace relight
