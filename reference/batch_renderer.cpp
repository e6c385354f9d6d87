#include "reference/batch_renderer.h"

#include <cmath>

#include <tbb/parallel_for.h>

namespace relight {

namespace {

constexpr int side = 4;  // of a tile
// Keep the reference's numbers apart from all others, and tiles' from pixels'.
constexpr uint64_t pixel_stream = 0x7265666572656e63, tile_stream = 0x74696c6573746172;

}  // namespace

// Pixels x0 .. x0+3, y0 .. y0+3; those outside the image stay invalid.
struct BatchRenderer::Tile {
  int x0, y0;
  EyeTile eye[4];  // by sub-pixel: visible points of the 16 pixels
  glm::dvec3 sum[16];
  uint64_t scramble[16];

  Tile(int left, int top, const BatchRenderer& renderer) : x0(left), y0(top) {
    const View& view = renderer.buffer_.view;
    for (int i = 0; i < 16; ++i) {
      const int x = x0 + i % side, y = y0 + i / side;
      if (x >= view.width || y >= view.height) continue;
      for (int sub = 0; sub < 4; ++sub) {
        const size_t row = static_cast<size_t>(2 * y + sub / 2),
                     column = static_cast<size_t>(2 * x + sub % 2);
        const SurfaceSample& x1 = renderer.buffer_.direct[row * 2 * static_cast<size_t>(view.width) + column];
        if (!x1.valid) continue;
        eye[sub].valid |= 1u << i;
        eye[sub].vertex[i] = renderer.sampler_.eye_vertex(x1, view.camera.eye);
        eye[sub].position[i] = renderer.tracer_.offset_point(x1.position, x1.geometric_normal);
      }
    }
  }
};

BatchRenderer::BatchRenderer(const PathSampler& sampler, const RayTracer& tracer,
                             const DeepFrameBuffer& buffer, const PathTracerSettings& settings,
                             int samples_per_batch)
    : sampler_(sampler),
      tracer_(tracer),
      buffer_(buffer),
      settings_(settings),
      samples_(samples_per_batch),
      pixels_(buffer.indirect.size()) {}

int BatchRenderer::tasks() const { return (buffer_.view.height + side - 1) / side; }

void BatchRenderer::render(int batch, Progress& progress) {
  // One row of tiles a task and no grouping of rows, so that progress moves and the last rows balance.
  tbb::parallel_for(
      tbb::blocked_range<int>(0, tasks(), 1),
      [&](const tbb::blocked_range<int>& rows) {
        for (int row = rows.begin(); row < rows.end(); ++row) {
          render_row(row, batch);
          progress.advance();
        }
      },
      tbb::simple_partitioner());
}

void BatchRenderer::render_row(int row, int batch) {
  Counts counts;
  for (int x0 = 0; x0 < buffer_.view.width; x0 += side) {
    Tile tile(x0, row * side, *this);
    render_tile(tile, batch, counts);
  }
  rays_ += counts.rays;
  non_finite_ += counts.non_finite;
}

// All sub-pixels of a pixel share one Sobol sequence, so that the pixel as a whole is stratified; a random
// rotation makes batches of fewer than four samples visit every sub-pixel with the same probability.
void BatchRenderer::render_tile(Tile& tile, int batch, Counts& counts) {
  const auto width = static_cast<uint64_t>(buffer_.view.width);
  const uint64_t sequence = settings_.one_sequence ? 0 : static_cast<uint64_t>(batch);
  const auto number = [&](int x, int y) {
    return static_cast<uint64_t>(y) * width + static_cast<uint64_t>(x);
  };
  for (int i = 0; i < 16; ++i) {
    tile.sum[i] = glm::dvec3(0.0);
    tile.scramble[i] =
        random_bits(settings_.seed, pixel_stream, number(tile.x0 + i % side, tile.y0 + i / side), sequence);
  }
  const uint64_t scramble = random_bits(settings_.seed, tile_stream, number(tile.x0, tile.y0), sequence);
  const uint32_t count = static_cast<uint32_t>(samples_);
  const uint32_t first = settings_.one_sequence ? static_cast<uint32_t>(batch) * count : 0u;
  for (uint32_t s = first; s < first + count; ++s) sample_tile(tile, scramble, s, counts);

  for (int i = 0; i < 16; ++i) {
    const int x = tile.x0 + i % side, y = tile.y0 + i / side;
    if (x < buffer_.view.width && y < buffer_.view.height)
      pixels_[number(x, y)].add(tile.sum[i] / static_cast<double>(samples_), batch + 1);
  }
}

void BatchRenderer::sample_tile(Tile& tile, uint64_t scramble, uint32_t index, Counts& counts) const {
  const EyeTile& eye = tile.eye[(index + static_cast<uint32_t>(scramble >> 62)) & 3u];
  if (eye.valid == 0) return;
  constexpr int connections = PathSampler::connections_at_eye;
  glm::vec3 value[16] = {};
  LightVertex light;
  if (sampler_.uses_light_vertices()) {
    const uint32_t first = index * static_cast<uint32_t>(connections);
    light = sampler_.connector().trace({scramble, first}, counts.rays);
    for (int c = 0; sampler_.connects_at_eye() && c < connections; ++c) {
      const LightVertex y =
          c == 0 ? light
                 : sampler_.connector().trace({scramble, first + static_cast<uint32_t>(c)}, counts.rays);
      if (y.surface.valid) sampler_.connector().connect(eye, y, connections, value, counts.rays);
    }
  }
  for (int i = 0; i < 16; ++i) {
    if (!((eye.valid >> i) & 1u)) continue;
    value[i] += sampler_.sample(eye.vertex[i], light, {tile.scramble[i], index}, counts.rays);
    if (std::isfinite(value[i].x + value[i].y + value[i].z)) {
      tile.sum[i] += glm::dvec3(value[i]);
    } else {
      ++counts.non_finite;
    }
  }
}

}  // namespace relight
