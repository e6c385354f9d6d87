#include "experiments/compare/image_files.h"

#include "common/image/exr.h"

namespace relight {

std::filesystem::path image_file(const std::filesystem::path& folder, const std::string& method,
                                 const std::string& what) {
  return folder / (method + "_" + what + ".exr");
}

Image difference(const Image& a, const Image& b) {
  Image result = a;
  for (size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] -= b.pixels[i];
  return result;
}

void write_run_images(const std::filesystem::path& folder, const std::string& method, const Relit& relit,
                      const PathTracerResult& reference, const std::map<std::string, std::string>& metadata) {
  const Image reference_total = reference.total();
  const auto write = [&](const char* what, const Image& image) {
    auto tagged = metadata;
    tagged["image"] = what;
    write_exr(image_file(folder, method, what), image, tagged);
  };
  write("direct", relit.direct);
  write("indirect", relit.indirect);
  write("total", relit.total);
  write("reference", reference_total);
  write("reference_direct", reference.direct);
  write("reference_indirect", reference.indirect);
  write("reference_variance", reference.indirect_variance);
  write("difference", difference(relit.total, reference_total));
  write("difference_indirect", difference(relit.indirect, reference.indirect));
}

}  // namespace relight
