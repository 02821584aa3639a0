#!/bin/bash
# Installs the missing Debian packages of these groups of scripts/packages.txt; does nothing where all are installed.
#   scripts/install_packages.sh [GROUP…]      default: all groups
set -euo pipefail
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
mapfile -t groups < <(sed -n 's/^\[\([a-z]*\)\]$/\1/p' "$scripts/packages.txt")
for group in "$@"; do
  [[ " ${groups[*]} " == *" $group "* ]] || { echo "$group: no group of packages; there are: ${groups[*]}" >&2; exit 2; }
done
[[ $# -eq 0 ]] || groups=("$@")
mapfile -t packages < <(awk -v groups=" ${groups[*]} " '
  {sub(/#.*/, ""); gsub(/[[:space:]]/, "")}
  /^\[/ {wanted = index(groups, " " substr($0, 2, length($0) - 2) " "); next}
  wanted && NF' "$scripts/packages.txt")

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "corank's scripts install Debian packages, and this is no Debian system. Install what corresponds to" >&2
  echo "  ${packages[*]}" >&2
  echo "then build by hand: cmake --preset release && cmake --build --preset release" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  echo "== All ${#packages[@]} Debian packages are installed"
  exit 0
fi

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "Some Debian packages are missing, and only root may install them (there is no sudo). As root:" >&2
    echo "  apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "== Installing ${#missing[@]} Debian packages: ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
quietly() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }; }
# Lists of the last hour are new enough.
[[ -n $(find /var/lib/apt/lists -maxdepth 1 -name '*InRelease' -cmin -60 2>/dev/null) ]] || quietly apt-get update -q
quietly apt-get install -q -y --no-install-recommends "${missing[@]}"
echo "== Installed in $SECONDS s"
