#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# scripts/make_pictures.sh BIN [--check] [NAME...]: makes the pictures of the documentation, docs/images/NAME.png, by the
# programs pbrt and imgtool of the folder BIN: each is scenes/NAME.pbrt as it stands, seed 0. Without names all that
# docs/gallery.md shows.
#
#   scripts/make_pictures.sh build/release/bin            about a minute a picture on two cores
#   scripts/make_pictures.sh build/release/bin --check    writes nothing; status 1 if a picture is not what the code renders
#
# Pixels are compared, not files. They are the same on every processor. But C libraries round logarithms and exponentials
# differently, which sends some paths elsewhere: a mean squared error of 1e-6 is let pass, and told. Another seed gives some
# 1e-4, one level of 255 everywhere 1e-5.
set -euo pipefail
usage="usage: scripts/make_pictures.sh BIN [--check] [NAME...]"
bin=$(cd "${1:?$usage}" && pwd)
shift
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
check=false
if [ "${1:-}" = --check ]; then
  check=true
  shift
fi
names=("$@")
if [ ${#names[@]} -eq 0 ]; then
  mapfile -t names < <(sed -n 's/.*(images\/\([a-z0-9-]*\)\.png).*/\1/p' "$root/docs/gallery.md")
fi
for name in "${names[@]}"; do
  if [ ! -f "$root/scenes/$name.pbrt" ]; then
    echo "make_pictures.sh: no scenes/$name.pbrt; $usage" >&2
    exit 1
  fi
done
made=$(mktemp -d)
trap 'rm -r "$made"' EXIT
status=0
for name in "${names[@]}"; do
  picture=$root/docs/images/$name.png
  "$bin/pbrt" "$root/scenes/$name.pbrt" --seed 0 --quiet --outfile "$made/$name.exr"
  # Through a format without texts: command, seconds and commit in the header would make another file of the same picture.
  "$bin/imgtool" convert "$made/$name.exr" "$made/$name.pfm"
  "$bin/imgtool" convert "$made/$name.pfm" "$made/$name.png"
  if ! $check; then
    cp "$made/$name.png" "$picture"
    echo "docs/images/$name.png: $(stat -c %s "$picture") bytes"
  elif cmp -s "$made/$name.png" "$picture" || "$bin/imgtool" diff "$made/$name.png" "$picture" >"$made/diff" 2>&1; then
    echo "docs/images/$name.png is what scenes/$name.pbrt renders"
  elif "$bin/imgtool" diff "$made/$name.png" "$picture" --max-mse 1e-6 >"$made/diff" 2>&1; then
    echo "docs/images/$name.png is what scenes/$name.pbrt renders, but for rounding:"
    head -1 "$made/diff"
  else
    echo "docs/images/$name.png is not what scenes/$name.pbrt renders: scripts/make_pictures.sh BIN $name" >&2
    cat "$made/diff" >&2
    status=1
  fi
done
exit $status
