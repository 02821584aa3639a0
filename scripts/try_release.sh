#!/bin/bash
# Tries what scripts/release.sh made on machines that have nothing else: bare Debian 12 and 13 roots made by debootstrap, without
# compilers, and without a network where nothing has to be installed. As root.
#   scripts/try_release.sh [--roots FOLDER] RELEASE     default: roots in a temporary folder, removed at the end; those that are there stay as they are
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mirror=${CORANK_DEBIAN_MIRROR:-http://deb.debian.org/debian}
roots=
if [[ ${1:-} == --roots ]]; then
  roots=$(realpath -m "$2")
  shift 2
fi
[[ $# -eq 1 && -f $1/SHA256SUMS ]] || { echo "usage: scripts/try_release.sh [--roots FOLDER] RELEASE" >&2; exit 2; }
release=$(realpath "$1")
[[ $(id -u) -eq 0 ]] || { echo "Only root may make a root: sudo scripts/try_release.sh" >&2; exit 1; }
for tool in debootstrap unshare qemu-x86_64; do
  command -v "$tool" >/dev/null || { echo "$tool is missing: scripts/install_packages.sh release" >&2; exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
[[ -n $roots ]] || roots=$work/roots
mkdir -p "$roots"
(cd "$release" && sha256sum --quiet --check SHA256SUMS)
version=$(sed -n 's/.*corank-\(.*\)-linux-x86_64.tar.gz$/\1/p' "$release/SHA256SUMS")

# The mounts live in a namespace of their own: they end with it.
inside='
  mount --rbind /dev "$0/dev" && mount -t proc proc "$0/proc" && mount -t sysfs sysfs "$0/sys"
  exec env -i HOME=/root TERM=dumb LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin chroot "$0" "$@"'
online() { unshare --mount --pid --fork bash -euc "$inside" "$work/root" "$@"; }
offline() { unshare --mount --pid --net --fork bash -euc "$inside" "$work/root" "$@"; }
installed() { # PACKAGE…
  online bash -c 'apt-get update -qq && apt-get install -qq -y --no-install-recommends "$@"' bash "$@" >"$work/log" 2>&1 ||
    { cat "$work/log" >&2; exit 1; }
}
# A copy of the bare root, with the artefact and what tries it in /try.
begin() { # suite artefact
  if [[ ! -x $roots/$1/bin/bash ]]; then
    echo "== Making a bare root of $1"
    debootstrap --variant=minbase "$1" "$roots/$1" "$mirror" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
  fi
  echo
  echo "== $2 on a bare $1"
  rm -rf --one-file-system "$work/root"
  cp -a "$roots/$1" "$work/root"
  cp -L /etc/resolv.conf "$work/root/etc/resolv.conf"
  mkdir "$work/root/try"
  cp "$release/$2" "$source"/scripts/release/try_*.sh "$work/root/try/"
  cp -r "$source/models" "$work/root/try/models"
  began=$SECONDS
}
end() { echo "== took $((SECONDS - began)) s"; }

tarball=corank-$version-linux-x86_64.tar.gz
for suite in bookworm trixie; do
  begin "$suite" "$tarball"
  # As nobody: root is not needed. The folder may stand anywhere, and may be moved.
  offline bash -euc 'mkdir /tmp/a && tar -xzf "$0" -C /tmp/a && mv /tmp/a "/tmp/another place" && chmod -R go=rX /tmp/*' "/try/$tarball"
  folder="/tmp/another place/corank-$version"
  offline setpriv --reuid=65534 --regid=65534 --clear-groups env HOME=/tmp /try/try_program.sh "$folder/bin/corank" "$folder/share/corank/models"
  # The first x86-64 processors had SSE2, and nothing after it.
  if [[ $suite == bookworm ]]; then
    processor=qemu64,-sse3,-cx16,-lahf-lm,-svm
    echo "== The same program on the first x86-64, emulated"
    unshare --net qemu-x86_64 -cpu "$processor" "$work/root$folder/bin/corank" solve "$source/models/dextar.cuik" --set inverse --sigma 0.2 \
      --proof -o "$work/old.h5" | grep "complete: every solution"
    unshare --net qemu-x86_64 -cpu "$processor" "$work/root$folder/bin/corank" verify "$work/old.h5" | grep "^verified$"
  fi
  end

  package=corank-bundled_$version-1_amd64.deb
  begin "$suite" "$package"
  offline dpkg --install "/try/$package" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
  offline /try/try_program.sh corank /usr/share/corank/models
  end
done

begin bookworm "corank_$version-1_amd64.deb"
installed "/try/corank_$version-1_amd64.deb"
offline /try/try_program.sh corank /usr/share/corank/models
end

begin bookworm "python3-corank_$version-1_amd64.deb"
installed "/try/python3-corank_$version-1_amd64.deb"
offline python3 -c 'import corank; r = corank.load("/try/models/dextar.cuik").solve("inverse", sigma=0.1, proof=True); assert r.verify().complete; print(repr(r), r.boxes.shape)'
end

wheel=$(cd "$release" && echo corank-"$version"-cp311-*.whl)
begin bookworm "$wheel"
installed python3 python3-venv
offline /try/try_wheel.sh "/try/$wheel" /try/models
installed python3-numpy
offline /try/try_wheel.sh "/try/$wheel" /try/models
end
echo
echo "== Everything passes"
