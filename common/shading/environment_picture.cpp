#include "common/shading/environment_picture.h"
#include "common/finite.h"

#include <cmath>
#include <stdexcept>

#include <tbb/parallel_for.h>

#include "common/shading/non_finite_report.h"

namespace relight {
EnvironmentPicture::EnvironmentPicture(const DeepFrameBuffer& buffer, Upsampling upsampling)
    : buffer_(buffer), sources_(indirect_sources(buffer, upsampling).of) {}

Image EnvironmentPicture::resolve(const Environment& environment, std::span<const glm::vec4> reflected,
                                  StageLog& log) const {
  const int width = buffer_.view.width, height = buffer_.view.height;
  std::vector<glm::vec3> subsamples(sources_.size(), glm::vec3(0.0f));
  tbb::parallel_for(0, 2 * height, [&](int y) {
    for (int x = 0; x < 2 * width; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(2 * width) + static_cast<size_t>(x);
      if (!buffer_.direct[i].valid) {
        const glm::vec3 direction = buffer_.eye_direction(x, y);
        if (direction != glm::vec3(0.0f)) subsamples[i] = environment.lookup(direction);
      } else if (sources_[i] < reflected.size()) {
        subsamples[i] = glm::vec3(reflected[sources_[i]]);
      }
    }
  });
  Image image = box_filter_2x2(subsamples, width, height);
  int64_t bad = 0;
  size_t first = 0;
  for (size_t i = image.pixels.size(); i-- > 0;) {
    if (finite(image.pixels[i])) continue;
    image.pixels[i] = glm::vec3(0.0f);
    ++bad, first = i;
  }
  if (bad > 0) report_non_finite_pixels("environment", bad, first, static_cast<size_t>(width), log);
  return image;
}

void add_image(const Image& from, Image& to) {
  if (from.pixels.size() != to.pixels.size()) throw std::logic_error("add_image: two sizes");
  for (size_t i = 0; i < to.pixels.size(); ++i) to.pixels[i] += from.pixels[i];
}

}  // namespace relight
