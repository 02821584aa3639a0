#!/bin/bash
# Builds the Python package corank for Debian's own Python and installs it: for all users (as root), with --user for oneself,
# with --prefix DIR below DIR. Needs no network where the packages of scripts/packages.txt are installed.
set -euo pipefail
usage() { echo "usage: scripts/install_python.sh [--user | --prefix DIR]" >&2; exit 2; }
python=/usr/bin/python3
path='import sysconfig; print(sysconfig.get_path("platlib", "posix_local"))'
case "${1:-}" in
  "") ;;
  --user) path='import site; print(site.getusersitepackages())' ;;
  --prefix)
    [[ $# -eq 2 ]] || usage
    base=$(realpath -m "$2")
    path="import sysconfig; print(sysconfig.get_path('platlib', 'posix_prefix', vars={'platbase': '$base'}))"
    shift
    ;;
  *) usage ;;
esac
[[ $# -le 1 ]] || usage
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
build_release "program options python pythonoptions" corank_python
place=$("$python" -c "$path")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --component python --prefix "$work" --strip >/dev/null
mkdir -p "$place"
rm -rf "${place:?}/corank"
cp -r "$work"/lib/python3/dist-packages/corank "$place/"
PYTHONPATH=$place "$python" -B -c 'import corank; print("== corank", corank.__version__, "is in", corank.__path__[0])'
if ! (cd / && "$python" -B -c 'import corank' 2>/dev/null); then
  echo "== Python does not look there by itself: export PYTHONPATH=$place"
fi
