#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# run_fuzzers.sh <build folder> <seconds> [--seed N] [target...]: runs every fuzz target of the build (or those named)
# for that long on its seeds, two at a time. The seed of a run is another each time, and printed: with --seed N a run
# repeats what the one before did, and goes as far as its time allows.
# A crash, a leak, a hang over 10 s or more than 2 GB of memory fails, and the input is kept in <build>/crashes. Leaks of
# `vdb` are OpenVDB's, which drops buffers where a damaged file makes it throw: they are not looked for.
set -euo pipefail
build=$1
seconds=$2
shift 2
seed=
if [ "${1:-}" = --seed ]; then
  seed=${2:?--seed needs a number}
  shift 2
fi
[ -n "$seed" ] || seed=$((($(od -An -N4 -tu4 /dev/urandom) & 0x7fffffff) + 1))
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
crashes=$build/crashes
mkdir -p "$crashes"
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
[ ! -x "$build/bin/fuzz_seeds" ] || "$build/bin/fuzz_seeds" "$made"

targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  for program in "$build"/bin/fuzz_*; do
    name=${program##*/fuzz_}
    [ "$name" = seeds ] || targets+=("$name")
  done
fi
echo "fuzzing ${targets[*]}: seed $seed (the same again: scripts/run_fuzzers.sh $build $seconds --seed $seed)"

run_one() {
  local name=$1 work found log leaks=1 seeds=()
  [ "$name" != vdb ] || leaks=0
  work=$(mktemp -d)
  found=$(mktemp -d) # kept when the target fails; what only a child of it ended with is no fault
  log=$build/fuzz_$name.log
  for folder in "$root/tests/fuzz/corpus/$name" "$made/$name"; do
    [ ! -d "$folder" ] || seeds+=("$folder")
  done
  if ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=$leaks "$build/bin/fuzz_$name" -detect_leaks=$leaks -seed="$seed" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=1024 \
    -print_final_stats=1 -artifact_prefix="$found/$name-" "$work" ${seeds[@]+"${seeds[@]}"} >"$log" 2>&1; then
    echo "fuzz_$name: $(grep -o 'number_of_executed_units: [0-9]*' "$log" | grep -o '[0-9]*$' | tail -n 1) runs, no fault"
  else
    echo "fuzz_$name: FAILED with seed $seed" && tail -n 40 "$log"
    find "$found" -type f -exec cp {} "$crashes" \;
    rm -rf "$work" "$found"
    return 1
  fi
  rm -rf "$work" "$found"
}

failed=0
pids=()
for name in "${targets[@]}"; do
  run_one "$name" &
  pids+=($!)
  if [ ${#pids[@]} -eq 2 ]; then
    for pid in "${pids[@]}"; do wait "$pid" || failed=1; done
    pids=()
  fi
done
for pid in ${pids[@]+"${pids[@]}"}; do wait "$pid" || failed=1; done
exit $failed
