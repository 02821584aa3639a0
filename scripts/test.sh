#!/bin/bash
# Builds everything and runs every test.
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
meanwhile="pythonoptions testruns documents"
build_release "program options python tests packaging" all
echo "== Running the tests"
ctest --test-dir "$build" --output-on-failure --no-tests=error -j$(($(nproc) + 1))  # one more, since some wait
