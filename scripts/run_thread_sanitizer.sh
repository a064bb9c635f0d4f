#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# run_thread_sanitizer.sh <build folder>: what runs in several threads, built by the preset tsan: loops, film, learned bounds,
# tables filled while rendering, the render loop, who watches a render, and whole renders of a few scenes. The first race ends it
# with status 1.
#   run_thread_sanitizer.sh --targets    what must be built
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Test program and which of its tests.
tests='
test_base ParallelFor.*:ThreadLimit.*:StopSignal.*
test_film Film.*
test_fields LearnedBounds.*:GridSamples.*:SuperVoxels.*
test_lighting SpatialLightSelector.*
test_accelerators Accelerator.*:Instances.*:UserGeometry.*
test_render_loop RenderLoop.*
test_display *
'
if [ "$1" = --targets ]; then
  echo pbrt
  echo "$tests" | grep -o '^test_\w*'
  exit 0
fi
bin=$1/bin
export TSAN_OPTIONS="halt_on_error=1 suppressions=$root/cmake/thread_sanitizer.txt${TSAN_OPTIONS:+ $TSAN_OPTIONS}"
while read -r program filter; do
  [ -n "$program" ] || continue
  echo "$program $filter"
  "$bin/$program" --gtest_brief=1 --gtest_filter="$filter"
done <<<"$tests"

# Four threads, of which more than one touches a tile's neighbours, a pass, the same bounds, splats, photons, and the progress line.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
render() {
  local scene=$1
  shift
  echo "pbrt $scene ($integrator) $*"
  sed "s/^Integrator \"volpath\"/Integrator \"$integrator\"/" "$root/tests/references/$scene.pbrt" >"$folder/scene.pbrt"
  "$bin/pbrt" --quiet --nthreads 4 --tile-size 8 --spp 4 --outfile "$folder/image.exr" --stats "$folder/stats.json" "$@" \
    "$folder/scene.pbrt"
}
integrator=volpath
render smoke
render smoke --mediumparams '"string bounds" "progressive"' --bounds-cache "$folder/bounds"
render smoke --mediumparams '"string bounds" "progressive"' --bounds-cache "$folder/bounds"
render fire
render still-life
render lighthouse --time 2
integrator=bdpt
render smoke
integrator=sppm
render spot-fog
