#include "common/scene/files/keyframes_toml.h"

#include <algorithm>

#include "common/run/error.h"

namespace relight {

namespace {

glm::vec3 read_field(const TomlTable& table, const LightField& field) {
  const NumberRange range{field.min, field.max, field.open_min};
  if (field.kind == FieldKind::number)
    return glm::vec3(static_cast<float>(table.number(field.name, 0.0, range)));
  if (field.kind == FieldKind::colour) return table.colour(field.name, {}, range);
  return table.vector(field.name, {}, range);
}

// Adds the fields that this keyframe has to their tracks.
void add_keyframe(const TomlTable& keyframe, double time, LightType type, std::vector<LightTrack>& tracks) {
  bool any = false;
  for (const LightField& field : light_fields(type)) {
    if (!keyframe.has(field.name)) continue;
    any = true;
    const auto found = std::find_if(tracks.begin(), tracks.end(),
                                    [&](const LightTrack& track) { return track.field == field.name; });
    LightTrack& track = found == tracks.end() ? tracks.emplace_back() : *found;
    track.field = field.name;
    track.times.push_back(time);
    track.values.push_back(read_field(keyframe, field));
  }
  keyframe.refuse_unknown_keys();
  if (!any) fail("{}: a keyframe needs a field besides its time", keyframe.where());
}

}  // namespace

FieldValues read_light_fields(const TomlTable& table, LightType type) {
  FieldValues values;
  for (const LightField& field : light_fields(type)) {
    if (field.required) table.require(field.name);
    if (table.has(field.name)) values[field.name] = read_field(table, field);
  }
  return values;
}

std::vector<LightTrack> read_keyframes(const TomlTable& table, LightType type) {
  const bool spline = table.text("motion", "linear", {"linear", "catmull_rom"}) == "catmull_rom";
  std::vector<LightTrack> tracks;
  double before = 0.0;
  bool first = true;
  for (const TomlTable& keyframe : table.tables("keyframe")) {
    keyframe.require("time");
    const double time = keyframe.number("time", 0.0);
    if (!first && !(time > before))
      fail("{}: {} is not after the keyframe before, {}", keyframe.where("time"), time, before);
    first = false, before = time;
    add_keyframe(keyframe, time, type, tracks);
  }
  if (tracks.empty() && table.has("motion")) fail("{}: this light has no keyframes", table.where("motion"));
  for (LightTrack& track : tracks)
    track.spline = spline && find_light_field(type, track.field)->kind == FieldKind::position;
  return tracks;
}

}  // namespace relight
