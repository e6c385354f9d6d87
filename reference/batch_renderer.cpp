#include "reference/batch_renderer.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace relight {

namespace {

constexpr int side = 4;  // of a tile
// Keep the reference's numbers apart from all others, and tiles' from pixels'.
constexpr uint64_t pixel_stream = 0x7265666572656e63, tile_stream = 0x74696c6573746172;
// The number of the sequence that planning uses; batches count from 0.
constexpr uint64_t planning = ~0ull;
// More would let a few tiles with rare bright samples take most of the time.
constexpr int most_paths = 16;

// One row a task and no grouping of rows, so that progress moves and the last rows balance.
template <typename Function>
void for_each_row(int rows, Function function) {
  tbb::parallel_for(
      tbb::blocked_range<int>(0, rows, 1),
      [&](const tbb::blocked_range<int>& range) {
        for (int row = range.begin(); row < range.end(); ++row) function(row);
      },
      tbb::simple_partitioner());
}

}  // namespace

// Pixels x0 .. x0+3, y0 .. y0+3; those outside the image stay invalid.
struct BatchRenderer::Tile {
  int x0 = 0, y0 = 0;
  int paths = 1;
  uint64_t scramble = 0, pixel_scramble[16];
  EyeTile eye[4];                 // by sub-pixel: visible points of the 16 pixels
  uint32_t made = 0;              // bit i: eye[i] has been made
  std::vector<glm::dvec3> sum;    // of each class, pixel by pixel
  std::vector<glm::vec3> values;  // scratch: one sample of the same
  double squares = 0.0;           // of the mean channel, over all pixels
};

BatchRenderer::BatchRenderer(const PathSampler& sampler, const RayTracer& tracer,
                             const DeepFrameBuffer& buffer, const PathTracerSettings& settings,
                             int samples_per_batch)
    : sampler_(sampler),
      tracer_(tracer),
      buffer_(buffer),
      settings_(settings),
      samples_(samples_per_batch),
      tiles_x_((buffer.view.width + side - 1) / side),
      tiles_y_((buffer.view.height + side - 1) / side) {
  state_.paths.assign(static_cast<size_t>(tiles_x_) * static_cast<size_t>(tiles_y_), 1);
  state_.pixels.resize(buffer.indirect.size());
  if (sampler.classes().told_apart())
    state_.layers.resize(buffer.indirect.size() * sampler.classes().count());
}

int BatchRenderer::tasks() const { return tiles_y_; }

int& BatchRenderer::paths_of(int x0, int y0) {
  return state_
      .paths[static_cast<size_t>(y0 / side) * static_cast<size_t>(tiles_x_) + static_cast<size_t>(x0 / side)];
}

BatchRenderer::Tile BatchRenderer::make_tile(int x0, int y0, uint64_t sequence, int paths) const {
  const View& view = buffer_.view;
  const auto number = [&](int x, int y) {
    return static_cast<uint64_t>(y) * static_cast<uint64_t>(view.width) + static_cast<uint64_t>(x);
  };
  Tile tile;
  tile.x0 = x0, tile.y0 = y0, tile.paths = paths;
  tile.sum.assign(16 * sampler_.classes().count(), glm::dvec3(0.0));
  tile.values.resize(tile.sum.size());
  tile.scramble = random_bits(settings_.seed, tile_stream, number(x0, y0), sequence);
  for (int i = 0; i < 16; ++i)
    tile.pixel_scramble[i] =
        random_bits(settings_.seed, pixel_stream, number(x0 + i % side, y0 + i / side), sequence);
  return tile;
}

// Visible points of one sub-pixel, made when the first sample wants them: a batch of few samples doesn't
// visit all.
const EyeTile& BatchRenderer::eye_tile(Tile& tile, uint32_t sub) const {
  const View& view = buffer_.view;
  EyeTile& eye = tile.eye[sub];
  if ((tile.made >> sub) & 1u) return eye;
  tile.made |= 1u << sub;
  eye.paths = static_cast<float>(tile.paths);
  for (uint32_t i = 0; i < 16; ++i) {
    const int x = tile.x0 + static_cast<int>(i) % side, y = tile.y0 + static_cast<int>(i) / side;
    if (x >= view.width || y >= view.height) continue;
    const size_t row = static_cast<size_t>(2 * y) + sub / 2, column = static_cast<size_t>(2 * x) + sub % 2;
    const SurfaceSample& x1 = buffer_.direct[row * 2 * static_cast<size_t>(view.width) + column];
    if (x1.valid)
      eye.set(i, sampler_.eye_vertex(x1, view.camera.eye),
              tracer_.offset_point(x1.position, x1.geometric_normal));
  }
  return eye;
}

void BatchRenderer::plan(int samples) {
  std::vector<double> deviation(state_.paths.size());
  std::atomic<int64_t> rays{0};
  for_each_row(tiles_y_, [&](int row) {
    Counts counts;
    for (int column = 0; column < tiles_x_; ++column) {
      Tile tile = make_tile(column * side, row * side, planning, 1);
      for (int s = 0; s < samples; ++s) sample_tile(tile, static_cast<uint32_t>(s), counts);
      double variance = tile.squares / samples;
      const size_t classes = sampler_.classes().count();
      for (size_t pixel = 0; pixel < 16; ++pixel) {
        glm::dvec3 sum(0.0);
        for (size_t c = 0; c < classes; ++c) sum += tile.sum[pixel * classes + c];
        variance -= std::pow((sum.x + sum.y + sum.z) / (3.0 * samples), 2);
      }
      deviation[static_cast<size_t>(row * tiles_x_ + column)] = std::sqrt(std::max(0.0, variance));
    }
    rays += counts.rays;
  });
  state_.rays += rays;
  double mean = 0.0;
  for (double d : deviation) mean += d / static_cast<double>(deviation.size());
  if (!(mean > 0.0)) return;
  for (size_t i = 0; i < state_.paths.size(); ++i)
    state_.paths[i] = std::clamp(static_cast<int>(std::lround(deviation[i] / mean)), 1, most_paths);
}

void BatchRenderer::render(Progress& progress) {
  rays_ = non_finite_ = 0;
  for_each_row(tiles_y_, [&](int row) {
    render_row(row, state_.batches);
    progress.advance();
  });
  ++state_.batches;
  state_.rays += rays_;
  state_.non_finite += non_finite_;
}

void BatchRenderer::render_row(int row, int batch) {
  Counts counts;
  for (int x0 = 0; x0 < buffer_.view.width; x0 += side) render_tile(x0, row * side, batch, counts);
  rays_ += counts.rays;
  non_finite_ += counts.non_finite;
}

void BatchRenderer::render_tile(int x0, int y0, int batch, Counts& counts) {
  Tile tile = make_tile(x0, y0, settings_.one_sequence ? 0 : static_cast<uint64_t>(batch), paths_of(x0, y0));
  const uint32_t count = static_cast<uint32_t>(samples_);
  const uint32_t first = settings_.one_sequence ? static_cast<uint32_t>(batch) * count : 0u;
  for (uint32_t s = first; s < first + count; ++s) sample_tile(tile, s, counts);

  for (int i = 0; i < 16; ++i) {
    const int x = x0 + i % side, y = y0 + i / side;
    if (x >= buffer_.view.width || y >= buffer_.view.height) continue;
    const size_t pixel =
        static_cast<size_t>(y) * static_cast<size_t>(buffer_.view.width) + static_cast<size_t>(x);
    const size_t classes = sampler_.classes().count();
    glm::dvec3 total(0.0);
    for (size_t c = 0; c < classes; ++c) {
      const glm::dvec3 mean = tile.sum[static_cast<size_t>(i) * classes + c] / static_cast<double>(samples_);
      if (!state_.layers.empty()) state_.layers[pixel * classes + c].add(mean, batch + 1);
      if (sampler_.classes().selected(c)) total += mean;
    }
    state_.pixels[pixel].add(total, batch + 1);
  }
}

// All sub-pixels of a pixel share one Sobol sequence, so that the pixel as a whole is stratified; a random
// rotation makes batches of fewer than four samples visit every sub-pixel with the same probability.
void BatchRenderer::sample_tile(Tile& tile, uint32_t index, Counts& counts) const {
  const EyeTile& eye = eye_tile(tile, (index + static_cast<uint32_t>(tile.scramble >> 62)) & 3u);
  if (eye.valid == 0) return;
  constexpr uint32_t connections = PathSampler::connections_at_eye;
  const LightConnector& connector = sampler_.connector();
  std::fill(tile.values.begin(), tile.values.end(), glm::vec3(0.0f));
  LightVertex light[connections];
  if (sampler_.uses_light_vertices()) {
    const size_t vertices = sampler_.connects_at_eye() ? connections : 1;
    connector.trace({tile.scramble, index * connections}, {light, vertices}, counts.rays);
    for (size_t c = 0; sampler_.connects_at_eye() && c < connections; ++c)
      if (light[c].surface.valid)
        connector.connect(eye, light[c], connections, sampler_.classes(), tile.values.data(), counts.rays);
  }
  // Connections count once for each set of paths, paths by their number.
  const float paths = static_cast<float>(tile.paths);
  for (glm::vec3& value : tile.values) value *= paths;
  const uint32_t first = index * static_cast<uint32_t>(tile.paths);
  for (uint32_t p = 0; p < static_cast<uint32_t>(tile.paths); ++p)
    sampler_.sample(eye, light[0], tile.pixel_scramble, first + p, tile.values.data(), counts.rays);
  for (glm::vec3& value : tile.values) value /= paths;
  const size_t classes = sampler_.classes().count();
  for (uint32_t i = 0; i < 16; ++i)
    if (((eye.valid >> i) & 1u) && !add_sample(tile, static_cast<int>(i), tile.values.data() + i * classes))
      ++counts.non_finite;
}

// False, and nothing is added, if a value is not finite.
bool BatchRenderer::add_sample(Tile& tile, int pixel, const glm::vec3* values) const {
  const size_t classes = sampler_.classes().count();
  glm::dvec3 total(0.0);
  for (size_t c = 0; c < classes; ++c) total += glm::dvec3(values[c]);
  if (!std::isfinite(total.x + total.y + total.z)) return false;
  for (size_t c = 0; c < classes; ++c)
    tile.sum[static_cast<size_t>(pixel) * classes + c] += glm::dvec3(values[c]);
  tile.squares += std::pow((total.x + total.y + total.z) / 3.0, 2);
  return true;
}

}  // namespace relight
