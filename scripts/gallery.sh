#!/bin/bash
# The gallery: reproduces published results with proof, prints the table, and writes a page about them. Exits non-zero where a
# published number is not met. Answers are stored in the page's folder, and taken from there while nothing has changed.
#   scripts/gallery.sh [--quick] [ENTRY…] [-o FOLDER] [OPTION…]      options of corank gallery; default folder: build/gallery
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
build_release program corank
folder=(-o "$root/build/gallery")
for word in "$@"; do
  if [[ $word == -o ]]; then folder=(); fi
done
exec "$build/app/corank" gallery --entries "$root/gallery" "${folder[@]}" "$@"
