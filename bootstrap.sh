#!/usr/bin/env bash
# From a fresh machine to a built program: installs what is missing, configures, builds.
[ -n "${BASH_VERSION:-}" ] || exec bash "$0" "$@"
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"

# openimageio-tools: Debian's CMake package of OpenImageIO refuses to load without its programs.
to_build=(
  g++ cmake ninja-build ccache pkg-config
  libopenimageio-dev openimageio-tools libyaml-cpp-dev libglm-dev libtbb-dev libhwy-dev
  libcli11-dev libfmt-dev nlohmann-json3-dev
)
to_test=(catch2 libcgal-dev libbenchmark-dev libembree-dev)
to_sanitize=(clang-19 libclang-rt-19-dev)
to_lint=(clang-19 clang-tidy-19 clang-format-14)

usage() {
  cat <<TXT
usage: ./bootstrap.sh [build|test|lint] [--preset NAME] [--deps-only]

  build         install missing packages, configure and build the program (the default)
  test          the same with the tests, then run them
  lint          check formatting, and the code by clang-tidy
  --preset NAME a preset of CMakePresets.json: release (the default), sanitize or thread
  --deps-only   install missing packages and stop
TXT
}

fail() {
  echo "bootstrap.sh: $*" >&2
  exit 1
}

missing_packages() {
  local package
  for package in "$@"; do
    dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null | grep -q '^ii' || echo "$package"
  done
}

install_packages() {
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "bootstrap.sh: no apt here. These must be installed by other means (Debian's names):" >&2
    echo "  $*" >&2
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  echo "Installing: ${missing[*]}"
  local as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || fail "run as root, or install sudo, or install: ${missing[*]}"
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq </dev/null || true
  local package unknown=()
  for package in "${missing[@]}"; do
    apt-cache show "$package" >/dev/null 2>&1 || unknown+=("$package")
  done
  ((${#unknown[@]} == 0)) ||
    fail "apt knows no package ${unknown[*]}: is there a network, and is this Debian 12 or later?"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null
}

command=build
preset=release
deps_only=false
while (($#)); do
  case "$1" in
    build | test | lint) command=$1 ;;
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

packages=("${to_build[@]}")
[[ $command == test || $command == lint ]] && packages+=("${to_test[@]}")
[[ $command == lint ]] && packages+=("${to_lint[@]}")
[[ $preset == sanitize || $preset == thread ]] && packages+=("${to_sanitize[@]}")
install_packages "${packages[@]}"
if $deps_only; then exit 0; fi

for folder in . build "build/$preset"; do
  [[ ! -e $folder || -w $folder ]] ||
    fail "cannot write to $PWD/$folder, which belongs to $(stat -c %U "$folder")"
done

case $command in
  build)
    cmake --preset "$preset"
    cmake --build --preset "$preset" --target pahrender
    echo "Built build/$preset/pahrender"
    ;;
  test)
    cmake --preset "$preset"
    cmake --build --preset "$preset"
    ctest --preset "$preset" -j "$(nproc)"
    ;;
  lint)
    git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 --dry-run -Werror
    cmake --preset tidy
    .ci/tidy build/tidy
    ;;
esac
