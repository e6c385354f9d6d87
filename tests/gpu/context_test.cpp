#include "common/gpu/context.h"

#include <gtest/gtest.h>

#include <numeric>
#include <optional>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "tests/gpu/contexts.h"

namespace relight {
namespace {

using test::ShaderDir;

std::vector<float> doubled(int64_t n, int local_size) {
  const ShaderDir dir(RELIGHT_SOURCE_DIR);
  const gpu::Program program =
      gpu::Program::compute("tests/gpu/doubler.glsl", {"LOCAL_SIZE " + std::to_string(local_size)});
  std::vector<float> values(static_cast<size_t>(n));
  std::iota(values.begin(), values.end(), 1.0f);
  const gpu::Buffer buffer = gpu::Buffer::from(values);
  buffer.bind_storage(0);
  program.set("count", static_cast<uint32_t>(n));
  program.dispatch_items(n, local_size);
  return buffer.download<float>();
}

void expect_doubled(const std::vector<float>& values) {
  for (size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], 2.0f * static_cast<float>(i + 1)) << i;
}

// Red if the context is not core 4.5 or a compute shader cannot run in it.
TEST(GpuContext, OsmesaRunsComputeShaders) {
  const auto context = gpu::Context::create("osmesa");
  EXPECT_EQ(context->backend(), gpu::Backend::osmesa);
  EXPECT_FALSE(context->renderer().empty());
  EXPECT_NE(context->version().find("Core"), std::string::npos) << context->version();
  EXPECT_GE(context->max_storage_block_bytes(), int64_t{1} << 27);
  expect_doubled(doubled(1000, 64));
}

// Red if the loader keeps pointers into a destroyed context, or a display is terminated under a later
// context.
TEST(GpuContext, CanBeCreatedAndDestroyedManyTimes) {
  std::string reason;
  for (int i = 0; i < 3; ++i) {
    {
      const auto osmesa = gpu::Context::create("osmesa");
      expect_doubled(doubled(65, 64));
    }
    EXPECT_EQ(gpu::Context::current(), nullptr);
    if (const auto egl = test::egl_or_null(reason)) expect_doubled(doubled(65, 64));
  }
}

// Red if a back end skips the bind because it believes it is current still, so that GL calls go to the other
// context (whose buffer of the same name holds something else).
TEST(GpuContext, BothBackEndsLiveSideBySide) {
  const auto osmesa = gpu::Context::create("osmesa");
  const gpu::Buffer in_osmesa = gpu::Buffer::from(std::vector<float>{1});
  std::string reason;
  const auto egl = test::egl_or_null(reason);
  if (!egl) GTEST_SKIP() << reason;
  const gpu::Buffer in_egl = gpu::Buffer::from(std::vector<float>{2});
  ASSERT_EQ(in_osmesa.id(), in_egl.id()) << "the test needs equal names in both contexts";
  for (int i = 0; i < 3; ++i) {
    osmesa->make_current();
    EXPECT_EQ(gpu::Context::current(), osmesa.get());
    EXPECT_EQ(in_osmesa.download<float>()[0], 1.0f);
    expect_doubled(doubled(100, 64));
    egl->make_current();
    EXPECT_EQ(in_egl.download<float>()[0], 2.0f);
    expect_doubled(doubled(100, 64));
  }
}

// Red if an object is deleted in whichever context happens to be current (names repeat across contexts).
TEST(GpuContext, ObjectsAreDeletedInTheirOwnContext) {
  const auto first = gpu::Context::create("osmesa");
  std::optional<gpu::Buffer> a(gpu::Buffer::from(std::vector<float>{1, 2, 3}));
  const auto second = gpu::Context::create("osmesa");
  const gpu::Buffer b = gpu::Buffer::from(std::vector<float>{4, 5, 6});
  ASSERT_EQ(a->id(), b.id()) << "the test needs equal names in both contexts";
  a.reset();
  EXPECT_EQ(gpu::Context::current(), second.get());
  EXPECT_EQ(b.download<float>(), (std::vector<float>{4, 5, 6}));
}

// Red if destroying a buffer after its context touches GL.
TEST(GpuContext, ObjectsMayOutliveTheirContext) {
  gpu::Buffer buffer;
  {
    const auto context = gpu::Context::create("osmesa");
    buffer = gpu::Buffer(64);
  }
  EXPECT_EQ(gpu::Context::current(), nullptr);
}

// Red if "auto" fails without a GPU, or an unknown name passes.
TEST(GpuContext, AutoAlwaysGivesAContextAndUnknownNamesAreRefused) {
  EXPECT_NE(gpu::Context::create("auto"), nullptr);
  try {
    gpu::Context::create("vulkan");
    FAIL() << "accepted an unknown back end";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("'vulkan'; valid: osmesa, egl, auto"), std::string::npos)
        << e.what();
  }
}

// Red if groups beyond the x limit are dropped: 65535 groups of one item each.
TEST(GpuProgram, DispatchesMoreItemsThanTheGroupLimitInX) {
  const auto context = gpu::Context::create("osmesa");
  expect_doubled(doubled(65535 + 3, 1));
}

// Red if a wrong local size silently runs too few or too many items.
TEST(GpuProgram, RefusesAWrongLocalSize) {
  const auto context = gpu::Context::create("osmesa");
  const ShaderDir dir(RELIGHT_SOURCE_DIR);
  const gpu::Program program = gpu::Program::compute("tests/gpu/doubler.glsl", {"LOCAL_SIZE 64"});
  EXPECT_THROW(program.dispatch_items(100, 32), std::logic_error);
}

// Red if a range check is missing: the driver would drop the call and keep a GL error for later.
TEST(GpuBuffer, RefusesRangesOutsideItself) {
  const auto context = gpu::Context::create("osmesa");
  const gpu::Buffer buffer(64);
  float out[32];
  EXPECT_THROW(buffer.download(out, 128), std::logic_error);
  EXPECT_THROW(buffer.upload(32, 64, out), std::logic_error);
  EXPECT_THROW(buffer.bind_storage(0, 48, 32), std::logic_error);
  gpu::check_gl("test");
}

}  // namespace
}  // namespace relight
