#!/bin/bash
# Formats every C++, Python and JavaScript file in place; with --check changes nothing and fails where a file is not formatted.
#   scripts/format.sh [--check] [cpp|python|javascript]      default: cpp python
# C++ needs clang-format 14 and Python black 23, both of Debian 12. JavaScript needs prettier, which npx takes from npm's registry.
# With another version, or without, --check ends with status 77.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
check=false
if [[ ${1:-} == --check ]]; then
  check=true
  shift
fi
languages=("$@")
[[ $# -gt 0 ]] || languages=(cpp python)

is_there() { # program version
  "$1" --version 2>/dev/null | grep -q "$2" && return
  echo "$1 is missing, or has another version than this script uses" >&2
  if $check; then exit 77; else exit 1; fi
}
python=(python bench doc gallery scripts tests)
for language in "${languages[@]}"; do
  case $language in
    cpp)
      is_there clang-format "version 14\."
      if $check; then mode=(--dry-run -Werror); else mode=(-i); fi
      find $(grep -o '^[a-z]*:' cmake/folders.txt | tr -d ':') tests \( -name '*.h' -o -name '*.cc' \) -print0 | xargs -0 clang-format "${mode[@]}"
      ;;
    python)
      is_there black "black, 23\."
      if $check; then mode=(--check); else mode=(); fi
      black --quiet --line-length 125 --include '\.pyi?$' "${mode[@]}" "${python[@]}" ||
        { echo "Some Python files are not formatted: scripts/format.sh python" >&2; exit 1; }
      ;;
    javascript)
      if $check; then mode=--check; else mode=--write; fi
      npx --yes prettier@3.6.2 --print-width 125 --no-bracket-spacing "$mode" report/page/*.js
      ;;
    *) echo "usage: scripts/format.sh [--check] [cpp|python|javascript]" >&2; exit 2 ;;
  esac
done
