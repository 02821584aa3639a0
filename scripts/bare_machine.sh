#!/bin/bash
# README's two commands on a machine that has nothing yet: makes a Debian 12 root with debootstrap, clones the last commit into it, and runs
# scripts/demo.sh there, which installs the group [program] of packages.txt alone, tries what the program does without Cairo, and
# runs scripts/test.sh; then makes the Debian packages and tries them on another such machine, which has nothing else.
# Part of the release routine (CONTRIBUTING.md); as root, some thirty minutes and 9 GB.
#   scripts/bare_machine.sh [--demo] [FOLDER]     --demo: ends before scripts/test.sh; default: a temporary one, removed at the end; a FOLDER that holds a root already is used as it is
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mirror=${CORANK_DEBIAN_MIRROR:-http://deb.debian.org/debian}

if [[ $(id -u) -ne 0 ]]; then
  echo "Only root may make a root: sudo scripts/bare_machine.sh" >&2
  exit 1
fi
for tool in debootstrap unshare git; do
  command -v "$tool" >/dev/null || { echo "$tool is missing: apt-get install debootstrap util-linux git" >&2; exit 1; }
done

demo_alone=false
if [[ ${1:-} == --demo ]]; then
  demo_alone=true
  shift
fi
if [[ $# -gt 0 ]]; then
  bare=$(realpath -m "$1")
else
  bare=$(mktemp -d)
  trap 'rm -rf --one-file-system "$bare"' EXIT
fi
make_root() { # folder
  [[ -x $1/bin/bash ]] && return
  echo "== Making a Debian 12 root in $1"
  debootstrap --variant=minbase bookworm "$1" "$mirror" >"$1.log" 2>&1 || { cat "$1.log" >&2; exit 1; }
  rm -f "$1.log"
}
clone_into() { # root
  cp -L /etc/resolv.conf "$1/etc/resolv.conf"
  rm -rf "$1/home/corank"
  git clone --quiet --no-hardlinks "$root" "$1/home/corank"
}

# The mounts live in a namespace of their own: they end with it.
inside='
  mount --rbind /dev "$0/dev" && mount -t proc proc "$0/proc" && mount -t sysfs sysfs "$0/sys"
  exec env -i HOME=/root TERM=dumb LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin chroot "$0" "$@"'
on() { # root command: in its /home/corank
  unshare --mount --pid --fork bash -euc "$inside" "$1" bash -c "cd /home/corank && $2"
}

make_root "$bare"
clone_into "$bare"
echo "== scripts/demo.sh on the bare machine"
on "$bare" "time scripts/demo.sh"
on "$bare" "exec scripts/program_smoke.sh"
! $demo_alone || exit 0
echo "== scripts/test.sh on the bare machine"
on "$bare" "time scripts/test.sh"
echo "== Both commands of the README pass on a bare machine"

on "$bare" "apt-get install -qq -y lintian >/dev/null 2>&1; exec scripts/debian_packages.sh"
users=$bare/users
make_root "$users"
clone_into "$users"
rm -rf "$users/packages"
mkdir "$users/packages"
cp "$bare"/home/corank/build/release/*.deb "$users/packages/"
echo "== The packages alone on another bare machine"
on "$users" "apt-get update -qq && apt-get install -qq -y /packages/*.deb cmake g++ make >/dev/null && exec scripts/packages_smoke.sh"
