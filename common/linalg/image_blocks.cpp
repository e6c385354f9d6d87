#include "common/linalg/image_blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <span>

#include "common/run/error.h"

namespace relight {
namespace {

struct Pixel {
  uint16_t x, y;
};

// A range of pixel coordinates along one axis, empty at first.
struct Interval {
  int lo = std::numeric_limits<int>::max(), hi = std::numeric_limits<int>::min();
  void add(int v) { lo = std::min(lo, v), hi = std::max(hi, v); }
  void add(const Interval& other) { lo = std::min(lo, other.lo), hi = std::max(hi, other.hi); }
  bool empty() const { return hi < lo; }
  int64_t length() const { return empty() ? 0 : int64_t{hi} - lo + 1; }
};

struct Split {
  int64_t area = std::numeric_limits<int64_t>::max();  // of the two rectangles together
  bool along_x = false;
  int last = 0;  // last coordinate of the first half
};

class ColumnCutter {
 public:
  ColumnCutter(uint32_t column, float block_waste, std::vector<ImageBlock>& out)
      : column_(column), block_waste_(block_waste), out_(out) {}

  void cut(std::span<Pixel> pixels) {
    Interval x, y;
    for (const Pixel& p : pixels) x.add(p.x), y.add(p.y);
    const auto area = static_cast<double>(x.length() * y.length());
    const auto zeros = area - static_cast<double>(pixels.size());
    if (zeros <= static_cast<double>(block_waste_) * area) {
      out_.push_back({column_, static_cast<uint16_t>(x.lo), static_cast<uint16_t>(y.lo),
                      static_cast<uint16_t>(x.length()), static_cast<uint16_t>(y.length())});
      return;
    }
    Split best;
    consider_splits(pixels, true, x, best);
    consider_splits(pixels, false, y, best);
    const auto middle = std::partition(pixels.begin(), pixels.end(), [&](const Pixel& p) {
      return (best.along_x ? p.x : p.y) <= best.last;
    });
    const auto first_half = static_cast<size_t>(middle - pixels.begin());
    cut(pixels.first(first_half));
    cut(pixels.subspan(first_half));
  }

 private:
  // Every position of a cut along one axis; the earlier of equally good ones wins.
  void consider_splits(std::span<const Pixel> pixels, bool along_x, const Interval& range, Split& best) {
    const auto n = static_cast<size_t>(range.length());
    across_.assign(n, {});
    for (const Pixel& p : pixels)
      across_[static_cast<size_t>((along_x ? p.x : p.y) - range.lo)].add(along_x ? p.y : p.x);
    // area_after_[i]: of the tightest rectangle around everything from coordinate i on.
    area_after_.assign(n + 1, 0);
    Interval along, over;
    for (size_t i = n; i-- > 0;) {
      if (!across_[i].empty()) along.add(static_cast<int>(i)), over.add(across_[i]);
      area_after_[i] = along.length() * over.length();
    }
    along = over = {};
    for (size_t i = 0; i + 1 < n; ++i) {
      if (!across_[i].empty()) along.add(static_cast<int>(i)), over.add(across_[i]);
      const int64_t area = along.length() * over.length() + area_after_[i + 1];
      if (area < best.area) best = {area, along_x, range.lo + static_cast<int>(i)};
    }
  }

  uint32_t column_;
  float block_waste_;
  std::vector<ImageBlock>& out_;
  std::vector<Interval> across_;
  std::vector<int64_t> area_after_;
};

}  // namespace

SparseRows transpose(const SparseRows& m) {
  SparseRows t;
  t.columns = static_cast<uint32_t>(m.rows());
  t.row_start.assign(size_t{m.columns} + 1, 0);
  for (const SparseEntry& e : m.entries) ++t.row_start[size_t{e.column} + 1];
  for (size_t c = 0; c < m.columns; ++c) t.row_start[c + 1] += t.row_start[c];
  t.entries.resize(m.entries.size());
  std::vector<uint64_t> next(t.row_start.begin(), t.row_start.end() - 1);
  for (size_t row = 0; row < m.rows(); ++row)
    for (const SparseEntry& e : m.row(row))
      t.entries[next[e.column]++] = {static_cast<uint32_t>(row), e.value};
  return t;
}

std::vector<ImageBlock> cut_into_blocks(const SparseRows& transposed, PictureShape shape, float block_waste) {
  check_picture_shape(shape, transposed.columns);
  if (shape.width > 65535 || shape.height > 65535)
    fail("transfer product: a picture of {} x {} pixels, at most 65535 a side", shape.width, shape.height);
  if (!(block_waste >= 0.0f && block_waste <= 1.0f)) fail("block_waste {}: expected 0 to 1", block_waste);
  std::vector<std::vector<ImageBlock>> of_column(transposed.rows());
  tbb::parallel_for(size_t{0}, transposed.rows(), [&](size_t column) {
    const auto entries = transposed.row(column);
    if (entries.empty()) return;
    std::vector<Pixel> pixels;
    for (const SparseEntry& e : entries)
      pixels.push_back({static_cast<uint16_t>(e.column % static_cast<uint32_t>(shape.width)),
                        static_cast<uint16_t>(e.column / static_cast<uint32_t>(shape.width))});
    ColumnCutter(static_cast<uint32_t>(column), block_waste, of_column[column]).cut(pixels);
  });
  std::vector<ImageBlock> blocks;
  for (const auto& list : of_column) blocks.insert(blocks.end(), list.begin(), list.end());
  return blocks;
}

void block_weights(const SparseRows& transposed, PictureShape shape, const ImageBlock& block,
                   std::vector<float>& out) {
  out.assign(static_cast<size_t>(block.area()), 0.0f);
  const auto column = transposed.row(block.column);
  for (uint32_t y = 0; y < block.height; ++y) {
    const uint32_t first = (block.y + y) * static_cast<uint32_t>(shape.width) + block.x;
    auto e = std::lower_bound(column.begin(), column.end(), first,
                              [](const SparseEntry& entry, uint32_t row) { return entry.column < row; });
    for (; e != column.end() && e->column < first + block.width; ++e)
      out[size_t{y} * block.width + (e->column - first)] = e->value;
  }
}

}  // namespace relight
