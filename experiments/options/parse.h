// The small languages of the command line: view sizes, bounce ranges, estimators, knob settings.
// Every function throws UsageError that shows the text found and the form expected.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/run/light_paths.h"
#include "reference/path_tracer.h"

namespace relight {

struct ViewChoice {
  std::string camera;             // a view of the scene; empty: its camera
  int width = 640, height = 480;  // pixels, each in [1, 16384]
};
// "640x480" or "gallery:640x480".
ViewChoice parse_view(const std::string& text);
std::string to_string(const ViewChoice& view);

// One or several moments of a lighting that moves.
struct LightsChoice {
  std::string name;           // preset or file
  std::vector<double> times;  // [s]; empty: none was given
};
// "spot", "sweep@0.5", "sweep@0:4:0.5": the first, the last and the step. What follows the last '@' is part
// of the name if it looks like neither.
LightsChoice parse_lights(const std::string& text);
std::string lights_at(const std::string& name, double time);  // "sweep@0.5"

struct BounceRange {
  int min = 1, max = 1;  // min <= max <= 64
};
// "1..3", or "2" for 2..2; not below `least`, 0 or 1.
BounceRange parse_bounces(const std::string& text, int least = 1);
std::string to_string(const BounceRange& range);

// "next_event" or "light_vertex".
Estimator parse_estimator(const std::string& text);
std::string to_string(Estimator estimator);

// Samples a pixel for a path-traced reference: at least one for each of its batches, at most 2^24.
void require_samples(const std::string& option, int samples);

struct KnobSetting {
  std::string method, knob, value;
};
// "method.knob=value".
KnobSetting parse_knob_setting(const std::string& text);

// "1%" or "0.01": a share in [0, 1).
double parse_share(const std::string& option, const std::string& text);

// "name=level" for each text, no name twice.
std::map<std::string, std::string> parse_effects(const std::vector<std::string>& texts);

// "a,b,c" without empty parts or repetitions.
std::vector<std::string> parse_name_list(const std::string& option, const std::string& text);

// Adds a name to a list for people: "a, b, c".
void append_name(std::string& list, const std::string& name);

// `text` as one word for a POSIX shell.
std::string shell_quoted(const std::string& text);

}  // namespace relight
