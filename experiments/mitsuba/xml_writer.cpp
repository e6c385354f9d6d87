#include "experiments/mitsuba/xml_writer.h"

#include <fmt/format.h>

namespace relight::mitsuba {

namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    // Control characters are not allowed in XML at all, escaped or not.
    else
      result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  return result;
}

std::string start(const std::string& tag, const XmlWriter::Attributes& attributes) {
  std::string result = "<" + tag;
  for (const auto& [name, value] : attributes) result += fmt::format(" {}=\"{}\"", name, escaped(value));
  return result;
}

}  // namespace

void XmlWriter::line(const std::string& content) {
  text_ += std::string(2 * open_.size(), ' ') + content + "\n";
}

void XmlWriter::open(const std::string& tag, const Attributes& attributes) {
  line(start(tag, attributes) + ">");
  open_.push_back(tag);
}

void XmlWriter::close() {
  const std::string tag = open_.back();
  open_.pop_back();
  line("</" + tag + ">");
}

void XmlWriter::leaf(const std::string& tag, const Attributes& attributes) {
  line(start(tag, attributes) + "/>");
}

void XmlWriter::comment(const std::string& text) {
  std::string safe = escaped(text);
  // Two hyphens would end the comment.
  for (size_t at = safe.find("--"); at != std::string::npos; at = safe.find("--")) safe.replace(at, 2, "- ");
  line("<!-- " + safe + " -->");
}

void XmlWriter::value(const std::string& kind, const std::string& name, const std::string& value) {
  leaf(kind, {{"name", name}, {"value", value}});
}

void XmlWriter::number(const std::string& name, float number) { value("float", name, text_of(number)); }

void XmlWriter::rgb(const std::string& name, const glm::vec3& colour) { value("rgb", name, text_of(colour)); }

std::string text_of(float value) { return fmt::format("{}", value); }

std::string text_of(const glm::vec3& v) { return fmt::format("{}, {}, {}", v.x, v.y, v.z); }

}  // namespace relight::mitsuba
