// Where a result comes from: the code, the compiler, the machine and the date.
#pragma once

#include <string>

namespace relight {

struct Provenance {
  std::string commit;                   // full git hash of the build; "unknown" outside a repository
  bool dirty = false;                   // tracked files differed from the commit when it was built
  std::string compiler;                 // "GCC 12.2.0"
  std::string build_type;               // CMAKE_BUILD_TYPE
  std::string cpu;                      // model name as the kernel tells it; "unknown" if it does not
  int threads = 0;                      // threads that parallel loops may use (ThreadLimit)
  std::string gl_renderer, gl_version;  // GL_RENDERER and GL_VERSION
  std::string date;                     // UTC, ISO 8601: "2026-01-31T23:59:59Z"
  bool shared_machine = false;          // other runs were at work at the same time: times say little
};

// Fills everything but the GL strings, which the caller got from its context (empty: no context).
Provenance collect_provenance(const std::string& gl_renderer, const std::string& gl_version);

}  // namespace relight
