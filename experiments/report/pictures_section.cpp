#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "common/image/exr.h"
#include "common/image/false_colour.h"
#include "experiments/compare/image_files.h"
#include "experiments/report/data_uri.h"
#include "experiments/report/html.h"
#include "experiments/report/sections.h"

namespace relight::report {

namespace {

namespace fs = std::filesystem;

std::optional<Image> read_if_there(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  return read_exr(file);
}

Image exposed(Image image, double exposure) {
  for (glm::vec3& pixel : image.pixels) pixel *= static_cast<float>(exposure);
  return image;
}

// The two images of one comparison ("total" and "reference", "indirect" and "reference_indirect"), after
// exposure.
struct Pair {
  Image method, reference;
};

std::optional<Pair> read_pair(const fs::path& folder, const RunRecord& record, bool indirect) {
  if (!record.errors) return std::nullopt;
  auto method = read_if_there(image_file(folder, record.method, indirect ? "indirect" : "total"));
  auto reference =
      read_if_there(image_file(folder, record.method, indirect ? "reference_indirect" : "reference"));
  if (!method || !reference) return std::nullopt;
  return Pair{exposed(std::move(*method), record.exposure), exposed(std::move(*reference), record.exposure)};
}

std::string picture(const std::string& uri, const std::string& caption) {
  return fmt::format("<figure><img src='{}' alt='{}'><figcaption>{}</figcaption></figure>", uri, caption,
                     caption);
}

std::string missing(const std::string& caption, const RunRecord& record) {
  const std::string why =
      record.failed_stages.empty() ? "image file missing" : "failed: " + record.failed_stages[0];
  return fmt::format("<figure><div class=missing>{}</div><figcaption>{}</figcaption></figure>", escaped(why),
                     caption);
}

// sRGB (IEC 61966-2-1) of a linear colour.
std::string css_colour(const glm::vec3& linear) {
  const auto code = [](float c) {
    const double s = c <= 0.0031308f ? 12.92 * c : 1.055 * std::pow(static_cast<double>(c), 1.0 / 2.4) - 0.055;
    return std::lround(255.0 * std::clamp(s, 0.0, 1.0));
  };
  return fmt::format("rgb({},{},{})", code(linear.x), code(linear.y), code(linear.z));
}

// One rectangle a step rather than a gradient: gradients need an id, and the bar appears more than once.
std::string colour_bar(double full_scale) {
  constexpr int steps = 60, step_width = 5, left = 10;
  std::string shapes;
  for (int i = 0; i < steps; ++i) {
    shapes += fmt::format("<rect x='{}' y='8' width='{}' height='20' fill='{}'/>", left + step_width * i,
                          step_width + 1, css_colour(false_colour((i + 0.5) / steps)));
  }
  for (int i = 0; i <= 2; ++i) {
    shapes += fmt::format("<text x='{}' y='44' text-anchor='{}'>{:.3g}</text>", left + steps * step_width * i / 2,
                          i == 0 ? "start" : i == 1 ? "middle" : "end", full_scale * i / 2.0);
  }
  return fmt::format(
      "<div class=bar><svg viewBox='0 0 320 50' role=img aria-label='colour bar'>{}</svg><p>Absolute difference after "
      "exposure, mean of the channels; one scale for every difference on this page (99&#8239;% of the pixels of the "
      "worst picture lie below its end). Magenta: not a number.</p></div>",
      shapes);
}

// Methods with the same reference share one block of the page.
std::vector<std::string> distinct_references(const Records& records) {
  std::vector<std::string> paths;
  for (const RunRecord& r : records) {
    if (std::find(paths.begin(), paths.end(), r.reference_paths) == paths.end())
      paths.push_back(r.reference_paths);
  }
  return paths;
}

double common_scale(const Records& records, const fs::path& folder) {
  double scale = 0.0;
  for (const RunRecord& r : records) {
    for (const bool indirect : {false, true}) {
      if (const auto pair = read_pair(folder, r, indirect)) {
        scale = std::max(scale, difference_scale(pair->method, pair->reference));
      }
    }
  }
  return scale > 0.0 ? scale : 1.0;
}

// Two rows: the pictures (the reference first), and below each its difference (below the reference the colour
// bar).
std::string rows(const Records& block, const fs::path& folder, bool indirect, double scale) {
  const char* what = indirect ? "indirect light" : "total";
  std::string reference = fmt::format("<figure><div class=missing>no reference</div></figure>");
  std::string pictures, differences;
  bool have_reference = false;
  for (const RunRecord& r : block) {
    const std::string name = escaped(r.method);
    const auto pair = read_pair(folder, r, indirect);
    if (!pair) {
      pictures += missing(fmt::format("{}, {}", name, what), r);
      differences += missing(fmt::format("{}, difference", name), r);
      continue;
    }
    if (!have_reference) {
      reference = picture(png_data_uri(pair->reference, 1.0f, folder), fmt::format("Reference, {}", what));
      have_reference = true;
    }
    pictures += picture(png_data_uri(pair->method, 1.0f, folder), fmt::format("{}, {}", name, what));
    differences += picture(png_data_uri(difference_image(pair->method, pair->reference, scale), 1.0f, folder),
                           fmt::format("{}, |difference| of {}", name, what));
  }
  return reference + pictures + colour_bar(scale) + differences;
}

}  // namespace

std::string pictures_section(const Records& records, const fs::path& folder) {
  const double scale = common_scale(records, folder);
  std::string html = "<section><h2>Pictures</h2>";
  for (const std::string& paths : distinct_references(records)) {
    Records block;
    std::copy_if(records.begin(), records.end(), std::back_inserter(block),
                 [&](const RunRecord& r) { return r.reference_paths == paths; });
    html += fmt::format("<h3>Compared on {}</h3>", escaped(paths));
    html += fmt::format("<div class=grid style='--columns:{}'>{}{}</div>", block.size() + 1,
                        rows(block, folder, false, scale), rows(block, folder, true, scale));
  }
  return html +
         fmt::format("<p class=note>Exposure {:.4g}, sRGB. Click a picture to enlarge it.</p></section>",
                     records.front().exposure);
}

}  // namespace relight::report
