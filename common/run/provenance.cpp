#include "common/run/provenance.h"

#include <chrono>
#include <fstream>

#include <fmt/chrono.h>

#include "build_commit.h"
#include "common/run/thread_limit.h"

namespace relight {

namespace {

std::string compiler_name() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

std::string cpu_model() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);)
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

}  // namespace

Provenance collect_provenance(const std::string& gl_renderer, const std::string& gl_version) {
  Provenance provenance;
  provenance.commit = RELIGHT_BUILD_COMMIT;
  provenance.dirty = RELIGHT_BUILD_DIRTY;
  provenance.compiler = compiler_name();
  provenance.build_type = RELIGHT_BUILD_TYPE;
  provenance.cpu = cpu_model();
  provenance.threads = static_cast<int>(ThreadLimit::current());
  provenance.gl_renderer = gl_renderer;
  provenance.gl_version = gl_version;
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  provenance.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
  return provenance;
}

}  // namespace relight
