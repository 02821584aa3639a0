#!/bin/bash
# What a user of the program does first, on a machine that has nothing else: three sets of Dextar, a check, a report, ways; and
# pictures of Cairo, where it is in.
#   try_program.sh CORANK MODELS
set -euo pipefail
program=$(type -P "$1")
models=$2
for compiler in cc c++ gcc g++ clang; do
  ! command -v "$compiler" || { echo "this machine has a compiler" >&2; exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
corank() { "$program" "$@"; }
says() { grep "$1" "$2" || { cat "$2" >&2; echo "no line says: $1" >&2; exit 1; }; }

corank --version
for set in cspace forward; do
  corank solve "$models/dextar.cuik" --set "$set" --sigma 0.1 >said
  says "complete: every solution" said
done
corank solve "$models/dextar.cuik" --set inverse --sigma 0.1 --proof -o inverse.h5 >said
says "complete: every solution" said
corank verify inverse.h5 >said
says "^verified$" said
corank report "$models/dextar.cuik" -o page >said
[[ $(wc -c <page/index.html) -gt 1000000 ]]
echo "a report of $(wc -c <page/index.html) bytes"
head -c 300 page/figures/output-portrait.svg | grep -q "<svg"
if corank plot inverse.h5 --axes J3x,J3y -o portrait.pdf >said 2>&1; then
  head -c 5 portrait.pdf | grep -q "%PDF-"
  ! grep . said
  grep -aq "/FontName /[A-Z+]*DejaVu" portrait.pdf  # a font, not Cairo's own strokes
  corank plot inverse.h5 --axes J3x,J3y -o portrait.png
  head -c 4 portrait.png | grep -q "PNG"
  echo "with Cairo: .pdf and .png"
else
  says "libcairo2-dev" said
fi
corank path "$models/dextar.cuik" --from J3x=0.5,J3y=1 --from-mode 1 --to J3x=0.7,J3y=1 --to-mode 3 -o path.h5 >said
says "path, proven" said
corank verify path.h5 >said
says "^verified$" said

# In six dimensions, where samples propose ways: an arm of six joints.
sed -E 's/  range \[(t[146]), \1\]//' "$models/serial/ur5.cuik" >arm.cuik
corank path arm.cuik --avoid inverse --from theta1=0,theta2=-1,theta3=1,theta4=0.5,theta5=1,theta6=0 --from-mode 1 \
  --to theta1=3,theta2=-1.5,theta3=2,theta4=3,theta5=1,theta6=2 --to-mode 1 -o arm.h5 >said
says "path, proven" said
says "found by sampling" said
corank verify arm.h5 >said
says "^verified$" said
echo "== the program passes"
