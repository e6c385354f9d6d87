// convergence.csv: the reference's error against wall time, one line a batch, written while it renders.
#pragma once

#include <filesystem>
#include <fstream>

#include "reference/path_tracer.h"

namespace relight {

class ConvergenceFile {
 public:
  // goes_on: keep what an earlier session of the same run left. Throws Error naming the file.
  ConvergenceFile(const std::filesystem::path& file, bool goes_on);
  void add(const ConvergencePoint& point);

 private:
  // A killed session may have written lines of batches that its checkpoint does not hold, the last one by
  // half: they are rendered, and written, again.
  void drop_from(int samples_per_pixel);

  std::filesystem::path file_;
  bool goes_on_;  // and no point of this session has been added yet
  std::ofstream out_;
};

}  // namespace relight
