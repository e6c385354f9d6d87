#include "experiments/stored_references/commands.h"

#include <filesystem>

#include <fmt/format.h>

#include "experiments/options/text_table.h"
#include "experiments/session/output_folder.h"
#include "experiments/stored_references/decision.h"
#include "experiments/stored_references/files.h"
#include "experiments/stored_references/identity.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

std::vector<StoredReference> chosen(const ReferencesOptions& options) {
  if (options.names.empty()) return stored_references();
  std::vector<StoredReference> list;
  for (const std::string& name : options.names) list.push_back(stored_reference(name));
  return list;
}

Session open_session(const StoredReference& reference, bool quiet) {
  SessionOptions session = stored_session_options(reference);
  session.quiet = quiet;
  return Session(session, Session::Gpu::not_needed);
}

std::string lines_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += fmt::format("  {}\n", line);
  return text;
}

std::string check_one(const ReferencesOptions& options, const StoredReference& reference, bool& good) {
  const StoredPicture stored = load_stored(std::filesystem::path(options.folder) / reference.name);
  Session session = open_session(reference, options.quiet);
  const auto stale = stale_fields(stored.identity, picture_identity(reference, session));
  if (!stale.empty()) {
    good = false;
    return fmt::format("{}: STALE\n{}", reference.name, lines_of(stale));
  }
  BatchPlan plan = stored_plan(reference);
  plan.samples_per_batch = options.samples_per_batch;
  plan.seed = options.seed;
  const PictureStatistics fresh =
      render_statistics(session.tracer(), session.buffer(), session.lighting(), plan, session.progress());
  const Decision decision = compare_pictures(fresh, stored.picture);
  good = good && decision.same();
  return fmt::format("{}: {}\n{}", reference.name, decision.same() ? "same" : "DIFFERS",
                     decision.to_string());
}

std::string change_text(const std::filesystem::path& folder, const PictureStatistics& now,
                        const nlohmann::ordered_json& identity) {
  if (!is_stored(folder)) return "  new\n";
  const StoredPicture before = load_stored(folder);
  std::string text = lines_of(stale_fields(before.identity, identity));
  if (before.picture.direct.width != now.direct.width || before.picture.direct.height != now.direct.height)
    return text + "  of another size\n";
  return text + compare_pictures(now, before.picture).to_string() +
         fmt::format("  {:.2f} % of the tiles differ by more than 3 standard errors (0.27 % expected)\n",
                     100.0 * share_of_tiles_beyond(3.0, now, before.picture));
}

std::string update_one(const ReferencesOptions& options, const StoredReference& reference, bool& good) {
  const std::filesystem::path folder = std::filesystem::path(options.folder) / reference.name;
  Session session = open_session(reference, options.quiet);
  const PictureStatistics picture = render_statistics(session.tracer(), session.buffer(), session.lighting(),
                                                      stored_plan(reference), session.progress());
  if (picture.non_finite > 0) {
    good = false;
    return fmt::format("{}: NOT STORED, {} samples were not finite\n", reference.name, picture.non_finite);
  }
  const auto identity = picture_identity(reference, session);
  const std::string change = change_text(folder, picture, identity);
  save_stored(folder, picture, identity);
  return fmt::format("{}: stored, relative standard error {:.2f} %, {} fireflies, {:.0f} s\n{}",
                     reference.name, 100.0 * picture.relative_standard_error(), picture.fireflies,
                     picture.seconds, change);
}

}  // namespace

std::string list_references(const ReferencesOptions& options, bool& good) {
  TextTable table({"name", "scene", "lights", "samples", "error", "fireflies", "date"});
  for (const StoredReference& reference : chosen(options)) {
    const std::filesystem::path folder = std::filesystem::path(options.folder) / reference.name;
    const std::string samples = fmt::format("{} x {}", stored_batches, reference.samples_per_batch);
    if (!is_stored(folder)) {
      good = false;
      table.add_row({reference.name, reference.scene, reference.lights, samples, "MISSING", "", ""});
      continue;
    }
    const StoredPicture stored = load_stored(folder);
    table.add_row({reference.name, reference.scene, reference.lights, samples,
                   fmt::format("{:.2f} %", 100.0 * stored.picture.relative_standard_error()),
                   std::to_string(stored.picture.fireflies), stored.provenance.value("date", "")});
  }
  return table.to_string(3);
}

std::string check_references(const ReferencesOptions& options, bool& good) {
  if (options.samples_per_batch < 1) usage_fail("--samples {}: at least 1", options.samples_per_batch);
  std::string text;
  for (const StoredReference& reference : chosen(options)) text += check_one(options, reference, good);
  return text;
}

std::string update_references(const ReferencesOptions& options, bool& good) {
  const std::vector<StoredReference> list = chosen(options);
  require_writable_folder("--folder", options.folder);
  std::string text;
  for (const StoredReference& reference : list) text += update_one(options, reference, good);
  return text;
}

}  // namespace relight
