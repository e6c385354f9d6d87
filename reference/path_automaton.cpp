#include "reference/path_automaton.h"

#include <stdexcept>

namespace relight {
namespace {

constexpr int diffuse = 1, glossy = 2;
constexpr int accept = 0;  // the state that ends every match
// Far beyond patterns that a person writes; keeps the others from taking minutes.
constexpr size_t most_states = 20000, most_places = 20000;

}  // namespace

PathAutomaton::PathAutomaton(const std::vector<PatternNode>& vertices) : states_(1) {
  start_ = sequence(vertices, accept);
}

int PathAutomaton::add(State state) {
  if (states_.size() >= most_states) throw std::length_error("its repetitions make it too long");
  states_.push_back(std::move(state));
  return static_cast<int>(states_.size()) - 1;
}

int PathAutomaton::sequence(const std::vector<PatternNode>& nodes, int next) {
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) next = repeated(*node, next);
  return next;
}

int PathAutomaton::repeated(const PatternNode& node, int next) {
  int start = next;
  if (node.max == PatternNode::unlimited) {
    start = add({0, 0, {next}});
    const int again = once(node, start);
    states_[static_cast<size_t>(start)].free.push_back(again);
  } else {
    for (int i = node.min; i < node.max; ++i) start = add({0, 0, {next, once(node, start)}});
  }
  for (int i = 0; i < node.min; ++i) start = once(node, start);
  return start;
}

int PathAutomaton::once(const PatternNode& node, int next) {
  if (node.alternatives.empty()) return add({node.lobes, next, {}});
  State choice;
  for (const auto& alternative : node.alternatives) choice.free.push_back(sequence(alternative, next));
  return add(std::move(choice));
}

void PathAutomaton::enter(int state, States& states) const {
  if (!states.insert(state).second) return;
  for (const int next : states_[static_cast<size_t>(state)].free) enter(next, states);
}

PathAutomaton::States PathAutomaton::read(const States& from, int lobe) const {
  States to;
  for (const int state : from) {
    const State& s = states_[static_cast<size_t>(state)];
    if ((s.lobes & lobe) != 0) enter(s.next, to);
  }
  return to;
}

// All places one interior vertex further.
std::set<PathAutomaton::Place> PathAutomaton::longer(const std::set<Place>& places, bool some_glossy) const {
  std::set<Place> next;
  for (const auto& [states, seen] : places) {
    next.insert({read(states, diffuse), seen});
    if (some_glossy) next.insert({read(states, glossy), true});
  }
  return next;
}

PathAutomaton::Match PathAutomaton::match(const PathClass& c) const {
  States states;
  enter(start_, states);
  std::set<Place> places;
  places.insert({c.bounces < 0 ? states : read(states, c.glossy_at_eye ? glossy : diffuse), false});
  for (int i = 0; i < c.bounces; ++i) {
    places = longer(places, c.glossy_interior);
    if (places.size() > most_places) throw std::length_error("it is too involved");
  }
  // Longer and longer words, until they lead nowhere new.
  for (size_t before = 0; c.or_more && places.size() > before;) {
    before = places.size();
    places.merge(longer(places, c.glossy_interior));
    if (places.size() > most_places) throw std::length_error("it is too involved");
  }
  bool any = false, all = true;
  for (const auto& [reached, seen] : places) {
    if (seen != c.glossy_interior) continue;
    any |= reached.contains(accept), all &= reached.contains(accept);
  }
  return !any ? Match::none : all ? Match::all : Match::some;
}

}  // namespace relight
