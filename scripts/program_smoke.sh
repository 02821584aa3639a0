#!/bin/bash
# What the program of scripts/demo.sh does on a machine that has the group [program] of packages.txt alone: searches, proofs,
# pictures and ways that need no Cairo; and that it says what needs it.
#   scripts/program_smoke.sh       after scripts/demo.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
corank=build/release/app/corank
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
! ldd "$corank" | grep libcairo || { echo "$corank was built with more than [program]" >&2; exit 1; }

test -s build/dextar/index.html
head -c 200 build/dextar/figures/output-portrait.svg | grep -q "<svg"
[[ -z $(find build/dextar -name '*.pdf') ]]
"$corank" solve models/dextar.cuik --set inverse --sigma 0.1 --proof -o "$work/inverse.h5" | grep "complete: every solution"
"$corank" verify "$work/inverse.h5"
"$corank" plot "$work/inverse.h5" --axes J3x,J3y -o "$work/inverse.svg"
if "$corank" plot "$work/inverse.h5" --axes J3x,J3y -o "$work/inverse.pdf" 2>"$work/said"; then exit 1; fi
grep "apt install libcairo2-dev" "$work/said"
"$corank" path models/dextar.cuik --from J3x=0.5,J3y=1 --from-mode 1 --to J3x=0.7,J3y=1 --to-mode 3 -o "$work/path.h5" | grep "path, proven"
"$corank" verify "$work/path.h5"
echo "== The program passes"
