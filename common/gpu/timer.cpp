#include "common/gpu/timer.h"

#include <glad/gl.h>

namespace relight::gpu {

void finish() { glFinish(); }

GpuTimer::GpuTimer() {
  finish();
  GLint bits = 0;
  glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
  has_counter_ = bits > 0;
  if (has_counter_) {
    query_ = create_object(ObjectKind::query, GL_TIME_ELAPSED);
    glBeginQuery(GL_TIME_ELAPSED, query_.id());
  }
  start_ = std::chrono::steady_clock::now();
}

GpuTimer::~GpuTimer() {
  if (seconds_ < 0.0 && has_counter_) glEndQuery(GL_TIME_ELAPSED);
}

double GpuTimer::stop() {
  if (seconds_ >= 0.0) return seconds_;
  if (has_counter_) glEndQuery(GL_TIME_ELAPSED);
  finish();
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (has_counter_) {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &nanoseconds);
    // Software drivers count little of compute work; a count of nothing is no measurement.
    if (nanoseconds > 0) seconds_ = static_cast<double>(nanoseconds) * 1e-9;
  }
  return seconds_;
}

}  // namespace relight::gpu
