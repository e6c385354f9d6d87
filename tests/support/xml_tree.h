// A strict reader of the XML that relight writes (elements, attributes, comments; no text, no CDATA): throws
// where a document is not well-formed.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace relight::test {

struct XmlElement {
  std::string tag;
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement> children;

  std::string at(const std::string& attribute) const { return attributes.at(attribute); }
  // The child <... name="name"/>; throws std::out_of_range if there isn't exactly one.
  const XmlElement& named(const std::string& name) const;
  // All children with this tag.
  std::vector<const XmlElement*> all(const std::string& tag_name) const;
};

// The root element.
XmlElement parse_xml(const std::string& text);

}  // namespace relight::test
