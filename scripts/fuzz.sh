#!/usr/bin/env bash
# Builds the fuzzers with clang and runs each for a number of seconds:  scripts/fuzz.sh [SECONDS, default 180]
# Inputs that reach new code are added to build-fuzz/corpus; an input that crashes is kept in build-fuzz/findings.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build-fuzz
seconds=${1:-180}
compiler=${CORANK_FUZZ_CXX:-$(command -v clang++-14 || command -v clang++)}

echo "fuzz: building with $compiler in $build"
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
      -DCORANK_BUILD_FUZZERS=ON -DCORANK_BUILD_TESTS=ON -DCORANK_BUILD_BENCH=OFF >/dev/null
fuzzers="model_file urdf cuik_sol cuik_param result_file"
ninja -C "$build" $(printf '%s_fuzzer ' $fuzzers)

for fuzzer in $fuzzers; do
  mkdir -p "$build/corpus/$fuzzer" "$build/findings"
  echo "fuzz: $fuzzer for $seconds s"
  "$build/tests/fuzz/${fuzzer}_fuzzer" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
      -dict="$root/tests/fuzz/$fuzzer.dict" -artifact_prefix="$build/findings/$fuzzer-" \
      "$build/corpus/$fuzzer" "$root/tests/fuzz/corpus/$fuzzer"
done
