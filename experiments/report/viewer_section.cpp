// Interactive comparison of pictures on true HDR values: side by side, wiped, flipped or as a false-coloured
// difference, at any exposure, with the values under the cursor. viewer_script.cpp shows what is written
// here.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/image/exr.h"
#include "common/image/false_colour.h"
#include "experiments/compare/image_files.h"
#include "experiments/report/data_uri.h"
#include "experiments/report/html.h"
#include "experiments/report/sections.h"

namespace relight::report {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int colour_steps = 64;

// The images of the page, each once.
class ImageList {
 public:
  explicit ImageList(const fs::path& folder) : folder_(folder) {}

  // Its number, or -1 if the file is missing.
  int add(const RunRecord& record, const std::string& what, const std::string& label) {
    const fs::path file = image_file(folder_, record.method, what);
    if (!fs::exists(file)) return -1;
    const Image image = read_exr(file);
    const std::string uri = half_planes_uri(image, folder_);
    for (size_t i = 0; i < list_.size(); ++i)  // methods with the same paths share a reference
      if (list_[i]["uri"] == uri) return static_cast<int>(i);
    list_.push_back({{"label", label}, {"width", image.width}, {"height", image.height}, {"uri", uri}});
    return static_cast<int>(list_.size()) - 1;
  }
  const json& list() const { return list_; }

 private:
  fs::path folder_;
  json list_ = json::array();
};

json comparisons(const Records& records, ImageList& images) {
  json out = json::array();
  for (const RunRecord& r : records) {
    for (const bool indirect : {false, true}) {
      const char* what = indirect ? "indirect light" : "total";
      const int method =
          images.add(r, indirect ? "indirect" : "total", fmt::format("{}, {}", r.method, what));
      const int reference = images.add(r, indirect ? "reference_indirect" : "reference",
                                       fmt::format("reference of {}, {}", r.method, what));
      if (method < 0 || reference < 0) continue;
      out.push_back({{"label", fmt::format("{}, {}", r.method, what)},
                     {"method", method},
                     {"reference", reference},
                     {"exposure", r.exposure}});
    }
  }
  return out;
}

json colours() {
  json out = json::array();
  for (int i = 0; i < colour_steps; ++i) {
    const glm::vec3 c = false_colour((i + 0.5) / colour_steps);
    out.push_back({c.x, c.y, c.z});
  }
  return out;
}

}  // namespace

std::string viewer_section(const Records& records, const fs::path& folder) {
  ImageList images(folder);
  const json found = comparisons(records, images);
  if (found.empty()) return "";
  std::string data = json{{"images", images.list()}, {"comparisons", found}, {"colours", colours()}}.dump();
  // Inside a script element only "</" could end it early.
  for (size_t at = data.find("</"); at != std::string::npos; at = data.find("</", at + 3))
    data.insert(at + 1, "\\");
  return fmt::format(
      "<section><h2>Compare</h2><div id=viewer><div class=tools><select id=viewer-run></select> "
      "<select id=viewer-mode><option value=side>side by side<option value=wipe>wipe<option value=flip>flip"
      "<option value=difference>difference</select> <label>exposure <input id=viewer-stops type=range "
      "min=-12 max=12 step=0.25 value=0> <output id=viewer-exposure></output></label> "
      "<button id=viewer-fit>fit</button></div><div id=viewer-panes><canvas></canvas><canvas></canvas></div>"
      "<p id=viewer-values class=note>&nbsp;</p></div><p class=note>Wheel: zoom; drag: pan, both pictures at "
      "once. "
      "Wipe: left of the cursor the method, right of it the reference. Flip: click or space. Difference: "
      "mean "
      "over "
      "the channels of |method - reference| after exposure, the colours end at 0.1; magenta is not a number. "
      "Values are radiance, kept as 16-bit floats (0.05 %).</p><script type='application/json' "
      "id=viewer-data>{}</script></section>",
      data);
}

}  // namespace relight::report
