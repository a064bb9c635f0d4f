# SPDX-License-Identifier: BSD-2-Clause
# Flags that every target of ours uses. Third-party headers come in as SYSTEM.
add_library(pm_flags INTERFACE)
target_compile_options(pm_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-qual
  # One result on every CPU: no fused operations that the source does not spell.
  -ffp-contract=off
  # errno and floating-point traps are never read; this lets sqrt be one instruction.
  -fno-math-errno -fno-trapping-math)
if(PBRT_MEDIA_WERROR)
  target_compile_options(pm_flags INTERFACE -Werror)
endif()
if(PBRT_MEDIA_SANITIZE)
  # Line tables, which reports need, come with the presets: full symbols would add half to the time of compiling.
  target_compile_options(pm_flags INTERFACE -fsanitize=${PBRT_MEDIA_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(pm_flags INTERFACE -fsanitize=${PBRT_MEDIA_SANITIZE})
  if(PBRT_MEDIA_SANITIZE MATCHES "undefined")
    target_compile_options(pm_flags INTERFACE -fno-sanitize-recover=undefined)
  endif()
  if(PBRT_MEDIA_SANITIZE MATCHES "fuzzer")
    target_compile_options(pm_flags INTERFACE
      -fsanitize-coverage-ignorelist=${CMAKE_SOURCE_DIR}/cmake/uncounted_functions.txt)
  endif()
endif()
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
# COMPILE_OPTIONS of sources that run once per program and compile much of a header-only library (command lines, JSON):
# most of their time is optimisation that nobody would notice.
set(PBRT_MEDIA_RUN_ONCE "$<$<CONFIG:Release>:-O1>")
