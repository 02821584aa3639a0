#!/bin/bash
# README's two commands on a machine that has nothing yet: makes a Debian 12 root with debootstrap, clones the last commit into it, and runs
# scripts/demo.sh and scripts/test.sh there. Part of the release routine (CONTRIBUTING.md); as root, some twenty minutes and 6 GB.
#   scripts/bare_machine.sh [FOLDER]     default: a temporary one, removed at the end; a FOLDER that holds a root already is used as it is
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

if [[ $# -gt 0 ]]; then
  bare=$(realpath -m "$1")
else
  bare=$(mktemp -d)
  trap 'rm -rf --one-file-system "$bare"' EXIT
fi
if [[ ! -x $bare/bin/bash ]]; then
  echo "== Making a Debian 12 root in $bare"
  debootstrap --variant=minbase bookworm "$bare" "$mirror" >"$bare.log" 2>&1 || { cat "$bare.log" >&2; exit 1; }
  rm -f "$bare.log"
fi
cp -L /etc/resolv.conf "$bare/etc/resolv.conf"
rm -rf "$bare/home/corank"
git clone --quiet --no-hardlinks "$root" "$bare/home/corank"

# The mounts live in a namespace of their own: they end with it.
inside='
  mount --rbind /dev "$0/dev" && mount -t proc proc "$0/proc" && mount -t sysfs sysfs "$0/sys"
  exec env -i HOME=/root TERM=dumb LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin chroot "$0" "$@"'
for command in scripts/demo.sh scripts/test.sh; do
  echo "== $command on the bare machine"
  unshare --mount --pid --fork bash -euc "$inside" "$bare" bash -c "cd /home/corank && exec $command"
done
echo "== Both commands of the README pass on a bare machine"
