#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# run_clang_tidy.sh <build folder>: clang-tidy over all tracked sources of src/. A file whose preprocessed text,
# checks and verdict are known to be clean is not looked at again.
set -euo pipefail
build=$1
cache=${PBRT_MEDIA_TIDY_CACHE:-$HOME/.cache/pbrt-media-tidy}
mkdir -p "$cache"
export build cache

tidy_one() {
  local file=$1 key command
  command=$(python3 - "$build/compile_commands.json" "$PWD/$file" <<'PY'
import json, shlex, sys
for entry in json.load(open(sys.argv[1])):
    if entry["file"] == sys.argv[2]:
        words = shlex.split(entry["command"])
        if words[0].endswith("ccache"):
            words = words[1:]
        out, take = [], False
        for word in words:
            if take:
                out += ["-isystem", word]
            take = word == "-isystem"
            if word.startswith(("-I", "-D", "-std")):
                out.append(word)
        print(shlex.join(out))
        break
PY
  )
  [ -n "$command" ] || return 0
  # shellcheck disable=SC2086
  key=$( (cat .clang-tidy && eval "g++ -E -P $command $file") 2>/dev/null | sha256sum | cut -d' ' -f1)
  [ -f "$cache/$key" ] && return 0
  if clang-tidy-14 --quiet -p "$build" "$file" >"$build/tidy.$$.log" 2>/dev/null; then
    : >"$cache/$key"
    rm -f "$build/tidy.$$.log"
  else
    cat "$build/tidy.$$.log"
    rm -f "$build/tidy.$$.log"
    return 1
  fi
}
export -f tidy_one
git ls-files -z 'src/*.cpp' | xargs -0 -n 1 -P "$(nproc)" bash -c 'tidy_one "$1"' _
