# SPDX-License-Identifier: BSD-2-Clause
# cmake -DSOURCE=... -DOUTPUT=... -P commit.cmake: writes the source file that holds pbrtmedia::commitText(), and leaves
# it alone while that stays the same. Run by every build, so the text is true without configuring again, and nothing
# is compiled or linked again between two commits.
set(commit "commit unknown (built without git)")
find_package(Git QUIET)
if(Git_FOUND AND EXISTS "${SOURCE}/.git")
  set(git "${GIT_EXECUTABLE}" --no-optional-locks -C "${SOURCE}")
  execute_process(COMMAND ${git} rev-parse --short=12 HEAD
    OUTPUT_VARIABLE head RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed)
    set(commit "commit ${head}")
    execute_process(COMMAND ${git} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes ERROR_QUIET)
    if(NOT changes STREQUAL "")
      string(APPEND commit " with local changes")
    endif()
  endif()
else()
  # `git archive`, and so a download of a tagged tree, fills this in: see .gitattributes.
  file(STRINGS "${SOURCE}/cmake/archived_commit.txt" archived LIMIT_COUNT 1)
  if(archived MATCHES "^[0-9a-f]+$")
    set(commit "commit ${archived} (archive)")
  endif()
endif()
set(text "// Written by cmake/commit.cmake.\n#include \"tools/build_info.h\"\n\nnamespace pbrtmedia {\n\nstd::string_view commitText() { return \"${commit}\"; }\n\n}  // namespace pbrtmedia\n")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" before)
endif()
if(NOT "${before}" STREQUAL "${text}")
  file(WRITE "${OUTPUT}" "${text}")
endif()
