# Sourced by demo.sh and test.sh: installs what is missing and builds the release preset; they share build/release.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release

# build_release TARGET...
build_release() {
  if [[ -e $build && ! -w $build ]]; then
    echo "$build belongs to $(stat -c %U "$build"); remove it or run this as that user" >&2
    exit 1
  fi
  "$root/scripts/install_packages.sh"
  echo "== Configuring $build"
  local log
  log=$(mktemp)
  (cd "$root" && cmake --preset release >"$log" 2>&1) || { cat "$log" >&2; rm -f "$log"; exit 1; }
  rm -f "$log"
  echo "== Building $* (minutes the first time, seconds after that)"
  local quiet=()
  [[ -t 1 ]] || quiet=(--quiet)
  cmake --build "$build" --target "$@" -- "${quiet[@]}"
}
