#!/bin/bash
# What a user of the wheel does first, on a machine with Python 3.11 and no network: a virtual environment with nothing else in it.
#   try_wheel.sh WHEEL MODELS
set -euo pipefail
wheel=$1
models=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv plain
plain/bin/pip install --quiet --no-index "$wheel"
plain/bin/pip list --format=freeze
cat >try.py <<'PYTHON'
import sys, corank

models = sys.argv[1]
dextar = corank.load(models + "/dextar.cuik")
r = dextar.solve("inverse", sigma=0.1, proof=True)
assert r.complete and r.counts["regular"] > 500, r
assert r.verify().complete
r.save("inverse.h5")
assert corank.open("inverse.h5").verify().verified
page = dextar.report("page")
assert "<html" in open("page/index.html").read(1000), page
way = dextar.path({"J3x": "0.5", "J3y": 1}, {"J3x": "0.7", "J3y": 1}, start_mode=1, end_mode=3)
assert way and way.verify(), way
try:
    shape = r.boxes.shape
    print("with NumPy: boxes", shape)
    assert shape[1:] == (14, 2)
except ModuleNotFoundError as error:
    print("without NumPy:", error)
print(repr(r))
PYTHON
plain/bin/python try.py "$models" | tee said
grep -q "without NumPy: this needs the Python package numpy" said
if python3 -c "import numpy" 2>/dev/null; then
  python3 -m venv --system-site-packages other
  other/bin/pip install --quiet --no-index "$wheel"
  other/bin/python try.py "$models" | tee said
  grep -q "with NumPy: boxes" said
fi
echo "== the wheel passes"
