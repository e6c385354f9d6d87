#include "experiments/stored_references/files.h"

#include <algorithm>
#include <bit>
#include <fstream>

#include "common/image/exr.h"
#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "common/run/provenance.h"

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

constexpr int float_mantissa = 23, mean_mantissa = 16, variance_mantissa = 8;

// To the nearest float with `bits` bits of mantissa: zeros at the end compress well. A carry out of the
// mantissa raises the exponent, which is the right rounding.
float rounded(float value, int bits) {
  const int dropped = float_mantissa - bits;
  const uint32_t half = 1u << (dropped - 1), mask = ~((1u << dropped) - 1u);
  return std::bit_cast<float>((std::bit_cast<uint32_t>(value) + half) & mask);
}

Image rounded(Image image, int bits) {
  for (glm::vec3& p : image.pixels) p = {rounded(p.x, bits), rounded(p.y, bits), rounded(p.z, bits)};
  return image;
}

Json triple(const glm::vec3& v) { return Json::array({v.x, v.y, v.z}); }

glm::vec3 vector_of(const Json& json) {
  return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

Json result_json(const PictureStatistics& picture) {
  return {{"relative_standard_error", picture.relative_standard_error()},
          {"samples_per_pixel", picture.samples_per_pixel},
          {"batches", picture.batches},
          {"rays", picture.rays},
          {"non_finite", picture.non_finite},
          {"fireflies", picture.fireflies},
          {"seconds", picture.seconds},
          {"mean_of_indirect", triple(picture.whole.mean.pixels[0])},
          {"variance_of_that_mean", triple(picture.whole.variance.pixels[0])}};
}

Json provenance_json() {
  const Provenance p = collect_provenance("", "");
  return {
      {"commit", p.commit + (p.dirty ? " with changes" : "")}, {"compiler", p.compiler}, {"date", p.date}};
}

Image read_sized(const std::filesystem::path& file, int width, int height) {
  Image image = read_exr(file);
  if (image.width != width || image.height != height)
    fail("'{}' has {}x{} pixels; expected are {}x{}", file.string(), image.width, image.height, width,
         height);
  return image;
}

Json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) fail("cannot read '{}': make it with `relight references update`", file.string());
  return Json::parse(in);
}

// A folder put together from files of different runs must not pass for a reference.
void require_same_run(const std::filesystem::path& folder, const PictureStatistics& picture) {
  const glm::vec3 of_file =
      block_means(picture.pixels.mean, std::max(picture.direct.width, picture.direct.height)).pixels[0];
  const glm::vec3 of_json = picture.whole.mean.pixels[0];
  if (glm::length(of_file - of_json) > 1e-4f * glm::length(of_json))
    fail(
        "'{}': the mean of indirect.exr is not that of reference.json; make both with `relight references "
        "update`",
        folder.string());
}

PictureStatistics picture_of(const std::filesystem::path& folder, const Json& result) {
  PictureStatistics picture;
  picture.direct = read_exr(folder / "direct.exr");
  const int width = picture.direct.width, height = picture.direct.height;
  const int columns = (width + tile_side - 1) / tile_side, rows = (height + tile_side - 1) / tile_side;
  picture.pixels.mean = read_sized(folder / "indirect.exr", width, height);
  picture.pixels.variance = read_sized(folder / "variance.exr", width, height);
  picture.tiles.mean = block_means(picture.pixels.mean, tile_side);
  picture.tiles.variance = read_sized(folder / "tile_variance.exr", columns, rows);
  picture.whole.mean = Image(1, 1, vector_of(result.at("mean_of_indirect")));
  picture.whole.variance = Image(1, 1, vector_of(result.at("variance_of_that_mean")));
  picture.batches = result.at("batches").get<int>();
  picture.samples_per_pixel = result.at("samples_per_pixel").get<int>();
  picture.non_finite = result.at("non_finite").get<int64_t>();
  picture.fireflies = result.at("fireflies").get<int64_t>();
  picture.rays = result.at("rays").get<int64_t>();
  picture.seconds = result.at("seconds").get<double>();
  require_same_run(folder, picture);
  return picture;
}

}  // namespace

void save_stored(const std::filesystem::path& folder, const PictureStatistics& picture,
                 const Json& identity) {
  std::filesystem::remove(folder / "reference.json");
  write_exr(folder / "direct.exr", rounded(picture.direct, mean_mantissa));
  write_exr(folder / "indirect.exr", rounded(picture.pixels.mean, mean_mantissa));
  write_exr(folder / "variance.exr", rounded(picture.pixels.variance, variance_mantissa));
  write_exr(folder / "tile_variance.exr", rounded(picture.tiles.variance, variance_mantissa));
  const Json json = {
      {"identity", identity}, {"result", result_json(picture)}, {"provenance", provenance_json()}};
  write_text_atomically(folder / "reference.json", json.dump(2) + "\n");
}

bool is_stored(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "reference.json");
}

StoredPicture load_stored(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "reference.json";
  try {
    const Json json = read_json(file);
    return {picture_of(folder, json.at("result")), json.at("identity"), json.at("provenance")};
  } catch (const Json::exception& error) {
    fail("'{}' is damaged: {}", file.string(), error.what());
  }
}

}  // namespace relight
