#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# run_clang_tidy.sh <build folder>: clang-tidy over all sources of src/, as the preset lint builds them: several at a time,
# as most of the time goes to the headers that they share. Sources whose preprocessed text, checks and verdict are known to
# be clean are not looked at again. One file's names may shadow another's; GCC sees what shadows within a file.
set -euo pipefail
build=$1
cache=${PBRT_MEDIA_TIDY_CACHE:-$HOME/.cache/pbrt-media-tidy}
mkdir -p "$cache"
export build cache

tidy_one() {
  local file=$1 words=$2 key log
  # shellcheck disable=SC2086
  key=$( (cat .clang-tidy && eval "g++ -E -P $words '$file'") 2>/dev/null | sha256sum | cut -d' ' -f1)
  [ -f "$cache/$key" ] && return 0
  log=$build/tidy.$$.log
  if clang-tidy-14 --quiet --checks=-bugprone-suspicious-include --extra-arg=-Wno-shadow -p "$build" "$file" >"$log" 2>&1; then
    : >"$cache/$key"
    rm -f "$log"
  else
    grep -v 'warnings\? generated\.$\|^Suppressed\|^Use -header-filter' "$log" || true
    rm -f "$log"
    return 1
  fi
}
export -f tidy_one

# A source, and the words of its command that decide what its text is; the longest first.
sources() {
  python3 - "$build/compile_commands.json" "$PWD" <<'PY'
import json, os, shlex, sys
root = sys.argv[2]
found = []
for entry in json.load(open(sys.argv[1])):
    file = os.path.relpath(entry["file"], root)
    if not file.startswith("src/") and "/src/" not in file:
        continue
    out, take = [], False
    for word in shlex.split(entry["command"]):
        if take:
            out += ["-isystem", word]
        take = word == "-isystem"
        if word.startswith(("-I", "-D", "-std")):
            out.append(word)
    found.append((os.path.getsize(entry["file"]), file, shlex.join(out)))
for _, file, words in sorted(found, reverse=True):
    print(file, words, sep="\0", end="\0")
PY
}
sources | xargs -0 -n 2 -P "$(nproc)" bash -c 'tidy_one "$1" "$2"' _
