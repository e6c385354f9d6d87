#include "experiments/reference_run/convergence_file.h"

#include <cstdlib>
#include <string>

#include "common/run/atomic_file.h"
#include "common/run/error.h"

namespace relight {

namespace {

constexpr const char* head = "seconds,samples_per_pixel,relative_standard_error\n";

// The second field of a line of add(); 0 if it is not one.
int samples_of(const std::string& line) {
  const size_t comma = line.find(',');
  return comma == std::string::npos ? 0 : std::atoi(line.c_str() + comma + 1);
}

}  // namespace

ConvergenceFile::ConvergenceFile(const std::filesystem::path& file, bool goes_on)
    : file_(file), goes_on_(goes_on), out_(file, goes_on ? std::ios::app : std::ios::trunc) {
  if (!goes_on) out_ << head;
  if (!out_.flush()) fail("cannot write '{}'", file.string());
}

void ConvergenceFile::drop_from(int samples_per_pixel) {
  std::string kept = head;
  std::ifstream in(file_);
  // A line without an end is a half-written one.
  for (std::string line; std::getline(in, line) && !in.eof();)
    if (const int samples = samples_of(line); samples > 0 && samples < samples_per_pixel) kept += line + '\n';
  out_.close();
  write_text_atomically(file_, kept);
  out_.open(file_, std::ios::app);
}

void ConvergenceFile::add(const ConvergencePoint& point) {
  if (goes_on_) drop_from(point.samples_per_pixel);
  goes_on_ = false;
  // One batch alone says nothing about its error: the field stays empty.
  const std::string error =
      point.relative_standard_error > 0.0 ? fmt::format("{:.6g}", point.relative_standard_error) : "";
  out_ << fmt::format("{:.3f},{},{}\n", point.seconds, point.samples_per_pixel, error);
  if (!out_.flush()) fail("cannot write '{}': is the disk full?", file_.string());
}

}  // namespace relight
