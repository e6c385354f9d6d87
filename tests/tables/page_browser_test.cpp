// The page in a real browser, without a network: sorting, choices, toggles, hover and the CSV. Skipped,
// saying so, where no Chromium is installed (Debian: chromium). A script added at the page's end does what a
// person would do with the mouse.
#include <gtest/gtest.h>

#include <cstdlib>

#include <fmt/format.h>

#include "page_folder.h"

namespace relight::test {
namespace {

bool has_browser() { return std::system("command -v chromium > /dev/null 2>&1") == 0; }

#define SKIP_WITHOUT_BROWSER() \
  if (!has_browser()) GTEST_SKIP() << "no Chromium on this machine (Debian package: chromium)"

// Opens the page at #state, runs `script`, and returns what that wrote with say().
std::string in_browser(const PageFolder& folder, const std::string& script, const std::string& state = "") {
  const std::string page = folder.page();
  const std::string added =
      "<script>(() => { const out = []; const say = x => out.push(String(x)); const $ = s => "
      "document.querySelector(s), $$ = s => [...document.querySelectorAll(s)]; try {" +
      script +
      "} catch (error) { say(error); } const pre = document.createElement('pre'); pre.id = 'said'; "
      "pre.textContent = 'SAID:' + out.join('|') + ':END'; document.body.append(pre); })();</script></body>";
  std::string changed = page;
  changed.replace(changed.rfind("</body>"), 7, added);
  std::ofstream(folder.path / "test.html") << changed;
  const std::string command = fmt::format(
      "chromium --headless --no-sandbox --disable-gpu --user-data-dir={0}/profile --virtual-time-budget=3000 "
      "--dump-dom 'file://{0}/test.html#{1}' > {0}/dom.html 2> {0}/browser.log",
      folder.path.string(), state);
  if (std::system(command.c_str()) != 0) return "the browser failed";
  const std::string dom = text_of(folder.path / "dom.html");
  const size_t begin = dom.rfind("SAID:"), end = dom.rfind(":END");
  return begin == std::string::npos ? "nothing was said" : dom.substr(begin + 5, end - begin - 5);
}

// The methods in the order of the rows, after one and two clicks on the column of relight times.
TEST(ExperimentPageInABrowser, SortsByNumberAndDownloadsWhatItShows) {
  SKIP_WITHOUT_BROWSER();
  const PageFolder folder(planted_methods());
  const std::string said = in_browser(folder, R"js(
    const table = $('#t-runs'), heads = [...table.tHead.rows[0].cells];
    const at = heads.findIndex(th => th.textContent.startsWith('relight'));
    const order = () => say([...table.tBodies[0].rows].map(r => r.cells[3].textContent + r.cells[4].textContent[0]));
    const csv = () => decodeURIComponent(table.querySelector('a.csv').href.split(',').slice(1).join(','));
    heads[at].click(); order();
    heads[at].click(); order(); say(heads[at].getAttribute('aria-sort'));
    const lines = csv().trim().split('\n');
    say(lines.length); say(lines[0]); say(lines[1]);
  )js");
  EXPECT_EQ(
      said,
      "leaks_nanp,exactp,too_darkp,path_tracingp,slowp,path_tracingl|"
      "path_tracingl,slowp,path_tracingp,exactp,too_darkp,leaks_nanp|descending|7|"
      "scene,lights,view,method,run,relative %,edges out %,indirect %,noise floor %,bias %,relight (ms),"
      "precompute (s),memory (bytes),remarks|"
      "box,spot,64x48,path_tracing,long,0.5,0.25,1,0.1,0,1000,0,0,");
}

// Five good runs of four methods; the failed one is not drawn. Red if a toggle, a choice or the address is
// ignored, or the tables do not follow.
TEST(ExperimentPageInABrowser, DrawsWhatIsChosenAndHidesWhatIsNot) {
  SKIP_WITHOUT_BROWSER();
  const PageFolder folder(planted_methods());
  const std::string said = in_browser(folder, R"js(
    const points = () => say($$('.plot g.point').length + ' ' + $$('.plot path.front').length);
    const shown = () => $$('.choice').filter(e => !e.hidden).map(e => e.dataset.error + ' ' + e.dataset.cost);
    points(); say($$('.plot line.floor').length); say($$('.plot .ring').length);
    $('#legend button[data-method=slow]').click(); points();
    say($('#legend button[data-method=slow]').getAttribute('aria-pressed'));
    $('#legend button[data-method=slow]').click(); points();
    say([...new Set(shown())]);
    $('#cost-choice').value = 'memory'; $('#cost-choice').dispatchEvent(new Event('change'));
    say([...new Set(shown())]); points();
  )js");
  EXPECT_EQ(said, "5 4|1|2|4 3|false|5 4|relative relight|relative memory|5 4");
  const std::string linked = in_browser(folder, R"js(
    say($('#error-choice').value + ' ' + $('#cost-choice').value); say($$('.plot g.point').length);
  )js",
                                        "error=indirect&cost=precompute&off=exact,slow");
  EXPECT_EQ(linked, "indirect precompute|3");
}

// Red if a point shows another run's numbers, or bars do not reach the ends of their intervals.
TEST(ExperimentPageInABrowser, TellsWhatIsUnderThePointer) {
  SKIP_WITHOUT_BROWSER();
  const PageFolder folder(planted_methods());
  const std::string said = in_browser(folder, R"js(
    const g = $('.plot g.point[data-method=slow]');
    g.dispatchEvent(new PointerEvent('pointerenter')); say($('#tip').textContent.replaceAll('\n', '; ')); say($('#tip').hidden);
    g.dispatchEvent(new PointerEvent('pointerleave')); say($('#tip').hidden);
    const [time, error] = g.querySelectorAll('.bar line'), l = (e, a) => +e.getAttribute(a);
    say(l(time, 'x1') < l(time, 'x2') && l(time, 'y1') === l(time, 'y2') && l(error, 'y1') > l(error, 'y2'));
    say($$('.plot a').length);
  )js");
  EXPECT_EQ(said, "slow paper; 1 % (0.9 % to 1.1 %); 100 ms (90 ms to 110 ms)|false|true|true|0");
}

}  // namespace
}  // namespace relight::test
