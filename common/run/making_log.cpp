#include "common/run/making_log.h"

#include <cstring>

#include <nlohmann/json.hpp>

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

StageLog difference(const StageLog& after, const StageLog& before) {
  StageLog out;
  std::map<std::string, double> earlier(before.stages().begin(), before.stages().end());
  for (const auto& [stage, seconds] : after.stages())
    if (!earlier.count(stage) || seconds != earlier[stage])
      out.add_seconds(stage, seconds - (earlier.count(stage) ? earlier[stage] : 0.0));
  for (const auto& [counter, n] : after.counters()) {
    const auto was = before.counters().find(counter);
    if (was == before.counters().end() || n != was->second)
      out.count(counter, was == before.counters().end() ? n : n - was->second);
  }
  for (const auto& [artefact, n] : after.bytes()) {
    const auto was = before.bytes().find(artefact);
    if (was == before.bytes().end() || n != was->second) out.bytes(artefact, n);
  }
  for (size_t i = before.warnings().size(); i < after.warnings().size(); ++i) out.warn(after.warnings()[i]);
  return out;
}

std::vector<std::byte> to_bytes(const MakingLog& made) {
  Json stages = Json::object();
  for (const auto& [stage, seconds] : made.log.stages()) stages[stage] = seconds;
  const Json json = {{"seconds", made.seconds},
                     {"stages", stages},
                     {"counters", made.log.counters()},
                     {"bytes", made.log.bytes()},
                     {"warnings", made.log.warnings()}};
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::vector<std::byte> bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

std::optional<MakingLog> making_log_from_bytes(const std::vector<std::byte>& bytes) {
  try {
    const char* text = reinterpret_cast<const char*>(bytes.data());
    const Json json = Json::parse(text, text + bytes.size());
    MakingLog made;
    made.seconds = json.at("seconds").get<double>();
    for (const auto& [stage, seconds] : json.at("stages").items())
      made.log.add_seconds(stage, seconds.get<double>());
    for (const auto& [counter, n] : json.at("counters").items()) made.log.count(counter, n.get<int64_t>());
    for (const auto& [artefact, n] : json.at("bytes").items()) made.log.bytes(artefact, n.get<int64_t>());
    for (const auto& sentence : json.at("warnings")) made.log.warn(sentence.get<std::string>());
    made.log.add_restored_seconds(made.seconds);
    return made;
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

}  // namespace relight
