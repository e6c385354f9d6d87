#include "stored_session.h"

namespace relight::test {

namespace {

SessionOptions quiet_options(const StoredReference& reference) {
  SessionOptions options = stored_session_options(reference);
  options.quiet = true;
  return options;
}

}  // namespace

StoredSession::StoredSession(const std::string& name, Session::Gpu gpu)
    : reference_(stored_reference(name)),
      stored_(load_stored(images_folder() / name)),
      session_(quiet_options(reference_), gpu) {}

BatchPlan StoredSession::few_samples(uint64_t seed, int samples_per_batch) const {
  BatchPlan plan = stored_plan(reference_);
  plan.seed = seed;
  plan.samples_per_batch = samples_per_batch;
  return plan;
}

PictureStatistics StoredSession::render(const BatchPlan& plan) {
  return render_statistics(session_.tracer(), session_.buffer(), session_.lighting(), plan,
                           session_.progress());
}

PictureStatistics brighter(PictureStatistics picture, double factor) {
  const auto f = static_cast<float>(factor);
  for (Estimate* estimate : {&picture.pixels, &picture.tiles, &picture.whole}) {
    for (glm::vec3& p : estimate->mean.pixels) p *= f;
    for (glm::vec3& p : estimate->variance.pixels) p *= f * f;
  }
  return picture;
}

}  // namespace relight::test
