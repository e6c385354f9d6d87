#include "experiments/render/render_frames.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>

#include "common/lights/light_animation.h"
#include "common/lights/light_words.h"
#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "experiments/compare/plan.h"
#include "experiments/render/picture.h"
#include "experiments/session/session.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

std::string words(const glm::vec3& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

// Everything that decides how frame n looks, in words.
std::string description(const RenderOptions& options, const MethodPlan& plan, const Session& session,
                        double fps) {
  const View& view = session.buffer().view;
  const Camera& camera = view.camera;
  std::string text = fmt::format(
      "method {}\nimage {}\nscene {:016x}\ncamera eye {} target {} up {} fov_y {}\nview {}x{}\nexposure "
      "{}\nseed {}\nframes_a_second {}\n",
      plan.method->name(), options.image, session.scene().content_hash, words(camera.eye),
      words(camera.target), words(camera.up), camera.fov_y_degrees, view.width, view.height,
      session.scene().exposure, options.session.seed, fps);
  for (const auto& [knob, value] : plan.knobs.all()) text += fmt::format("{} {}\n", knob, value);
  return text + describe(session.animated_lighting());
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::filesystem::path description_file(const std::filesystem::path& out) {
  return out.parent_path() / (out.stem().string() + "_frames.txt");
}

// The frames that remain to be made.
std::vector<Frame> missing_frames(const RenderOptions& options, const std::vector<Frame>& frames,
                                  const std::string& now) {
  const std::filesystem::path file = description_file(options.out);
  if (!options.resume || !std::filesystem::exists(file)) return frames;
  if (read_file(file) != now)
    fail(
        "--resume: '{}' says that the frames there were made from something else; leave out --resume, or "
        "choose another --out",
        file.string());
  std::vector<Frame> missing;
  for (const Frame& frame : frames)
    if (!std::filesystem::exists(frame_file(options.out, frame.number))) missing.push_back(frame);
  return missing;
}

struct Totals {
  double seconds = 0.0;  // of relighting
  double slowest = 0.0;
  StageLog log;
  int64_t counter(const char* name) const {
    const auto found = log.counters().find(name);
    return found == log.counters().end() ? 0 : found->second;
  }
};

void render_one(const RenderOptions& options, Session& session, Prepared& prepared, const Frame& frame,
                Totals& totals) {
  const auto start = std::chrono::steady_clock::now();
  const Relit relit = prepared.relight(lighting_at(session.animated_lighting(), frame.time), totals.log);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  totals.seconds += seconds, totals.slowest = std::max(totals.slowest, seconds);
  write_picture(frame_file(options.out, frame.number), relit, options.image, session.scene().exposure,
                {{"relight.method", options.method},
                 {"relight.image", options.image},
                 {"relight.time", fmt::format("{}", frame.time)}});
}

std::string summary(const std::vector<Frame>& frames, size_t made, const Totals& totals,
                    const RenderOptions& options) {
  std::string text = fmt::format("{} frames, {} of them made now", frames.size(), made);
  if (made > 0)
    text += fmt::format(
        "; relight {:.1f} ms a frame, {:.1f} ms the slowest\nlights shaded {}, from the light cache {}; "
        "shadow "
        "maps {}, shadow rays {}",
        1e3 * totals.seconds / static_cast<double>(made), 1e3 * totals.slowest,
        totals.counter("lights_shaded"), totals.counter("lights_cached"),
        totals.counter("shadow_maps_rendered"), totals.counter("shadow_rays"));
  return text + fmt::format("\nfrom    {}\nto      {}\n",
                            frame_file(options.out, frames.front().number).string(),
                            frame_file(options.out, frames.back().number).string());
}

}  // namespace

std::filesystem::path frame_file(const std::filesystem::path& out, int number) {
  return out.parent_path() /
         fmt::format("{}_{:04d}{}", out.stem().string(), number, out.extension().string());
}

std::string render_frames(const RenderOptions& options, const std::vector<Frame>& frames,
                          const MethodList& methods) {
  const Method& method = find_method(methods, options.method);
  require_preset(options.preset, {&method});
  if (plan_effect_options(options.effects, {&method}))
    usage_fail(
        "--tolerance: effects are planned for one lighting, not for frames of a moving one; valid with --at");
  const MethodPlan plan = plan_method(method, parse_settings(options.settings, {&method}), options.preset);
  check_picture_options(options);
  Session session(options.session, Session::Gpu::needed);
  const std::string now = description(options, plan, session, options.fps);
  const std::vector<Frame> missing = missing_frames(options, frames, now);
  Totals totals;
  if (!missing.empty()) {
    // First the frames that would no longer belong, so that a run that is killed here can't be resumed into a
    // mixture.
    if (missing.size() == frames.size())
      for (const Frame& frame : frames) std::filesystem::remove(frame_file(options.out, frame.number));
    write_text_atomically(description_file(options.out), now);
    StageLog precompute;
    const PrepareContext context{session.scene(), session.tracer(),     session.buffer(),
                                 plan.knobs,      options.session.seed, *session.gpu(),
                                 session.cache(), session.progress(),   precompute,
                                 nullptr,         &session.lighting()};
    const auto prepared = method.prepare(context);
    Progress& progress = session.progress();
    progress.start("frames", static_cast<int64_t>(missing.size()));
    for (const Frame& frame : missing) {
      render_one(options, session, *prepared, frame, totals);
      progress.advance();
    }
    progress.finish();
  }
  return summary(frames, missing.size(), totals, options);
}

}  // namespace relight
