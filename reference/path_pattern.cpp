#include "reference/path_pattern.h"

#include <cctype>
#include <functional>

#include "common/run/error.h"

namespace relight {
namespace {

constexpr int unlimited = 1 << 20;

// A vertex (lobes: bit 0 D, bit 1 G), or alternatives of sequences; repeated min..max times.
struct Node {
  int lobes = 0;
  std::vector<std::vector<Node>> alternatives;
  int min = 1, max = 1;
};

struct Pattern {
  std::vector<Node> vertices;
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

  std::vector<Node> sequence() {
    std::vector<Node> nodes;
    for (char c = peek(); c == 'D' || c == 'G' || c == 'S' || c == '.' || c == '('; c = peek()) {
      Node node;
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

  void repeat(Node& node) {
    if (take('*')) {
      node.min = 0, node.max = unlimited;
    } else if (take('+')) {
      node.max = unlimited;
    } else if (take('?')) {
      node.min = 0;
    } else if (take('{')) {
      node.min = node.max = number();
      if (take(',')) node.max = peek() == '}' ? unlimited : number();
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

// Continuation-passing match of a word of lobes (1: D, 2: G) against a sequence of nodes.
struct Matcher {
  const std::vector<int>& word;

  template <typename Then>
  bool match(const std::vector<Node>& nodes, size_t node, size_t at, const Then& then) const {
    if (node == nodes.size()) return then(at);
    return repeat(nodes[node], 0, at, [&](size_t next) { return match(nodes, node + 1, next, then); });
  }

 private:
  using Function = std::function<bool(size_t)>;

  bool repeat(const Node& node, int times, size_t at, const Function& then) const {
    if (times >= node.min && then(at)) return true;
    if (times >= node.max) return false;
    // An empty repetition leads nowhere new.
    return once(node, at, [&](size_t next) {
      return (next > at || times < node.min) && repeat(node, times + 1, next, then);
    });
  }

  bool once(const Node& node, size_t at, const Function& then) const {
    if (node.alternatives.empty()) return at < word.size() && (word[at] & node.lobes) != 0 && then(at + 1);
    for (const std::vector<Node>& alternative : node.alternatives)
      if (match(alternative, 0, at, then)) return true;
    return false;
  }
};

bool matches(const Pattern& pattern, const std::vector<int>& word) {
  return Matcher{word}.match(pattern.vertices, 0, 0, [&](size_t at) { return at == word.size(); });
}

// How many of the class's words of lobes match, and how many there are. Longer paths of an open class are
// stood for by the next three lengths.
struct Count {
  int matching = 0, all = 0;
};

void count_words(const Pattern& pattern, const PathClass& c, int interior, Count& count) {
  for (int bits = 0; bits < (1 << interior); ++bits) {
    if ((bits != 0) != c.glossy_interior) continue;
    std::vector<int> word{c.glossy_at_eye ? 2 : 1};
    for (int i = 0; i < interior; ++i) word.push_back((bits >> i) & 1 ? 2 : 1);
    ++count.all;
    count.matching += matches(pattern, word);
  }
}

bool selects(const Pattern& pattern, const PathClass& c, const std::string& text) {
  if (!pattern.ends[static_cast<int>(c.end)]) return false;
  if (c.bounces < 0) return matches(pattern, {});
  if (c.bounces > 12)
    fail("light paths: patterns are decided for up to 12 bounces only, not for {}", c.name());
  Count count;
  for (int more = 0; more <= (c.or_more ? 3 : 0); ++more) count_words(pattern, c, c.bounces + more, count);
  if (count.matching != 0 && count.matching != count.all)
    fail(
        "light paths: '{}' takes some paths of class {} and leaves others; classes tell the number of "
        "bounces{}, "
        "the lobe at the visible surface, and whether all other vertices are diffuse or some glossy",
        text, c.name(), c.or_more ? fmt::format(" (up to {} here)", c.bounces - 1) : "");
  return count.matching > 0;
}

}  // namespace

std::vector<size_t> select_paths(const std::string& text, const std::vector<PathClass>& classes) {
  const Pattern pattern = Parser(text).parse();
  std::vector<size_t> selected;
  for (size_t i = 0; i < classes.size(); ++i)
    if (selects(pattern, classes[i], text)) selected.push_back(i);
  return selected;
}

}  // namespace relight
