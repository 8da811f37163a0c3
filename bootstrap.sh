#!/usr/bin/env bash
# From a fresh machine to a built program: installs what is missing, configures, builds.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

# openimageio-tools: Debian's CMake package of OpenImageIO refuses to load without its programs.
packages=(
  g++ cmake ninja-build ccache pkg-config
  libopenimageio-dev openimageio-tools libassimp-dev libyaml-cpp-dev libglm-dev libtbb-dev libhwy-dev
  libcli11-dev libfmt-dev nlohmann-json3-dev
  catch2 libcgal-dev clang-format
)

usage() {
  cat <<TXT
usage: ./bootstrap.sh [build|test] [--preset NAME] [--deps-only]

  build         install missing packages, configure and build (the default)
  test          the same with warnings as errors, then run the tests
  --preset NAME a preset of CMakePresets.json (release; for tests ci)
  --deps-only   install missing packages and stop
TXT
}

fail() {
  echo "bootstrap.sh: $*" >&2
  exit 1
}

missing_packages() {
  local package
  for package in "${packages[@]}"; do
    dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null | grep -q '^ii' || echo "$package"
  done
}

install_packages() {
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "bootstrap.sh: no apt here. These must be installed by other means (Debian's names):" >&2
    echo "  ${packages[*]}" >&2
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages)
  ((${#missing[@]})) || return 0
  echo "Installing: ${missing[*]}"
  local as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || fail "run as root, or install sudo, or install: ${missing[*]}"
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq </dev/null
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null
}

command=build
preset=
deps_only=false
while (($#)); do
  case "$1" in
    build | test) command=$1 ;;
    --preset)
      (($# >= 2)) || fail "--preset needs a name"
      preset=$2
      shift
      ;;
    --deps-only) deps_only=true ;;
    -h | --help)
      usage
      exit 0
      ;;
    *)
      usage >&2
      exit 2
      ;;
  esac
  shift
done
if [[ -z $preset ]]; then
  [[ $command == test ]] && preset=ci || preset=release
fi

install_packages
if $deps_only; then exit 0; fi

cmake --preset "$preset"
if [[ $command == test ]]; then
  cmake --build --preset "$preset"
  ctest --preset "$preset" -j "$(nproc)"
else
  cmake --build --preset "$preset" --target pahrender
  echo "Built build/$preset/pahrender"
fi
