// Regular expressions over the lobes of a path's vertices, and exact decisions about whole classes of paths:
// does the expression hold for all of them, for none, or for some?
//
// Built after Thompson ("Regular Expression Search Algorithm", 1968); a class is decided by visiting every
// set of states that its words can lead to (the subset construction), so that classes without a longest path
// are decided too.
#pragma once

#include <set>
#include <vector>

#include "reference/path_classes.h"

namespace relight {

// A vertex (lobes: bit 0 D, bit 1 G), or alternatives of sequences; repeated min..max times.
struct PatternNode {
  static constexpr int unlimited = 1 << 20;
  int lobes = 0;
  std::vector<std::vector<PatternNode>> alternatives;
  int min = 1, max = 1;
};

class PathAutomaton {
 public:
  enum class Match { none, some, all };

  // Throws std::length_error for a pattern with repetitions that make it too large.
  explicit PathAutomaton(const std::vector<PatternNode>& vertices);
  // Which of the class's words of lobes match. Throws std::length_error if that takes too many sets of
  // states.
  Match match(const PathClass& c) const;

 private:
  // Reads a vertex whose lobe is in `lobes` and goes on to `next`, or goes on to any of `free` without
  // reading.
  struct State {
    int lobes = 0, next = 0;
    std::vector<int> free;
  };
  using States = std::set<int>;
  // The states that a word may have led to, and whether an interior vertex of it was glossy.
  using Place = std::pair<States, bool>;

  int add(State state);
  // Each returns where to start so that `next` follows.
  int sequence(const std::vector<PatternNode>& nodes, int next);
  int repeated(const PatternNode& node, int next);
  int once(const PatternNode& node, int next);
  void enter(int state, States& states) const;
  States read(const States& from, int lobe) const;
  std::set<Place> longer(const std::set<Place>& places, bool glossy) const;

  std::vector<State> states_;
  int start_ = 0;
};

}  // namespace relight
