# Sourced by demo.sh, test.sh and others: installs what is missing and builds the release preset; they share build/release.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release

# Reads what ninja says; shows how much is done in percent, on a terminal in one line, else in a line for every tenth. What a
# compiler says stays.
show_progress() { # what is built
  local line percent tenth=-1
  while IFS= read -r line; do
    if [[ $line =~ ^@\ *([0-9]+)%@ ]]; then
      percent=${BASH_REMATCH[1]}
      if [[ -t 1 ]]; then
        printf '\r== Building %s: %3d %%' "$1" "$percent"
      elif ((percent / 10 > tenth)); then
        tenth=$((percent / 10))
        echo "== Building $1: $((10 * tenth)) %"
      fi
    elif [[ $line != "ninja: no work to do." ]]; then
      [[ ! -t 1 ]] || printf '\r\033[K'
      echo "$line"
    fi
  done
  [[ ! -t 1 ]] || printf '\r\033[K'
}

# build_release "GROUP…" TARGET…: the groups are those of packages.txt; "" means all. The groups of the variable `meanwhile`, which no build
# asks for, are installed while the compiler works.
build_release() {
  local groups
  read -ra groups <<<"$1"
  shift
  if [[ -e $build && ! -w $build ]]; then
    echo "$build belongs to $(stat -c %U "$build"); remove it or run this as that user" >&2
    exit 1
  fi
  "$root/scripts/install_packages.sh" "${groups[@]}"
  echo "== Configuring $build"
  local log
  log=$(mktemp)
  (cd "$root" && cmake --preset release >"$log" 2>&1) || { cat "$log" >&2; rm -f "$log"; exit 1; }
  local installing=
  if [[ -n ${meanwhile:-} ]]; then
    local later
    read -ra later <<<"$meanwhile"
    "$root/scripts/install_packages.sh" "${later[@]}" >"$log" 2>&1 &
    installing=$!
    trap wait EXIT  # an installation is never cut off
  fi
  echo "== Building $* (minutes the first time, seconds after that)"
  local begin=$SECONDS
  NINJA_STATUS='@%p@ ' cmake --build "$build" --target "$@" 2>&1 | show_progress "$*"
  echo "== Built $* in $((SECONDS - begin)) s"
  if [[ -n $installing ]]; then
    wait "$installing" || { cat "$log" >&2; rm -f "$log"; exit 1; }
    cat "$log"
  fi
  rm -f "$log"
}
