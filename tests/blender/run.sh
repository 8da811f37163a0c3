#!/usr/bin/env bash
# A scene made in Blender, exported as .glb and rendered by this program and by Cycles: the two
# pictures must agree region by region.
set -euo pipefail
exec </dev/null

usage() {
  cat <<TXT
usage: tests/blender/run.sh PAHRENDER [FOLDER]

  PAHRENDER  the program
  FOLDER     where to leave scene.glb, cycles.exr and pahrender.exr; without it, they are removed

Takes Blender 3.3 to 3.6 with NumPy for its glTF exporter (Debian: blender python3-numpy), and two
minutes. SAMPLES, 1024, is for each pixel of both; LIGHT_SCALE, 1, multiplies the lights of one, to see
that the comparison tells. Exit codes: 0 the pictures agree, 1 they do not, 77 it cannot be tried.
TXT
}

cannot() {
  echo "blender: skipped: $*" >&2
  exit 77
}

if (($# == 1)) && [[ $1 == -h || $1 == --help ]]; then
  usage
  exit 0
fi
if (($# < 1 || $# > 2)) || [[ $1 == -* ]]; then
  usage >&2
  exit 2
fi
program=$(realpath "$1")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export SAMPLES=${SAMPLES:-1024}

in_blender() {
  blender --background --factory-startup --python-exit-code 1 --python "$@"
}

command -v blender >/dev/null || cannot "there is no blender here"
in_blender "$here/can_export.py" >/dev/null 2>&1 || cannot "Blender is not of 3.3 to 3.6, or without NumPy or Cycles"

if (($# == 2)); then
  mkdir -p "$2"
  folder=$(realpath "$2")
else
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
in_blender "$here/scene.py" -- "$folder"
cp "$here/scene.yaml" "$folder"
"$program" "$folder/scene.yaml" -o "$folder/pahrender.exr" --spp "$SAMPLES" \
  -D "meshes.0.light_scale=${LIGHT_SCALE:-1}"
in_blender "$here/compare.py" -- "$folder/pahrender.exr" "$folder/cycles.exr"
