#!/bin/bash
# What a user of the Debian packages does first, on a machine that has them and a compiler with CMake: README's Python lines, a
# search and its verification, one by dask, the manual, a program by find_package and by pkg-config.
#   scripts/packages_smoke.sh       from a clone, of which only README.md and tests/architecture/consumer are used
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
readme=$source/README.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
ln -s /usr/share/corank/models models

# Block n of README's Python section: 1 the program, 2 what it prints.
block() { awk -v n="$1" '/<!-- readme_python/ {on = 1} on && /^```/ {inside = !inside; k += inside; next} on && inside && k == n' "$readme"; }
block 1 >readme.py
block 2 >expected
[[ -s readme.py && -s expected ]] || { echo "README.md has no Python lines to try" >&2; exit 1; }
MPLBACKEND=Agg python3 readme.py | diff - expected
[[ $(wc -c <portrait.png) -gt 10000 ]]

corank solve models/three_slider.cuik --set forward --proof -o forward.h5 | grep "complete: every solution"
corank verify forward.h5
corank gallery three_slider -o gallery | grep "6 published numbers: 6 proven"
python3 -m corank.cluster solve models/three_slider.cuik --set forward --workers 1 -o spread.h5 | grep "complete: every solution"
gzip -t /usr/share/man/man1/corank.1.gz /usr/share/man/man1/corank-solve.1.gz

consumer=$source/tests/architecture/consumer
cmake -S "$consumer" -B build -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build build >/dev/null
build/consumer >by_cmake
mapfile -t flags < <(pkg-config --cflags --libs corank | tr ' ' '\n' | sed '/^$/d')
g++ -std=c++20 '-DMODELS="/usr/share/corank/models"' "$consumer/main.cc" -o by_pkg_config "${flags[@]}"
./by_pkg_config | diff - by_cmake
grep "8 isolated, complete" by_cmake
echo "== The packages pass"
