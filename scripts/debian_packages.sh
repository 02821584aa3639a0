#!/bin/bash
# Makes the Debian packages corank, libcorank-dev and python3-corank in build/release, and lets lintian look at them where it is
# installed: an error of its ends the script.
#   scripts/debian_packages.sh [--build FOLDER]      FOLDER: a release build that exists; default: build/release, built first
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
case "${1:-}" in
  "") build_release "program options python packaging" corank cuik cuikequations cuikplot3d cuikatan2 corank_manual corank_python ;;
  --build) build=$(realpath "$2") ;;
  *) echo "usage: scripts/debian_packages.sh [--build FOLDER]" >&2; exit 2 ;;
esac
rm -f "$build"/*.deb
(cd "$build" && cpack --config CPackConfig.cmake >cpack.log 2>&1) || { cat "$build/cpack.log" >&2; exit 1; }
ls -l "$build"/*.deb
if command -v lintian >/dev/null; then
  lintian --fail-on error "$build"/*.deb
fi
