#include "experiments/render/picture.h"

#include <algorithm>
#include <cmath>

#include "common/image/exr.h"
#include "common/run/error.h"
#include "experiments/session/output_folder.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

const Image& chosen_image(const Relit& relit, const std::string& name) {
  if (name == "direct") return relit.direct;
  return name == "indirect" ? relit.indirect : relit.total;
}

int64_t non_finite_pixels(const Image& image) {
  return std::count_if(image.pixels.begin(), image.pixels.end(), [](const glm::vec3& p) {
    return !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z);
  });
}

}  // namespace

void check_picture_options(const RenderOptions& options) {
  if (options.image != "direct" && options.image != "indirect" && options.image != "total") {
    usage_fail("--image '{}': valid: direct, indirect, total", options.image);
  }
  const std::filesystem::path out = options.out;
  if (out.extension() != ".exr" && out.extension() != ".png") {
    usage_fail("--out '{}': the name must end in .exr or .png", options.out);
  }
  require_writable_folder("--out", out.has_parent_path() ? out.parent_path() : ".");
}

void write_picture(const std::filesystem::path& file, const Relit& relit, const std::string& image,
                   float exposure, const std::map<std::string, std::string>& metadata) {
  const Image& chosen = chosen_image(relit, image);
  if (file.extension() == ".png") {
    write_png(file, chosen, exposure);
  } else {
    write_exr(file, chosen, metadata);
  }
  const int64_t bad = non_finite_pixels(chosen);
  if (bad > 0) fail("{}: {} pixels are not finite ('{}' was written)", image, bad, file.string());
}

}  // namespace relight
