#include "experiments/compare/result_bytes.h"

#include <cstring>

namespace relight {

namespace {

struct Head {
  int32_t width, height, samples_per_pixel, batches;
  int64_t rays, non_finite;
};
static_assert(sizeof(Head) == 32);
static_assert(sizeof(glm::vec3) == 12);

}  // namespace

std::vector<std::byte> to_bytes(const PathTracerResult& result) {
  const Head head{result.indirect.width, result.indirect.height, result.samples_per_pixel, result.batches,
                  result.rays,           result.non_finite};
  const size_t image_bytes = result.indirect.pixels.size() * sizeof(glm::vec3);
  std::vector<std::byte> bytes(sizeof(Head) + 3 * image_bytes);
  std::memcpy(bytes.data(), &head, sizeof(Head));
  std::byte* at = bytes.data() + sizeof(Head);
  for (const Image* image : {&result.direct, &result.indirect, &result.indirect_variance}) {
    std::memcpy(at, image->pixels.data(), image_bytes);
    at += image_bytes;
  }
  return bytes;
}

std::optional<PathTracerResult> result_from_bytes(const std::vector<std::byte>& bytes, int width,
                                                  int height) {
  const size_t image_bytes = static_cast<size_t>(width) * static_cast<size_t>(height) * sizeof(glm::vec3);
  if (bytes.size() != sizeof(Head) + 3 * image_bytes) return std::nullopt;
  Head head;
  std::memcpy(&head, bytes.data(), sizeof(Head));
  if (head.width != width || head.height != height) return std::nullopt;
  PathTracerResult result;
  result.samples_per_pixel = head.samples_per_pixel;
  result.batches = head.batches;
  result.rays = head.rays;
  result.non_finite = head.non_finite;
  const std::byte* at = bytes.data() + sizeof(Head);
  for (Image* image : {&result.direct, &result.indirect, &result.indirect_variance}) {
    *image = Image(width, height);
    std::memcpy(image->pixels.data(), at, image_bytes);
    at += image_bytes;
  }
  return result;
}

}  // namespace relight
