// The page in a real browser, without a network: what its script makes of the pictures. Skipped, saying so,
// where no Chromium is installed (Debian: chromium).
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "common/image/exr.h"
#include "common/run/run_record.h"
#include "experiments/compare/image_files.h"
#include "experiments/report/report.h"
#include "program.h"

namespace relight::test {
namespace {

namespace fs = std::filesystem;

constexpr int width = 8, height = 6;

// Values over six orders of magnitude, one of them not a number.
Image picture(float factor) {
  Image image(width, height);
  for (int i = 0; i < width * height; ++i)
    image.pixels[static_cast<size_t>(i)] =
        factor * glm::vec3(std::pow(10.0f, static_cast<float>(i % 7) - 3.0f), 0.5f, 0.125f);
  return image;
}

struct Page {
  fs::path folder = fs::temp_directory_path() / fmt::format("relight_browser_{}", ::getpid());
  Page() {
    fs::create_directories(folder);
    RunRecord r;
    r.scene = "box", r.view = "8x6", r.lighting = "spot";
    r.width = width, r.height = height;
    r.light_paths = r.reference_paths = "E D D L, 1 bounce, local lights";
    r.errors.emplace();
    r.errors_indirect = r.errors;
    r.exposure = 1.0;
    r.method = "method";
    append_record(folder / "records.jsonl", r);
    Image reference = picture(1.0f);
    reference.pixels[9] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    write_exr(image_file(folder, "method", "total"), picture(1.25f));
    write_exr(image_file(folder, "method", "reference"), reference);
    write_exr(image_file(folder, "method", "indirect"), picture(0.5f));
    write_exr(image_file(folder, "method", "reference_indirect"), picture(2.0f));
    write_report(folder);
  }
  ~Page() { fs::remove_all(folder); }

  // The document when its script says that it is ready. Virtual time stands still while the page waits for
  // the network, not while a busy machine decodes its pictures: then another try has more of it.
  std::string open(const std::string& state) const {
    std::string dom;
    for (const int budget : {5000, 20000, 80000}) {
      dom = open(state, budget);
      if (dom.find("data-ready=\"yes\"") != std::string::npos) break;
    }
    return dom;
  }

  std::string open(const std::string& state, int budget_ms) const {
    const fs::path dom = folder / "dom.html";
    const std::string command = fmt::format(
        "chromium --headless --no-sandbox --disable-gpu --user-data-dir={0}/profile "
        "--virtual-time-budget={3} "
        "--dump-dom 'file://{0}/index.html#{1}' > {2} 2> {0}/browser.log",
        folder.string(), state, dom.string(), budget_ms);
    if (std::system(command.c_str()) != 0) return "the browser failed";
    return read_text(dom);
  }
};

std::string values_line(const std::string& dom) {
  const size_t at = dom.find("pixel ");
  return at == std::string::npos ? dom.substr(0, 200) : dom.substr(at, dom.find('<', at) - at);
}

bool has_browser() { return std::system("command -v chromium > /dev/null 2>&1") == 0; }

// Pixel (3, 1) is number 11: 10 to the power of 1. Red if bytes are swapped, rows shifted, or the canvas
// changes colours (tried: the low bytes first; a gamma of the PNG).
TEST(ReportInABrowser, ShowsTheValuesOfTheImagesUnderTheCursor) {
  if (!has_browser()) GTEST_SKIP() << "no Chromium on this machine (Debian package: chromium)";
  const Page page;
  const std::string total = page.open("run=0&mode=wipe&x=3&y=1");
  EXPECT_NE(total.find("data-ready=\"yes\""), std::string::npos) << total.substr(0, 300);
  EXPECT_EQ(values_line(total),
            "pixel 3, 1: method, total 12.50 0.6250 0.1563; reference of method, total 10.00 0.5000 0.1250; "
            "difference 2.500 0.1250 0.03125");
  // The indirect pair, side by side, three stops up; values do not change with exposure.
  const std::string indirect = page.open("run=1&mode=side&stops=3&x=0&y=0");
  EXPECT_NE(values_line(indirect).find("indirect light 0.0005002 0.2500 0.06250"), std::string::npos)
      << values_line(indirect);
  EXPECT_NE(indirect.find("x 8.00"), std::string::npos);
}

// A value that is not a number stays one in every mode. Red if it is read as a number.
TEST(ReportInABrowser, SaysWhereAPixelIsNotANumber) {
  if (!has_browser()) GTEST_SKIP() << "no Chromium on this machine (Debian package: chromium)";
  const Page page;
  const std::string dom = page.open("run=0&mode=difference&x=1&y=1");
  EXPECT_NE(values_line(dom).find("total NaN NaN NaN; difference NaN"), std::string::npos)
      << values_line(dom);
}

}  // namespace
}  // namespace relight::test
