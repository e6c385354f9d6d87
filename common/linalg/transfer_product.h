// y = scale * (M x): the sparse matrix-vector product that carries light from wavelet lights to pixels (Hasan
// 2006 sections 3.5 and 5), behind one interface for all its forms. product_list.h makes them by name.
//
// M has one row a pixel of the view, row by row, and one column a wavelet light; scale is one RGB factor a
// row (k_d).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "common/linalg/sparse_rows.h"
#include "common/linalg/weight_format.h"

namespace relight {

namespace gpu {
class Buffer;
}

// The pixels that the matrix's rows are: row y * width + x. A matrix that is no picture is one of rows() x 1.
struct PictureShape {
  int width = 0, height = 0;
};

// Throws Error unless the shape has one pixel for each of `rows` rows.
void check_picture_shape(PictureShape shape, size_t rows);

// What sums are held in while blocks are blended (section 5: "buffers containing partial results are stored
// in 16 bpc"). Only the form `quads` has partial results outside of registers.
enum class PartialResults { float32, float16 };

struct ProductSettings {
  WeightFormat weights = WeightFormat::bits8;
  PartialResults partial_results = PartialResults::float32;
  // Transport-weighted culling of wavelet lights (section 3.5): a block is skipped if |light| x norm of the
  // block is at most cull_epsilon times the root of the sum over all lights of (|light| x norm of the
  // column)^2. That makes it independent of the lights' brightness and of the size of the picture. 0 skips
  // what gives nothing, a negative value skips nothing. Forms without blocks ignore it.
  float cull_epsilon = 0.0f;
  // Share of the picture's rows that the matrix has, the others being empty because nobody asked for them.
  // The lights' sum that culling compares with is extrapolated to all rows.
  double rows_share = 1.0;
  float block_waste = 0.65f;  // largest share of zeros in a rectangle before it is split (section 4.4; 0.65
                              // stores about half zeros)
  int atlas_size = 4096;      // texels a side (section 4.4)
};

// What a form stores and, for the last multiply, what it skipped.
struct ProductStatistics {
  int64_t bytes = 0;      // of everything stored for the product
  int64_t non_zeros = 0;  // entries of the matrix
  int64_t stored = 0;     // weights stored, the zeros that the form adds included
  int64_t blocks = 0;     // rectangles or shared column lists; 0 for a form by rows
  int64_t atlases = 0;
  double atlas_fill = 0.0;  // share of the atlases' texels that belong to blocks; 0 without atlases
  // Share of stored weights that are zeros of the form's own making.
  double waste() const {
    return stored == 0 ? 0.0 : 1.0 - static_cast<double>(non_zeros) / static_cast<double>(stored);
  }
};

struct CullStatistics {
  int64_t blocks = 0;   // skipped by the last multiply
  int64_t weights = 0;  // in those blocks
};

class TransferProduct {
 public:
  virtual ~TransferProduct() = default;
  // x: one vec4 a column, w ignored; y: one vec4 a row, w = 0. Throws Error on other lengths. Equal inputs
  // give equal bits.
  virtual void multiply(std::span<const glm::vec4> x, std::span<glm::vec4> y) const = 0;
  virtual ProductStatistics statistics() const = 0;
  // Of the last multiply; waits for the GPU. All 0 where the form doesn't cull.
  virtual CullStatistics culled() const { return {}; }
};

// A form that runs on the GPU: vectors are buffers there. The multiply on host memory copies them.
class TransferProductGpu : public TransferProduct {
 public:
  virtual void multiply(const gpu::Buffer& x, const gpu::Buffer& y) const = 0;
  void multiply(std::span<const glm::vec4> x, std::span<glm::vec4> y) const override;
};

// The row factors as the shaders take them, after checking that there is one a row and that the matrix can be
// stored (check_sparse_rows); Error otherwise.
gpu::Buffer padded_row_scale(const SparseRows& matrix, std::span<const glm::vec3> scale);

}  // namespace relight
