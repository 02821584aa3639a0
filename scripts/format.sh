#!/bin/bash
# Formats every C++ file in place; with --check changes nothing and fails where a file is not formatted. Needs clang-format 14; with another
# one, or without, --check ends with status 77.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
case "${1:-}" in
  "") mode=(-i) ;;
  --check)
    mode=(--dry-run -Werror)
    clang-format --version 2>/dev/null | grep -q "version 14\." || { echo "clang-format 14 is missing: nothing is checked" >&2; exit 77; }
    ;;
  *) echo "usage: scripts/format.sh [--check]" >&2; exit 2 ;;
esac
find $(grep -o '^[a-z]*:' cmake/folders.txt | tr -d ':') tests \( -name '*.h' -o -name '*.cc' \) -print0 | xargs -0 clang-format "${mode[@]}"
