#include "experiments/reference_run/convergence_file.h"

#include "common/run/error.h"

namespace relight {

ConvergenceFile::ConvergenceFile(const std::filesystem::path& file, bool goes_on)
    : file_(file), out_(file, goes_on ? std::ios::app : std::ios::trunc) {
  if (!goes_on) out_ << "seconds,samples_per_pixel,relative_standard_error\n";
  if (!out_.flush()) fail("cannot write '{}'", file.string());
}

void ConvergenceFile::add(const ConvergencePoint& point) {
  // One batch alone says nothing about its error: the field stays empty.
  const std::string error =
      point.relative_standard_error > 0.0 ? fmt::format("{:.6g}", point.relative_standard_error) : "";
  out_ << fmt::format("{:.3f},{},{}\n", point.seconds, point.samples_per_pixel, error);
  if (!out_.flush()) fail("cannot write '{}': is the disk full?", file_.string());
}

}  // namespace relight
