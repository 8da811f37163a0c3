#!/usr/bin/env bash
# The README's two commands on a fresh machine: a root of a Debian release made by debootstrap, with
# a clean clone of this repository in it. What is not committed is not tried.
set -euo pipefail
exec </dev/null

usage() {
  cat <<TXT
usage: tests/fresh_machine/run.sh SUITE [FOLDER]

  SUITE   a Debian release: bookworm, trixie
  FOLDER  where to make the root, which is kept; without it, a temporary folder

Takes 3 GB of disk, and as root a network that reaches apt's mirror. CMAKE_BUILD_PARALLEL_LEVEL
bounds the compilers at once. Exit codes: 0 both commands work, 1 one does not, 77 it cannot be tried.
TXT
}

cannot() {
  echo "fresh_machine: skipped: $*" >&2
  exit 77
}

fail() {
  echo "fresh_machine: $*" >&2
  exit 1
}

if (($# == 1)) && [[ $1 == -h || $1 == --help ]]; then
  usage
  exit 0
fi
if (($# < 1 || $# > 2)) || [[ $1 == -* ]]; then
  usage >&2
  exit 2
fi
suite=$1
folder=${2-}
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

((EUID == 0)) || cannot "making a root takes root"
for program in debootstrap apt-get apt-config chroot git; do
  command -v "$program" >/dev/null || cannot "no $program here"
done
[[ -e /usr/share/debootstrap/scripts/$suite ]] || cannot "debootstrap knows no '$suite'"

# Where this machine's own release comes from, whichever way its sources are written.
# shellcheck source=/dev/null
codename=$(. /etc/os-release && echo "${VERSION_CODENAME-}")
# shellcheck disable=SC2016  # the fields are apt's
mirror=$(apt-get indextargets --format '$(RELEASE) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' |
  awk -v release="$codename" '$1 == release && $2 == "main" && !found {print $3; found = 1}')
[[ -n $mirror ]] || cannot "apt's sources name no mirror of '$codename'"

temporary=$(mktemp -d)
root=$(realpath -m "${folder:-$temporary/root}")
clean_up() {
  local mounted
  for mounted in "$root/proc" "$root/sys" "$root/dev/pts"; do
    while mountpoint -q "$mounted"; do umount --lazy "$mounted" || return; done
  done
  rm -rf --one-file-system "$temporary"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

[[ ! -e $root/etc/debian_version ]] || fail "'$root' holds a root already"

# apt's own downloader: it knows apt's proxies.
/usr/lib/apt/apt-helper download-file "${mirror%/}/dists/$suite/InRelease" \
  "$temporary/InRelease" >"$temporary/log" 2>&1 ||
  cannot "'$mirror' does not answer for '$suite': $(tail -n 1 "$temporary/log")"

# debootstrap goes by the environment.
eval "$(apt-config shell http_proxy Acquire::http::Proxy https_proxy Acquire::https::Proxy)"
[[ -z ${http_proxy-} ]] || export http_proxy
[[ -z ${https_proxy-} ]] || export https_proxy

echo "fresh_machine: making a root of '$suite' from $mirror in $root"
mkdir -p "$root"
debootstrap --variant=minbase --include=git,ca-certificates "$suite" "$root" "$mirror" \
  >"$temporary/log" 2>&1 ||
  cannot "debootstrap failed: $(tail -n 3 "$temporary/log")"

mountpoint -q "$root/proc" || mount -t proc proc "$root/proc" || cannot "/proc cannot be mounted"
# Programs are tried at a terminal, too.
mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts" ||
  cannot "/dev/pts cannot be mounted"
cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
apt-config dump | grep -E '^Acquire::(Check-[A-Za-z-]+|Retries|https?::Proxy(::[^ ]*)?) ' \
  >"$root/etc/apt/apt.conf.d/90host" || true
git clone -q --no-hardlinks "$source" "$root/root/pahrender" || fail "cannot clone '$source'"

# Under its heading, one line each.
mapfile -t commands < <(awk '
  /^## / {section = $0 == "## Two commands"}
  /^```$/ {inside = 0}
  section && inside
  /^```sh$/ {inside = 1}' "$root/root/pahrender/README.md")
((${#commands[@]} == 2)) || fail "the README has ${#commands[@]} commands under 'Two commands'"

for command in "${commands[@]}"; do
  echo "fresh_machine: $suite: $command"
  env -i HOME=/root LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    ${CMAKE_BUILD_PARALLEL_LEVEL:+CMAKE_BUILD_PARALLEL_LEVEL="$CMAKE_BUILD_PARALLEL_LEVEL"} \
    chroot "$root" bash -c "cd /root/pahrender && $command" || fail "$suite: failed: $command"
done
[[ -s $root/root/pahrender/cornell.png ]] || fail "$suite: no picture was written"
echo "fresh_machine: $suite: both commands work"
