#include "reference/path_pattern.h"

#include <cctype>
#include <stdexcept>

#include "common/run/error.h"
#include "reference/path_automaton.h"

namespace relight {
namespace {

struct Pattern {
  std::vector<PatternNode> vertices;
  bool ends[3] = {false, false, false};  // by LightEnd
};

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  Pattern parse() {
    expect('E', "a path starts at the eye: E");
    Pattern pattern;
    pattern.vertices = sequence();
    expect('L', "expected a vertex (D, G, S, . or a group) or the light: L, Lp, La or Le");
    end(pattern);
    skip_spaces();
    if (at_ < text_.size()) refuse("the light ends a path; nothing may follow");
    return pattern;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    fail("light paths: {}\n  {}\n  {}^", why, text_, std::string(at_, ' '));
  }
  void skip_spaces() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  char peek() {
    skip_spaces();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c, const char* why) {
    if (!take(c)) refuse(why);
  }

  std::vector<PatternNode> sequence() {
    std::vector<PatternNode> nodes;
    for (char c = peek(); c == 'D' || c == 'G' || c == 'S' || c == '.' || c == '('; c = peek()) {
      PatternNode node;
      ++at_;
      if (c == '(') {
        do node.alternatives.push_back(sequence());
        while (take('|'));
        expect(')', "expected | or ) in a group");
      } else {
        node.lobes = c == 'D' ? 1 : c == '.' ? 3 : 2;
      }
      repeat(node);
      nodes.push_back(std::move(node));
    }
    return nodes;
  }

  void repeat(PatternNode& node) {
    if (take('*')) {
      node.min = 0, node.max = PatternNode::unlimited;
    } else if (take('+')) {
      node.max = PatternNode::unlimited;
    } else if (take('?')) {
      node.min = 0;
    } else if (take('{')) {
      node.min = node.max = number();
      if (take(',')) node.max = peek() == '}' ? PatternNode::unlimited : number();
      if (node.max < node.min) refuse("the larger number comes second");
      expect('}', "expected }");
    }
  }

  int number() {
    if (!std::isdigit(static_cast<unsigned char>(peek()))) refuse("expected a number");
    int n = 0;
    while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_]))) {
      n = 10 * n + (text_[at_++] - '0');
      if (n > 1000) refuse("no path has more than 1000 vertices");
    }
    return n;
  }

  void end(Pattern& pattern) {
    const char which = at_ < text_.size() ? text_[at_] : '\0';
    const bool named = which == 'p' || which == 'a' || which == 'e';
    for (int i = 0; i < 3; ++i) pattern.ends[i] = !named || which == "pae"[i];
    if (named) ++at_;
  }

  const std::string& text_;
  size_t at_ = 0;
};

bool selects(const Pattern& pattern, const PathAutomaton& automaton, const PathClass& c,
             const std::string& text) {
  if (!pattern.ends[static_cast<int>(c.end)]) return false;
  const PathAutomaton::Match match = automaton.match(c);
  if (match == PathAutomaton::Match::some)
    fail(
        "light paths: '{}' takes some paths of class {} and leaves others; classes tell the number of "
        "bounces{}, "
        "the lobe at the visible surface, and whether all other vertices are diffuse or some glossy",
        text, c.name(), c.or_more ? fmt::format(" (up to {} here)", c.bounces - 1) : "");
  return match == PathAutomaton::Match::all;
}

}  // namespace

std::vector<size_t> select_paths(const std::string& text, const std::vector<PathClass>& classes) {
  const Pattern pattern = Parser(text).parse();
  try {
    const PathAutomaton automaton(pattern.vertices);
    std::vector<size_t> selected;
    for (size_t i = 0; i < classes.size(); ++i)
      if (selects(pattern, automaton, classes[i], text)) selected.push_back(i);
    return selected;
  } catch (const std::length_error& error) {
    fail("light paths: '{}': {}", text, error.what());
  }
}

}  // namespace relight
