#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# run_fuzzers.sh <build folder> <seconds>: runs every fuzz target for that long on its seeds, two at a time.
# The seed is fixed, so a run repeats what the one before did, and goes as far as its time allows.
# A crash, a leak, a hang over 10 s or more than 2 GB of memory fails, and the input is kept in <build>/crashes.
set -euo pipefail
build=$1
seconds=$2
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
crashes=$build/crashes
mkdir -p "$crashes"

run_one() {
  local name=$1 work log
  work=$(mktemp -d)
  log=$build/fuzz_$name.log
  if "$build/bin/fuzz_$name" -seed=1 -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=1024 \
    -print_final_stats=1 -artifact_prefix="$crashes/$name-" "$work" "$root/tests/fuzz/corpus/$name" >"$log" 2>&1; then
    echo "fuzz_$name: $(grep -o 'number_of_executed_units: [0-9]*' "$log" | grep -o '[0-9]*$') runs, no fault"
  else
    echo "fuzz_$name: FAILED" && tail -n 40 "$log"
    rm -rf "$work"
    return 1
  fi
  rm -rf "$work"
}

failed=0
pids=()
for name in scene ply image spectrum; do
  run_one "$name" &
  pids+=($!)
  if [ ${#pids[@]} -eq 2 ]; then
    for pid in "${pids[@]}"; do wait "$pid" || failed=1; done
    pids=()
  fi
done
for pid in "${pids[@]}"; do wait "$pid" || failed=1; done
exit $failed
