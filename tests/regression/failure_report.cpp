#include "failure_report.h"

#include <fmt/format.h>

#include "common/image/exr.h"
#include "common/image/false_colour.h"
#include "common/run/atomic_file.h"

namespace relight::test {

namespace {

Image sum(const Image& a, const Image& b) {
  Image result = a;
  for (size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] += b.pixels[i];
  return result;
}

Image difference(const Image& a, const Image& b) {
  Image result = a;
  for (size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] -= b.pixels[i];
  return result;
}

void write_both(const std::filesystem::path& folder, const std::string& name, const Image& image,
                float exposure) {
  write_exr(folder / (name + ".exr"), image);
  write_png(folder / (name + ".png"), image, exposure);
}

}  // namespace

std::string report_failure(const std::filesystem::path& folder, const std::string& name,
                           const PictureStatistics& fresh, const PictureStatistics& stored,
                           const Decision& decision, float exposure) {
  const Image now = sum(fresh.direct, fresh.pixels.mean), before = sum(stored.direct, stored.pixels.mean);
  write_both(folder, "fresh", now, exposure);
  write_both(folder, "reference", before, exposure);
  write_exr(folder / "difference.exr", difference(now, before));
  const double scale = difference_scale(now, before);
  write_png(folder / "difference.png", difference_image(now, before, scale > 0.0 ? scale : 1.0), 1.0f);
  write_exr(folder / "difference_in_sigmas.exr", difference_in_sigmas(fresh, stored));
  write_text_atomically(folder / "p_values.txt", decision.to_string());
  return fmt::format(
      "'{}' differs from its stored reference (each p-value must be at least {:.2g}):\n{}images and "
      "p-values: {}\n"
      "if the new picture is right, accept it from the source folder with\n  relight references update {}\n",
      name, decision.level, decision.to_string(), folder.string(), name);
}

}  // namespace relight::test
