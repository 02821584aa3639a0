#!/bin/bash
# The demonstration: builds corank and computes the singularities of the Dextar robot from its model file, with proofs.
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
build_release corank

solve() {
  echo
  echo "== corank solve models/dextar.cuik $*"
  (cd "$root" && "$build/app/corank" solve models/dextar.cuik "$@")
}
solve --set cspace --sigma 0.1 --threads 0
solve --set forward --sigma 0.01 --threads 0
solve --set inverse --sigma 0.01 --threads 0
