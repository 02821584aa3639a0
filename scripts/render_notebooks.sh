#!/bin/bash
# Runs the notebooks of python/notebooks/ with a build's package and renders them into doc/notebooks/, as Markdown with pictures.
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
build_release "" corank_python
PYDEVD_DISABLE_FILE_VALIDATION=1 PYTHONPATH=$build/python /usr/bin/python3 -B "$root/python/notebooks/render.py" "$root" "$root/doc/notebooks"
