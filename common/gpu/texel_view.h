// A buffer read through texelFetch (samplerBuffer). On a software rasteriser this is far faster than a
// storage block: llvmpipe (Mesa 22.3) fetches a texel as a vector, but a storage block one component of one
// invocation at a time, through the stack.
#pragma once

#include <cstdint>

#include "common/gpu/buffer.h"
#include "common/gpu/object.h"

namespace relight::gpu {

class TexelView {
 public:
  enum class Format { rgba32f, rgba32ui, rgb32ui, r32ui };
  TexelView() = default;
  // Views bytes [offset, offset + bytes) of the buffer, which must outlive the view; offset must be a
  // multiple of alignment(). Throws Error if the driver takes fewer texels.
  TexelView(const Buffer& buffer, Format format, int64_t offset, int64_t bytes);
  TexelView(const Buffer& buffer, Format format) : TexelView(buffer, format, 0, buffer.bytes()) {}

  void bind(int unit) const;
  static int64_t alignment();  // of offsets [bytes]
  static int64_t max_texels();

 private:
  Object object_;
};

}  // namespace relight::gpu
