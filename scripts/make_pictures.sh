#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# scripts/make_pictures.sh BIN [NAME...]: makes the pictures of the documentation, docs/images/NAME.png, by the programs pbrt
# and imgtool of the folder BIN: each is scenes/NAME.pbrt as it stands, seed 0. Without names all that docs/gallery.md shows.
#
#   scripts/make_pictures.sh build/release/bin            some minutes on two cores
#   scripts/make_pictures.sh build/release/bin --check    writes nothing; status 1 if a picture is not what the code renders
set -euo pipefail
bin=$(cd "${1:?usage: scripts/make_pictures.sh BIN [--check] [NAME...]}" && pwd)
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
made=$(mktemp -d)
trap 'rm -r "$made"' EXIT
ln -s "$root/scenes" "$made/scenes"
status=0
for name in "${names[@]}"; do
  picture=$root/docs/images/$name.png
  # The command stands in the picture: no folder of this machine in it.
  (cd "$made" && PATH=$bin:$PATH pbrt "scenes/$name.pbrt" --seed 0 --quiet --outfile "$name.exr")
  "$bin/imgtool" convert "$made/$name.exr" "$made/$name.png"
  if ! $check; then
    cp "$made/$name.png" "$picture"
    echo "docs/images/$name.png: $(stat -c %s "$picture") bytes"
  elif cmp -s "$made/$name.png" "$picture"; then
    echo "docs/images/$name.png is what scenes/$name.pbrt renders"
  else
    echo "docs/images/$name.png is not what scenes/$name.pbrt renders: scripts/make_pictures.sh $bin $name" >&2
    status=1
  fi
done
exit $status
