// Writes indented XML, enough for Mitsuba scene files.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace relight::mitsuba {

class XmlWriter {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  void open(const std::string& tag, const Attributes& attributes = {});
  void close();
  void leaf(const std::string& tag, const Attributes& attributes);
  void comment(const std::string& text);

  // <kind name="..." value="..."/>: string, float, integer, boolean.
  void value(const std::string& kind, const std::string& name, const std::string& value);
  void number(const std::string& name, float value);
  void rgb(const std::string& name, const glm::vec3& value);

  // The whole document; every element must have been closed.
  const std::string& text() const { return text_; }

 private:
  void line(const std::string& content);
  std::string text_ = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n";
  std::vector<std::string> open_;
};

// Shortest decimal that reads back as the same float.
std::string text_of(float value);
// "x, y, z".
std::string text_of(const glm::vec3& value);

}  // namespace relight::mitsuba
