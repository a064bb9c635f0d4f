#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# scripts/make_references.sh [NAME...]: renders tests/references/NAME.pbrt (without names: all) with many samples to
# tests/references/NAME.exr, which tests/render/references_test.cpp compares images with. To be run only when a scene or
# what it ought to look like has changed; where PBRT-v3's images are at hand, the test compares these references with them.
# Needs a built ./render. About twelve minutes of one processor.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# The test takes 512 to 2048; by a seed that it does not take.
samples=8192 seed=1000
cd "$root/tests/references"
PATH=$root/build/release/bin:$PATH  # headers tell the command: no folder of this machine belongs there
[ $# -gt 0 ] || set -- *.pbrt
for name in "$@"; do
  name=${name%.pbrt}
  pbrt --quiet --spp $samples --seed $seed --outfile "$name.exr" "$name.pbrt"
done
