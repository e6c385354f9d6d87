// The run record: everything that is known about one run, one JSON object a line in records.jsonl. Every
// table, curve and report is made from records, so a number that is not in here can't be shown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/image/metrics.h"
#include "common/run/effect_plan.h"
#include "common/run/provenance.h"

namespace relight {

// Wall times of repeated relights [ms].
struct RelightTime {
  double median = 0, min = 0, max = 0;
  int repeats = 0;
};
// Median (mean of the middle two for an even count), smallest and largest; all 0 for no times.
RelightTime summarise_times(const std::vector<double>& milliseconds);

// What the reference image cost.
struct ReferenceCost {
  int64_t samples = 0;  // a pixel
  int64_t batches = 0;
  double seconds = 0;  // wall time of this run: tracing it, or loading it from the cache
  int64_t rays = 0;
  std::string estimator;
  bool from_cache = false;
};

struct RunRecord {
  // What was run.
  std::string scene, view, lighting, method;
  std::string preset;                        // where the knobs started from; older records: empty
  std::map<std::string, std::string> knobs;  // fully resolved
  uint64_t seed = 0;
  bool repeatable = true;                  // Method::repeatable() of these knobs
  std::string light_paths;                 // LightPaths::to_string() of the method
  std::string reference_paths;             // and of the reference that it was compared with
  std::vector<std::string> not_simulated;  // what the scene has and the method leaves out, in words
  std::string command;                     // command line that repeats this run, every setting written out
  std::optional<EffectPlan> effect_plan;   // which effects were left out and why; absent: nobody asked
  double exposure = 1;                     // the scene's fixed factor before the clamp of `relative`
  int width = 0, height = 0;
  int64_t triangles = 0;
  std::string scene_hash;  // content hash of the scene
  // Of camera and size, and of the lights, which scene_hash does not hold; older records: empty.
  std::string view_hash, lighting_hash;

  // How wrong it is; absent when the run failed before an image, or without a reference.
  std::optional<ErrorReport> errors;           // of the total image
  std::optional<ErrorReport> errors_indirect;  // of the indirect image alone

  // What it cost.
  double precompute_s = 0;
  RelightTime relight_ms;
  std::vector<std::pair<std::string, double>> setup_stages, precompute_stages,
      relight_stages;                           // [s], in order of execution
  std::map<std::string, int64_t> memory_bytes;  // by artefact; "process_peak" is peak_memory_bytes()
  std::map<std::string, int64_t> counters;
  std::optional<ReferenceCost> reference;

  std::vector<std::string> warnings;
  std::vector<std::string> failed_stages;  // "stage: why"; not empty = the run's result is not to be trusted
  Provenance provenance;
};

// Sum of memory_bytes without the process's peak: what the method keeps to relight.
int64_t prepared_bytes(const RunRecord& record);

// One line of JSON without a newline. JSON has no NaN or infinity: they are written as the strings "nan",
// "inf" and
// "-inf", and read back as numbers.
std::string record_to_json(const RunRecord& record);
// Throws Error naming the missing or mistyped field. Unknown fields are ignored: newer programs write more.
RunRecord record_from_json(const std::string& line);

// Adds one line, creating file and folder. Safe among processes; on a full disk the file is left as it was
// and Error is thrown.
void append_record(const std::filesystem::path& file, const RunRecord& record);

struct RecordFile {
  std::vector<RunRecord> records;
  std::vector<std::string> warnings;  // one for each unreadable line, naming file and line
};
// A torn line, e.g. of a machine that lost power, costs that record only. Throws Error if the file can't be
// opened.
RecordFile read_records(const std::filesystem::path& file);

}  // namespace relight
