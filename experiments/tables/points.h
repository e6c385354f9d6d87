// From records to points that can be compared: those of one scene, lighting, view and set of light paths.
#pragma once

#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/tables/measures.h"

namespace relight::tables {

struct Point {
  size_t record = 0;  // its place among the records
  std::string method;
  std::string label;                      // preset and settings that tell it from the method's other runs
  std::array<Measured, 3> errors, costs;  // by ErrorKind and by CostKind [ms, bytes, s]
  std::string failure;                    // why it must not be compared; empty: it may

  const Measured& operator[](ErrorKind e) const { return errors[static_cast<size_t>(e)]; }
  const Measured& operator[](CostKind c) const { return costs[static_cast<size_t>(c)]; }
  bool comparable(ErrorKind e, CostKind c) const {
    return failure.empty() && (*this)[e].known() && (*this)[c].known();
  }
  std::string name() const { return method + (label.empty() ? "" : " " + label); }
};

// Errors against references of other light paths are not comparable: such runs are in another group.
struct Group {
  std::string scene, lighting, view, paths;
  std::vector<Point> points;  // failed ones too
  std::array<Measured, 3>
      noise_floors;             // by ErrorKind; low < high if records of several references are mixed
  bool named_by_paths = false;  // another group differs in light paths alone

  // In the order of their first run.
  std::vector<std::string> methods() const;
  std::string title() const;  // "colonnade, spot, 640x480"; with the light paths if they tell it from another
};

// In the order of the records.
std::vector<Group> make_groups(const std::vector<RunRecord>& records);

// What tells each record from others of its method: preset, tolerance, knobs, seed. A knob is left out where
// it has the value that most records of method and preset have.
std::vector<std::string> labels(const std::vector<RunRecord>& records);

// Why the record must not be compared with others, or nothing.
std::string failure_of(const RunRecord& record);

}  // namespace relight::tables
