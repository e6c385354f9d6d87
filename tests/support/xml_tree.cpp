#include "tests/support/xml_tree.h"

#include <cctype>

namespace relight::test {

namespace {

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  XmlElement document() {
    if (starts("<?xml ")) at_ = find("?>") + 2;
    skip_between();
    XmlElement root = element();
    skip_between();
    if (at_ != text_.size()) fail("something after the root element");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("XML, byte " + std::to_string(at_) + ": " + what);
  }
  bool starts(const std::string& s) const { return text_.compare(at_, s.size(), s) == 0; }
  size_t find(const std::string& s) const {
    const size_t found = text_.find(s, at_);
    if (found == std::string::npos) fail("no " + s);
    return found;
  }
  void expect(const std::string& s) {
    if (!starts(s)) fail("expected " + s);
    at_ += s.size();
  }
  void spaces() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  // White space and comments, in which "--" may not occur.
  void skip_between() {
    for (spaces(); starts("<!--"); spaces()) {
      at_ += 4;
      const size_t end = find("--");
      at_ = end;
      expect("-->");
    }
  }
  std::string name() {
    const size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
      ++at_;
    if (begin == at_) fail("expected a name");
    return text_.substr(begin, at_ - begin);
  }
  std::string quoted() {
    expect("\"");
    std::string value;
    for (; !starts("\""); ++at_) {
      if (at_ >= text_.size() || text_[at_] == '<') fail("attribute not closed");
      if (text_[at_] != '&') {
        value += text_[at_];
        continue;
      }
      const std::string entity = text_.substr(at_, find(";") + 1 - at_);
      const std::map<std::string, char> known = {
          {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}};
      if (!known.contains(entity)) fail("unknown entity " + entity);
      value += known.at(entity);
      at_ += entity.size() - 1;
    }
    expect("\"");
    return value;
  }
  XmlElement element() {
    expect("<");
    XmlElement result{name(), {}, {}};
    for (spaces(); !starts("/>") && !starts(">"); spaces()) {
      const std::string attribute = name();
      expect("=");
      if (!result.attributes.emplace(attribute, quoted()).second) fail("attribute twice: " + attribute);
    }
    if (starts("/>")) return expect("/>"), result;
    expect(">");
    for (skip_between(); !starts("</"); skip_between()) result.children.push_back(element());
    expect("</" + result.tag + ">");
    return result;
  }

  const std::string& text_;
  size_t at_ = 0;
};

}  // namespace

const XmlElement& XmlElement::named(const std::string& name) const {
  const XmlElement* found = nullptr;
  for (const XmlElement& child : children) {
    if (!child.attributes.contains("name") || child.at("name") != name) continue;
    if (found) throw std::out_of_range(tag + " has two children named " + name);
    found = &child;
  }
  if (!found) throw std::out_of_range(tag + " has no child named " + name);
  return *found;
}

std::vector<const XmlElement*> XmlElement::all(const std::string& tag_name) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement& child : children)
    if (child.tag == tag_name) found.push_back(&child);
  return found;
}

XmlElement parse_xml(const std::string& text) { return Parser(text).document(); }

}  // namespace relight::test
