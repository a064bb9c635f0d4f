# SPDX-License-Identifier: BSD-2-Clause
# Reading the headers of the standard library is half the work of compiling most files. GCC reads them once, from
# cmake/standard_headers.h, into a file that stands alone in a folder searched before the header's own: so GCC finds
# it, and takes the header itself where flags differ, while clang-tidy and the compiler cache, which know nothing of
# it, see the header's text. The cache's answers thus depend on no such file, and are good for every clone.
# Targets that link pm_precompiled have it.
add_library(pm_precompiled INTERFACE)
if(NOT PBRT_MEDIA_PRECOMPILE OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  return()
endif()
set(header ${CMAKE_SOURCE_DIR}/cmake/standard_headers.h)
set(folder ${CMAKE_BINARY_DIR}/precompiled)
set(precompiled ${folder}/standard_headers.h.gch)
string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
separate_arguments(flags UNIX_COMMAND "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${config}}")
get_target_property(options pm_flags INTERFACE_COMPILE_OPTIONS)
file(MAKE_DIRECTORY ${folder})
add_custom_command(
  OUTPUT ${precompiled}
  COMMAND ${CMAKE_CXX_COMPILER} ${flags} ${options} ${CMAKE_CXX20_STANDARD_COMPILE_OPTION} -x c++-header
          -MD -MT ${precompiled} -MF ${precompiled}.d -o ${precompiled}.new ${header}
  COMMAND ${CMAKE_COMMAND} -E rename ${precompiled}.new ${precompiled}
  DEPENDS ${header}
  DEPFILE ${precompiled}.d
  COMMENT "Reading the standard library's headers"
  VERBATIM)
add_custom_target(pm_standard_headers DEPENDS ${precompiled})
add_dependencies(pm_precompiled pm_standard_headers)
target_compile_options(pm_precompiled INTERFACE
  -I${folder} -I${CMAKE_SOURCE_DIR}/cmake "SHELL:-include standard_headers.h"
  # GCC 12 sees std::string leave its bounds where there is nothing, and more of it in headers read this way.
  # Clang-tidy, which is told the same, does not know all of these.
  -Wno-unknown-warning-option -Wno-error=array-bounds -Wno-error=restrict -Wno-error=stringop-overflow -Wno-error=stringop-overread)
