#include "methods/clustered_gather/artefact.h"

#include <fmt/format.h>

#include "common/run/byte_stream.h"
#include "common/run/cached_artefact.h"
#include "common/run/error.h"

namespace relight::clustered_gather {
namespace {

constexpr int precompute_version = 3;

}  // namespace

bool wants_environment(const PrepareContext& context) {
  const std::string& knob = context.knobs.choice("environment");
  return knob == "on" || (knob == "auto" && context.has_environment());
}

std::string cache_key(const PrepareContext& context) {
  return fmt::format("version={};layout={};{};{}{}", precompute_version, sizeof(LambertSample),
                     pixel_words(context), context.knobs.precompute_key(),
                     wants_environment(context) ? ";with environment" : "");
}

std::vector<std::byte> to_bytes(const Artefact& artefact) {
  std::vector<LambertSample> samples;
  samples.reserve(artefact.gather.samples.size());
  for (const SurfaceSample& s : artefact.gather.samples) samples.push_back(lambert_part(s));
  std::vector<std::byte> out;
  append_values(out, samples);
  samples = {};
  append_values(out, artefact.gather.first);
  for (const Links* links : {&artefact.diffuse, &artefact.glossy}) {
    append_values(out, std::vector<uint32_t>{links->per_pixel});
    append_values(out, links->pixel);
    append_values(out, links->cluster);
    append_values(out, links->weight);
  }
  const SparseRowsRgb& e = artefact.gather.environment;
  if (e.columns == 0) return out;
  append_values(out, std::vector<uint32_t>{e.columns});
  append_values(out, e.row_start);
  append_values(out, e.entries);
  return out;
}

Artefact from_bytes(const std::vector<std::byte>& bytes) {
  ByteReader reader(bytes);
  Artefact artefact;
  const std::vector<LambertSample> samples = reader.next<LambertSample>();
  artefact.gather.samples.reserve(samples.size());
  for (const LambertSample& s : samples) artefact.gather.samples.push_back(surface_sample(s));
  artefact.gather.first = reader.next<uint32_t>();
  for (Links* links : {&artefact.diffuse, &artefact.glossy}) {
    const std::vector<uint32_t> per_pixel = reader.next<uint32_t>();
    links->pixel = reader.next<uint32_t>();
    links->cluster = reader.next<uint32_t>();
    links->weight = reader.next<float>();
    if (per_pixel.size() != 1 || links->cluster.size() != links->weight.size() ||
        links->cluster.size() != links->pixel.size() * per_pixel[0])
      fail("cached artefact: inconsistent sizes");
    links->per_pixel = per_pixel[0];
  }
  SparseRowsRgb& e = artefact.gather.environment;
  if (!reader.at_end()) {
    const std::vector<uint32_t> columns = reader.next<uint32_t>();
    e.row_start = reader.next<uint64_t>();
    e.entries = reader.next<SparseEntryRgb>();
    if (columns.size() != 1 || e.rows() + 1 != artefact.gather.first.size())
      fail("cached artefact: inconsistent sizes");
    e.columns = columns[0];
  }
  if (artefact.gather.first.empty() || artefact.gather.first.back() != artefact.gather.samples.size())
    fail("cached artefact: inconsistent sizes");
  return artefact;
}

}  // namespace relight::clustered_gather
