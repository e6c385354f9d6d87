// A stored reference with everything needed to render it again.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/stored_references/files.h"
#include "experiments/stored_references/identity.h"

namespace relight::test {

inline std::filesystem::path images_folder() {
  return std::filesystem::path(RELIGHT_SOURCE_DIR) / "reference" / "images";
}

class StoredSession {
 public:
  // Throws Error if nothing is stored under `name`.
  explicit StoredSession(const std::string& name, Session::Gpu gpu = Session::Gpu::not_needed);
  const StoredPicture& stored() const { return stored_; }
  const StoredReference& reference() const { return reference_; }
  Session& session() { return session_; }
  // The reference's light paths with a few samples and an independent seed.
  BatchPlan few_samples(uint64_t seed, int samples_per_batch = 4) const;
  PictureStatistics render(const BatchPlan& plan);

 private:
  StoredReference reference_;
  StoredPicture stored_;
  Session session_;
};

// The picture with its indirect light times `factor`; direct light as it is.
PictureStatistics brighter(PictureStatistics picture, double factor);

}  // namespace relight::test
