// What a method's error consists of, as the method itself tells it: its approximations one by one, each with
// the knob values that make it exact. `relight explain-error` needs nothing else to say which approximation
// costs how much (docs/explain_error.md).
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace relight {

using KnobOverrides = std::vector<std::pair<std::string, std::string>>;  // knob, value

// One approximation. Its exact twin must compute the same quantity without it, whatever the other stages do;
// it may cost thousands of times as much, because it is only ever asked for on a few pixels
// (DeepFrameBuffer::wanted).
struct ErrorStage {
  std::string name;      // one or two words: "truncation"
  std::string sentence;  // what is approximated, and what the twin does instead
  KnobOverrides exact;
  // False if nothing is approximated here under the knobs at hand: then the overrides must not change the
  // picture.
  bool active = true;
};

struct ErrorStages {
  // In the order in which they are made exact, one after the other: a stage's share depends on what was made
  // exact before it.
  std::vector<ErrorStage> stages;
  // What is left once all are exact. It has no twin within the method: the reference is its twin.
  std::string remainder = "everything", remainder_sentence = "The method declares no stages.";
  // Settings under which the remainder should shrink, to show that it is what its name says.
  std::vector<ErrorStage> closer;
};

}  // namespace relight
