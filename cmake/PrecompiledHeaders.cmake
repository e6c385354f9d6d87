# The headers that most files of a library read, compiled once a library: they are a third of its compile time.
# Each file still includes what it uses; RELIGHT_PRECOMPILE=OFF shows one that does not.
# Files with compile options of their own can't take them (SKIP_PRECOMPILE_HEADERS there).
option(RELIGHT_PRECOMPILE "Compile common headers once a library" ON)
function(relight_precompile_headers target)
  if(RELIGHT_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <algorithm> <filesystem> <functional> <map> <memory> <optional> <span>
                              <string> <vector> <fmt/format.h> <glm/glm.hpp> ${ARGN})
  endif()
endfunction()
# GCC 12 loses what silences its false alarm about std::string (bug 105329) when <string> is precompiled; the few files that
# meet it are named here: any other -Warray-bounds stays an error.
function(relight_false_array_bounds)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>")
endfunction()
