// Memory of this process, as the kernel counts it.
#pragma once

#include <cstdint>

namespace relight {

// Largest resident set so far [bytes] (VmHWM of /proc/self/status); 0 if the kernel does not tell. It covers
// the whole process since its start, so it is an upper bound for a run that is not the first.
int64_t peak_memory_bytes();

}  // namespace relight
