#!/bin/bash
# The demonstration: builds corank and computes the singularities of the Dextar robot from its model file, with proofs; then
# makes the report about them, and says where it is.
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
build_release program corank

run() {
  echo
  echo "== corank $*"
  (cd "$root" && "$build/app/corank" "$@")
}
run solve models/dextar.cuik --set cspace --sigma 0.1
run solve models/dextar.cuik --set forward --sigma 0.01
run solve models/dextar.cuik --set inverse --sigma 0.01
run report models/dextar.cuik -o build/dextar
echo
echo "== To look at, in a browser:"
echo "   the report   file://$root/build/dextar/index.html"
echo "   its picture  file://$root/build/dextar/figures/output-portrait.svg"
