# One interface target that every relight target links: warnings, instruction set, definitions.
add_library(relight_settings INTERFACE)
target_include_directories(relight_settings INTERFACE ${CMAKE_SOURCE_DIR})
# No silent double/float or sign surprises: a testbed that measures errors must not make its own.
# -Wno-restrict, -Wno-stringop-overflow: GCC 12 raises false alarms in std::string (its bug 105329), the second where the
# standard library comes from a precompiled header.
target_compile_options(relight_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                       -Woverloaded-virtual -Wno-restrict -Wno-stringop-overflow $<$<BOOL:${RELIGHT_WERROR}>:-Werror>)
if(RELIGHT_NATIVE)
  target_compile_options(relight_settings INTERFACE -march=native)
else()
  target_compile_options(relight_settings INTERFACE -march=x86-64-v3)
endif()
# No fused multiply-add behind our back: the same source must give the same bits in every translation unit.
target_compile_options(relight_settings INTERFACE -ffp-contract=off)
target_compile_definitions(relight_settings INTERFACE CGAL_DISABLE_ROUNDING_MATH_CHECK
                           RELIGHT_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
target_link_libraries(relight_settings INTERFACE glm::glm fmt::fmt TBB::tbb Threads::Threads)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
