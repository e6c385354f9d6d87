#include "methods/direct_to_indirect/artefact.h"

#include <fmt/format.h>

#include "common/run/byte_stream.h"
#include "common/run/cached_artefact.h"
#include "common/run/error.h"
#include "methods/direct_to_indirect/light_points.h"

namespace relight::direct_to_indirect {
namespace {

constexpr int precompute_version = 15;

std::string versioned(const std::string& words) {
  return fmt::format("version={};layout={},{},{};{}", precompute_version, sizeof(SurfaceSample),
                     sizeof(SparseEntry), sizeof(SparseEntryRgb), words);
}

void append_rows(std::vector<std::byte>& out, const SparseRows& rows) {
  append_values(out, rows.row_start);
  append_values(out, rows.entries);
}

SparseRows next_rows(ByteReader& reader, uint32_t columns) {
  SparseRows rows;
  rows.columns = columns;
  rows.row_start = reader.next<uint64_t>();
  rows.entries = reader.next<SparseEntry>();
  return rows;
}

// After everything else, or nothing.
EnvironmentTransfer next_environment(ByteReader& reader, size_t gather_samples, size_t glossy_pixels) {
  EnvironmentTransfer e;
  if (reader.at_end()) return e;
  const std::vector<uint32_t> columns = reader.next<uint32_t>();
  if (columns.size() != 1) fail("cached artefact: inconsistent sizes");
  e.view = next_rows(reader, columns[0]);
  e.glossy = next_rows(reader, columns[0]);
  e.gather = next_rows(reader, columns[0]);
  if (e.gather.rows() != gather_samples || e.glossy.rows() != glossy_pixels)
    fail("cached artefact: inconsistent sizes");
  return e;
}

}  // namespace

bool wants_environment(const PrepareContext& context) {
  const std::string& knob = context.knobs.choice("environment");
  return knob == "on" || (knob == "auto" && context.has_environment());
}

std::string cache_key(const PrepareContext& context) {
  return fmt::format("{};{}{}", versioned(pixel_words(context)), context.knobs.precompute_key(),
                     wants_environment(context) ? ";with environment" : "");
}

std::string view_key(const PrepareContext& context) { return versioned(view_words(context)); }

std::vector<std::byte> to_bytes(const Artefact& artefact) {
  std::vector<std::byte> out;
  const FinalGather& f = artefact.final_gather;
  append_values(out, std::vector<uint32_t>{f.diffuse.columns});
  append_values(out, artefact.cloud.samples);
  append_values(out, artefact.cloud.area);
  append_values(out, artefact.light_points);
  append_values(out, f.diffuse.row_start);
  append_values(out, f.diffuse.entries);
  append_values(out, f.glossy_pixels);
  append_values(out, f.glossy.row_start);
  append_values(out, f.glossy.entries);
  const MultiBounce& m = artefact.multi_bounce;
  append_values(out, std::vector<int32_t>{m.bounces});
  append_values(out, std::vector<double>{m.share_beyond});
  append_values(out, m.photons.row_start);
  append_values(out, m.photons.entries);
  append_values(out, m.transfer.row_start);
  append_values(out, m.transfer.entries);
  const EnvironmentTransfer& e = artefact.environment;
  if (e.empty()) return out;
  append_values(out, std::vector<uint32_t>{e.view.columns});
  for (const SparseRows* rows : {&e.view, &e.glossy, &e.gather}) append_rows(out, *rows);
  return out;
}

Artefact from_bytes(const std::vector<std::byte>& bytes) {
  ByteReader reader(bytes);
  Artefact artefact;
  const std::vector<uint32_t> columns = reader.next<uint32_t>();
  artefact.cloud.samples = reader.next<SurfaceSample>();
  artefact.cloud.area = reader.next<float>();
  artefact.light_points = reader.next<SurfaceSample>();
  FinalGather& f = artefact.final_gather;
  f.diffuse.row_start = reader.next<uint64_t>();
  f.diffuse.entries = reader.next<SparseEntry>();
  f.glossy_pixels = reader.next<uint32_t>();
  f.glossy.row_start = reader.next<uint64_t>();
  f.glossy.entries = reader.next<SparseEntry>();
  const std::vector<int32_t> bounces = reader.next<int32_t>();
  const std::vector<double> share_beyond = reader.next<double>();
  MultiBounce& m = artefact.multi_bounce;
  m.photons.row_start = reader.next<uint64_t>();
  m.photons.entries = reader.next<SparseEntryRgb>();
  m.transfer.row_start = reader.next<uint64_t>();
  m.transfer.entries = reader.next<SparseEntry>();
  if (columns.size() != 1 || columns[0] != artefact.cloud.samples.size() || bounces.size() != 1 ||
      share_beyond.size() != 1 ||
      (!artefact.light_points.empty() &&
       artefact.light_points.size() != light_points_a_sample * artefact.cloud.samples.size()) ||
      f.glossy_pixels.size() != f.glossy.rows())
    fail("cached artefact: inconsistent sizes");
  f.diffuse.columns = f.glossy.columns = m.photons.columns = m.transfer.columns = columns[0];
  m.bounces = bounces[0];
  m.share_beyond = share_beyond[0];
  artefact.environment = next_environment(reader, artefact.cloud.samples.size(), f.glossy_pixels.size());
  return artefact;
}

}  // namespace relight::direct_to_indirect
