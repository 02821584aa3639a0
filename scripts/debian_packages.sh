#!/bin/bash
# Makes the Debian packages corank, libcorank-dev and python3-corank in build/release, and lets lintian look at them where it is
# installed: an error of its ends the script.
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
build_release "" all
rm -f "$build"/*.deb
(cd "$build" && cpack --config CPackConfig.cmake >cpack.log 2>&1) || { cat "$build/cpack.log" >&2; exit 1; }
ls -l "$build"/*.deb
if command -v lintian >/dev/null; then
  lintian --fail-on error "$build"/*.deb
fi
