// From levels of effects to light paths: which path classes a choice of levels carries. Classes that all
// choices treat alike form a group; only groups are kept of a pilot.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/run/method.h"
#include "reference/path_classes.h"

namespace relight {

using Levels = std::vector<size_t>;  // of each effect, its level's number

// Does a method with these light paths carry the class? Direct light of lamps always; a class of "and more"
// bounces only if all of them.
bool carries(const LightPaths& paths, const PathClass& path_class);

class EffectPaths {
 public:
  // knobs: everything that no effect sets. All must outlive this. Error if a level names a knob or value that
  // the method doesn't have, or an effect has fewer than two levels.
  EffectPaths(const Method& method, const KnobValues& knobs, const std::vector<Effect>& effects);

  Levels everything() const;  // all last levels
  KnobValues knobs(const Levels& levels) const;
  LightPaths paths(const Levels& levels) const { return paths_.at(number(levels)); }

  // The group of a class, a new one for the first of its kind.
  size_t group_of(const PathClass& path_class);
  size_t groups() const { return carried_.size(); }
  bool carried(size_t group, const Levels& levels) const {
    return carried_.at(group).at(number(levels)) != 0;
  }
  // For each group: 1 if `from` carries it and `to` doesn't.
  std::vector<uint8_t> lost(const Levels& from, const Levels& to) const;

 private:
  size_t number(const Levels& levels) const;

  const KnobValues& knobs_;
  const std::vector<Effect>& effects_;
  std::vector<LightPaths> paths_;  // of every choice of levels
  std::vector<std::vector<uint8_t>> carried_;
  std::map<std::string, size_t> groups_;  // by carried_ as text
};

}  // namespace relight
