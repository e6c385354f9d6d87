// convergence.csv: the reference's error against wall time, one line a batch, written while it renders.
#pragma once

#include <filesystem>
#include <fstream>

#include "reference/path_tracer.h"

namespace relight {

class ConvergenceFile {
 public:
  // goes_on: append to what an earlier session of the same run left. Throws Error naming the file.
  ConvergenceFile(const std::filesystem::path& file, bool goes_on);
  void add(const ConvergencePoint& point);

 private:
  std::filesystem::path file_;
  std::ofstream out_;
};

}  // namespace relight
