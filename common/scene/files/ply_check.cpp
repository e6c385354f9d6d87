#include "common/scene/files/ply_check.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "common/run/error.h"

namespace relight {

namespace {

struct Property {
  size_t size = 0;        // bytes of a scalar, or of a list entry
  size_t count_size = 0;  // bytes of a list's length; 0 for a scalar
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  std::string format;
  std::vector<Element> elements;
  bool understood = false;
  bool ended = true;  // false: the file is over before end_header
};

size_t type_size(const std::string& type) {
  static const std::map<std::string, size_t> sizes = {
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

bool read_property(std::istringstream& words, Header& header) {
  Property property;
  std::string type;
  words >> type;
  if (type == "list") {
    words >> type;
    property.count_size = type_size(type);
    words >> type;
    if (property.count_size == 0 || property.count_size > 4) return false;
  }
  property.size = type_size(type);
  if (property.size == 0 || header.elements.empty()) return false;
  header.elements.back().properties.push_back(property);
  return true;
}

Header read_header(std::istream& in) {
  Header header;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "format") words >> header.format;
    if (keyword == "element") {
      Element element;
      if (!(words >> element.name >> element.count)) return header;
      header.elements.push_back(element);
    }
    if (keyword == "property" && !read_property(words, header)) return header;
    if (keyword == "end_header") {
      header.understood = true;
      return header;
    }
  }
  header.ended = false;
  return header;
}

// Bytes of a binary body, walked element by element.
class BinaryBody {
 public:
  BinaryBody(std::vector<unsigned char> bytes, bool big_endian)
      : bytes_(std::move(bytes)), big_endian_(big_endian) {}

  bool skip(const Property& property) {
    if (property.count_size == 0) return advance(property.size);
    if (bytes_.size() - at_ < property.count_size) return false;
    uint64_t length = 0;
    for (size_t i = 0; i < property.count_size; ++i) {
      const size_t shift = 8 * (big_endian_ ? property.count_size - 1 - i : i);
      length |= static_cast<uint64_t>(bytes_[at_ + i]) << shift;
    }
    at_ += property.count_size;
    return advance(length * property.size);
  }

 private:
  bool advance(uint64_t size) {
    if (bytes_.size() - at_ < size) return false;
    at_ += size;
    return true;
  }
  std::vector<unsigned char> bytes_;
  size_t at_ = 0;
  bool big_endian_;
};

[[noreturn]] void fail_short(const std::filesystem::path& file, const Element& element, uint64_t present) {
  fail("{}: the file is truncated: its header announces {} of element '{}', but it ends after {}",
       file.string(), element.count, element.name, present);
}

}  // namespace

void require_complete_ply(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string magic(3, ' ');
  in.read(magic.data(), 3);
  if (magic != "ply" && magic != "PLY")
    fail("{}: not a PLY file: it does not begin with the magic number 'ply'", file.string());
  const Header header = read_header(in);
  // Assimp would look for it for ever.
  if (!header.ended) fail("{}: the file is truncated: its header has no end_header", file.string());
  if (!header.understood) return;
  if (header.format == "ascii") {
    // One line an element, as every writer does.
    std::string line;
    for (const Element& element : header.elements)
      for (uint64_t i = 0; i < element.count; ++i)
        if (!std::getline(in, line)) fail_short(file, element, i);
    return;
  }
  BinaryBody body({std::istreambuf_iterator<char>(in), {}}, header.format == "binary_big_endian");
  for (const Element& element : header.elements)
    for (uint64_t i = 0; i < element.count; ++i)
      for (const Property& property : element.properties)
        if (!body.skip(property)) fail_short(file, element, i);
}

}  // namespace relight
