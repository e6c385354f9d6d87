#include "experiments/effects/plan_effects.h"

#include <algorithm>
#include <chrono>

#include "common/run/error.h"
#include "common/sampling/random.h"
#include "experiments/effects/planner.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

constexpr uint64_t pilot_stream = 0x656666656374;
// A view of this size shows everything that matters to a norm over all pixels; smaller views get more paths.
constexpr int pilot_pixels = 160 * 120;
constexpr int samples_a_replicate = 4, most_samples_a_replicate = 64;
constexpr int rounds[] = {8, 16, 32};  // replicates

std::string percent(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

std::string interval_words(const LossInterval& loss) {
  return fmt::format("{} [{} to {}]", percent(loss.value), percent(loss.low), percent(loss.high));
}

int samples_for(const View& view) {
  const int pixels = view.width * view.height;
  const int samples = samples_a_replicate * pilot_pixels / std::max(pixels, 1);
  return std::clamp(samples / 4 * 4, samples_a_replicate, most_samples_a_replicate);
}

// Lights that only the GPU can evaluate.
bool has_user_shader(const LightingState& lighting) {
  return std::any_of(lighting.lights.begin(), lighting.lights.end(),
                     [](const Light& l) { return l.type == LightType::shader; });
}

std::vector<LightNote> light_notes(const LightingState& lighting) {
  std::vector<LightNote> notes;
  for (const Light& light : lighting.lights) {
    if (light.intensity == glm::vec3(0.0f))
      notes.push_back({light.name, "not shaded and no shadows: its intensity is 0"});
    else if (!light.casts_shadows)
      notes.push_back(
          {light.name, "no shadow map and no shadow rays: it casts none (casts_shadows = false)"});
  }
  return notes;
}

class Planner {
 public:
  Planner(const EffectRequest& request, const EffectSite& site, Progress& progress)
      : request_(request),
        site_(site),
        progress_(progress),
        plannable_(plannable_effects(request)),
        effects_(plannable_.effects),
        paths_(request.method, request.knobs, effects_),
        decisions_(effects_.size()) {}

  EffectPlan plan() {
    plan_.tolerance = request_.tolerance;
    plan_.asked = request_.asked;
    plan_.lights = light_notes(site_.lighting);
    plan_.everything = paths_.paths(paths_.everything()).to_string();
    apply_user_and_rules();
    if (has_user_shader(site_.lighting))
      give_up(
          "a light has a shader of its own, which only the GPU can run: what no rule leaves out is computed");
    else if (open_questions())
      measure();
    describe_levels();
    plan_.effects = decisions_;
    plan_.effects.insert(plan_.effects.end(), plannable_.fixed.begin(), plannable_.fixed.end());
    return plan_;
  }

 private:
  bool asked(size_t e) const { return request_.asked.count(effects_[e].name) != 0; }

  void apply_user_and_rules() {
    levels_ = paths_.everything();
    for (size_t e = 0; e < effects_.size(); ++e) {
      EffectDecision& d = decisions_[e];
      d.effect = effects_[e].name, d.sentence = effects_[e].sentence;
      d.everything = effects_[e].levels.back().name;
      if (!asked(e)) continue;
      levels_[e] = find_level(effects_[e], request_.asked.at(effects_[e].name));
      d.by = DecidedBy::user;
      d.reason = "--effect";
    }
    const SceneFacts facts = scene_facts(site_);
    const Levels before = levels_;
    for (size_t e = 0; e < effects_.size(); ++e) {
      if (asked(e)) continue;
      const Rule rule = rule_for(e, effects_, paths_, before, site_, facts);
      if (rule.reason.empty()) continue;
      levels_[e] = rule.level;
      decisions_[e].by = DecidedBy::rule;
      decisions_[e].reason = rule.reason;
    }
    base_ = levels_;
  }

  // Is there anything to decide, or to tell of what the user decided?
  bool open_questions() const {
    for (size_t e = 0; e < effects_.size(); ++e)
      if (asked(e) ? levels_[e] + 1 < effects_[e].levels.size() : levels_[e] > 0) return true;
    return false;
  }

  void give_up(const std::string& why) {
    plan_.warnings.push_back(why);
    for (size_t e = 0; e < effects_.size(); ++e)
      if (!asked(e) && levels_[e] > 0) decisions_[e].reason = "not measured: computed to be safe";
  }

  void measure() {
    const View view = smaller_view(site_.buffer.view, pilot_pixels);
    const bool same = view.width == site_.buffer.view.width && view.height == site_.buffer.view.height;
    DeepFrameBuffer small;
    if (!same) small = make_deep_frame_buffer(site_.scene, site_.tracer, view);
    const EffectSite pilot_site{site_.scene, site_.tracer, same ? site_.buffer : small, site_.lighting};
    Pilot pilot = make_pilot(pilot_site, paths_, samples_for(view),
                             random_bits(request_.seed, pilot_stream, 0, 0), progress_);
    for (const int replicates : rounds) {
      pilot.trace(replicates);
      levels_ = base_;
      if (decide(pilot_site, pilot.light())) break;
    }
    const LightByGroup& light = pilot.light();
    plan_.pilot_width = view.width, plan_.pilot_height = view.height;
    plan_.pilot_samples = light.samples, plan_.pilot_rays = light.rays;
    if (light.non_finite > 0)
      plan_.warnings.push_back(fmt::format(
          "pilot: {} samples were not finite and were replaced by zero: its shares are not to be trusted",
          light.non_finite));
  }

  // Lowers levels as far as the tolerance goes. False if a level could not be decided with these replicates.
  bool decide(const EffectSite& pilot_site, const LightByGroup& light) {
    const LossOfLevels loss(effects_, pilot_site, light, paths_, paths_.everything());
    while (lower_one(loss)) {
    }
    bool all_decided = true;
    const Levels everything = paths_.everything();
    for (size_t e = 0; e < effects_.size(); ++e) {
      EffectDecision& d = decisions_[e];
      Levels alone = everything;
      alone[e] = levels_[e];
      d.loss = d.by == DecidedBy::rule && levels_[e] == base_[e] ? LossInterval{}
                                                                 : loss.between(everything, alone);
      if (asked(e)) continue;
      d.next_loss.reset();
      d.undecided = false;
      if (levels_[e] == 0) {
        if (d.by != DecidedBy::rule)
          d.reason = d.loss.high > 0.0 ? "what is left out stays below the tolerance"
                                       : "no light along such paths was found";
        continue;
      }
      d.by = DecidedBy::pilot;
      Levels next = levels_;
      --next[e];
      d.next_loss = loss.between(base_, next);
      d.undecided = d.next_loss->low < request_.tolerance;
      all_decided = all_decided && !d.undecided;
      d.reason = fmt::format("level {} would lose {}{}", effects_[e].levels[next[e]].name,
                             interval_words(*d.next_loss),
                             d.undecided ? ", which could not be decided: computed to be safe" : "");
    }
    Levels from = everything;
    for (size_t e = 0; e < effects_.size(); ++e)
      if (!asked(e)) from[e] = base_[e];  // what rules left out is nothing
    plan_.loss = loss.between(from, levels_);
    plan_.beyond = loss.beyond();
    return all_decided;
  }

  // Lowers the level whose step loses least, if the whole plan's loss stays within the tolerance.
  bool lower_one(const LossOfLevels& loss) {
    std::optional<size_t> best;
    double least = request_.tolerance;
    for (size_t e = 0; e < effects_.size(); ++e) {
      if (asked(e) || levels_[e] == 0) continue;
      Levels next = levels_;
      --next[e];
      const double high = loss.between(base_, next).high;
      if (high > least || (best && high == least)) continue;
      best = e, least = high;
    }
    if (best) --levels_[*best];
    return best.has_value();
  }

  void describe_levels() {
    for (size_t e = 0; e < effects_.size(); ++e) {
      const EffectLevel& level = effects_[e].levels[levels_[e]];
      decisions_[e].level = level.name;
      decisions_[e].settings = level.knobs;
    }
  }

  const EffectRequest& request_;
  const EffectSite& site_;
  Progress& progress_;
  PlannableEffects plannable_;
  const std::vector<Effect>& effects_;
  EffectPaths paths_;
  std::vector<EffectDecision> decisions_;
  Levels levels_, base_;  // chosen; after the user's words and the rules
  EffectPlan plan_;
};

}  // namespace

EffectPlan plan_effects(const EffectRequest& request, const EffectSite& site, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  EffectPlan plan = Planner(request, site, progress).plan();
  plan.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return plan;
}

KnobValues planned_knobs(const KnobValues& knobs, const EffectPlan& plan) {
  KnobValues planned = knobs;
  for (const EffectDecision& d : plan.effects)
    for (const auto& [knob, value] : d.settings) planned.set(knob, value);
  return planned;
}

KnobValues everything_knobs(const EffectRequest& request) {
  const PlannableEffects plannable = plannable_effects(request);
  const EffectPaths paths(request.method, request.knobs, plannable.effects);
  return paths.knobs(paths.everything());
}

void require_effects(const std::map<std::string, std::string>& asked,
                     const std::vector<const Method*>& methods) {
  std::set<std::string> valid;
  for (const Method* method : methods)
    for (const Effect& effect : method->effects(KnobValues(method->knobs()))) {
      valid.insert(effect.name);
      if (asked.count(effect.name)) find_level(effect, asked.at(effect.name));
    }
  for (const auto& [name, level] : asked)
    if (!valid.count(name))
      usage_fail("--effect {}={}: no method of this run has that effect; valid: {}", name, level,
                 valid.empty() ? "none" : fmt::format("{}", fmt::join(valid, ", ")));
}

}  // namespace relight
