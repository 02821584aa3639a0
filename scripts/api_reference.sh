#!/bin/bash
# Builds the references of the C++ library (Doxygen) and of the Python package (Sphinx) in build/api; a warning is an error.
# Needs the packages doxygen and python3-sphinx.
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
for program in doxygen sphinx-build; do
  command -v "$program" >/dev/null || { echo "$program is missing: apt-get install doxygen python3-sphinx" >&2; exit 1; }
done
build_release "" corank_python
api=$root/build/api
rm -rf "$api"
mkdir -p "$api"
echo "== Doxygen"
folders=$(grep -o '^[a-z]*:' "$root/cmake/folders.txt" | tr -d ':' | grep -v -E '^(app|bench|python)$')
inputs=$(for folder in $folders; do echo -n "$root/$folder "; done)
(cat "$root/doc/api/Doxyfile"; echo "INPUT = $inputs"; echo "OUTPUT_DIRECTORY = $api"; echo "HTML_OUTPUT = cpp"
  echo "STRIP_FROM_PATH = $root"; echo "INPUT_FILTER = \"perl $root/doc/api/plain_comments.pl\"") | doxygen -
echo "== Sphinx"
PYTHONPATH=$build/python /usr/bin/python3 -B -m sphinx -q -W --keep-going -b html -d "$api/doctrees" "$root/doc/api" "$api/python"
echo "== $api/cpp/index.html and $api/python/index.html"
