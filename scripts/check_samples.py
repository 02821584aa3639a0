#!/usr/bin/env python3
"""Samples singular configurations of robots by other means than corank's, and looks for each in the boxes of its result.

  PYTHONPATH=build/release/python scripts/check_samples.py PROGRAM MODEL_OR_FOLDER... [--samples 2000] [--seconds 60]
      [--sets forward inverse cspace-singular] [--seed 1]

A sample is found by Gauss and Newton in doubles from a random start, on the assembly constraints as `corank derive` prints
them and on M ξ = 0, where M has the columns of the velocity equation that belong to the set. Derivatives are made here, by
complex steps. A sample counts if it satisfies the constraints and lies in the ranges, and if the smallest singular value of
M is 0. If the velocity equation is not one of its own, its matrix is compared with the derivative of the constraints.

Each sample has to lie in a box, of whatever verdict: this holds for a result that a limit ended, too. Not searched for in
the boxes is a kernel vector. A model whose set cannot be derived, or a machine without NumPy, is skipped, and said.
Prints a line for each model and set; exit status 1 if a sample is missed, or if a matrix is not the derivative.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

try:
    import numpy as np
except ImportError:
    print("skipped: there is no NumPy")
    sys.exit(0)

SETS = ["forward", "inverse", "cspace-singular"]
LOCKED = {"forward": "input", "inverse": "output", "cspace-singular": None}
STEP = 1e-30  # into the complex plane
BATCH, MOST_STEPS = 256, 60
MOST_EMPTY = 8  # batches without any sample: there seem to be none
SOLVED, SINGULAR = 1e-10, 1e-8  # of scaled equations; of the largest singular value
NEAR = 1e-6  # of a typical size: what doubles and a degenerate solution may leave between a sample and its box


class Expressions:
    """Texts of the model language, evaluated over arrays."""

    def __init__(self, texts, names, constants):
        self.names = names
        self.space = {"sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "pi": np.pi, "__builtins__": {}}
        self.space.update(constants)
        self.codes = [compile(self.plain(text), "model", "eval") for text in texts]

    @staticmethod
    def plain(text):
        return text.replace("^", "**")

    def __call__(self, x):
        """x: … × names; the result: … × texts."""
        space = dict(self.space, **{name: x[..., i] for i, name in enumerate(self.names)})
        result = np.empty((*x.shape[:-1], len(self.codes)), dtype=x.dtype)
        for i, code in enumerate(self.codes):
            result[..., i] = eval(code, space)  # pylint: disable=eval-used
        return result


def with_derivatives(function, x):
    """Values and Jacobians of B points."""
    n = x.shape[1]
    steps = np.concatenate([np.zeros((1, n)), np.eye(n)]) * 1j * STEP
    values = function(x[:, None, :] + steps[None, :, :])
    return values[:, 0].real, np.swapaxes(values[:, 1:].imag / STEP, 1, 2)


class Sampled:
    """One set of one model: its equations, and samples of it."""

    def __init__(self, program, words, set_name):
        derived = subprocess.run([program, "derive", *words, "--json"], capture_output=True, text=True, timeout=300)
        if derived.returncode:
            raise ValueError(derived.stderr.strip()[-150:])
        model = json.loads(derived.stdout)
        if not model["inputs"] or not model["outputs"]:
            raise ValueError("no inputs or no outputs")
        roles = self.roles(program, words, model)
        constants = {}
        for name, text in model["constants"].items():
            constants[name] = Expressions([text], [], dict(constants))(np.zeros(0)).item()
        value = lambda text: Expressions([text], [], constants)(np.zeros(0)).item()
        self.names = [c["name"] for c in model["coordinates"]]
        self.is_angle = np.array([c["kind"] == "angle" for c in model["coordinates"]])
        end = lambda c, side, sign: sign * np.inf if c[side] is None else value(c[side])
        self.lower = np.array([end(c, "lower", -1) for c in model["coordinates"]])
        self.upper = np.array([end(c, "upper", 1) for c in model["coordinates"]])
        whole = self.is_angle & (self.upper - self.lower > 2 * np.pi - 1e-9)
        self.lower[whole], self.upper[whole] = -np.inf, np.inf
        ends = np.abs(np.concatenate([self.lower, self.upper])[np.concatenate([~self.is_angle] * 2)])
        numbers = re.findall(r"(?<![\w.])\d+(?:\.\d+)?", " ".join(model["constraints"]))
        plain = [abs(v) for v in [*constants.values(), *map(float, numbers)] if np.isfinite(v)]
        sizes = [s for s in [*ends[np.isfinite(ends)], *plain] if s > 0]
        self.size = max(sizes, default=1.0)  # of lengths without a range
        self.scale = np.where(self.is_angle, 1.0, self.size)
        bounded = np.isfinite(self.lower) & np.isfinite(self.upper) & ~self.is_angle
        self.scale[bounded] = np.maximum(np.abs(self.lower), np.abs(self.upper))[bounded]
        self.scale[self.scale == 0] = self.size
        self.free = np.flatnonzero(self.upper > self.lower)
        system = model["systems"][0]
        sides = [e["relation"].split(" = ") for e in system["equations"]]
        self.constraints = Expressions([f"({a})-({b})" for a, b in sides], self.names, constants)
        kept = [g["relation"] for g in system["inequalities"]]
        kept = [re.split(r" (>=|<=) ", g) for g in kept]
        positive = [f"({g[0]})-({g[2]})" if g[1] == ">=" else f"({g[2]})-({g[0]})" for g in kept if len(g) == 3]
        self.inequalities = Expressions(positive, self.names, constants)
        velocity = model["velocity"]
        locked = LOCKED[set_name]
        columns = [j for j, name in enumerate(velocity["columns"]) if not locked or roles.get(name) != locked]
        rows = velocity["rows"]
        self.shape = (len(rows), len(columns))
        self.matrix = Expressions([row[j] for row in rows for j in columns], self.names, constants)
        self.own_velocity = velocity["given"]
        self.given = Expressions([t for t in model["constraints"]], self.names, constants)
        self.all_rows = Expressions([t for row in rows for t in row], self.names, constants)
        self.columns = velocity["columns"]

    @staticmethod
    def roles(program, words, model):
        """Whose rate a column is: input, output or nothing."""
        text = subprocess.run(
            [program, "derive", *words, "--format", "model"], capture_output=True, text=True, timeout=300
        ).stdout
        rates = re.search(r"^\[RATES\]\n(.*?)\n\s*\n", text, re.M | re.S)
        if model["velocity"]["given"] and rates:
            return dict(re.findall(r"^(\w+)\s*[:~]\s*(input|output|passive)", rates[1], re.M))
        return {**{n: "output" for n in model["outputs"]}, **{n: "input" for n in model["inputs"]}}

    def whole(self, x):
        """Free coordinates, scaled → all coordinates."""
        q = np.broadcast_to(np.where(np.isfinite(self.lower), self.lower, 0.0), (*x.shape[:-1], len(self.names)))
        q = np.array(q, dtype=x.dtype)
        q[..., self.free] = x * self.scale[self.free]
        return q

    def matrices(self, q):
        return self.matrix(q).reshape(*q.shape[:-1], *self.shape)

    def jacobian_differs(self, rng):
        """The largest difference between the velocity equation's matrix and the constraints' derivative, relative."""
        if self.own_velocity:
            return 0.0
        q = rng.uniform(-1, 1, (8, len(self.names))) * self.scale
        _, derivative = with_derivatives(self.given, q)
        order = [self.names.index(c) for c in self.columns]
        rows = self.all_rows(q).reshape(8, -1, len(self.columns))
        return np.max(np.abs(derivative[:, :, order] - rows)) / np.max(np.abs(rows))

    def starts(self, rng):
        low = np.where(np.isfinite(self.lower), self.lower, np.where(self.is_angle, -np.pi, -self.scale))[self.free]
        high = np.where(np.isfinite(self.upper), self.upper, np.where(self.is_angle, np.pi, self.scale))[self.free]
        return rng.uniform(low, high, (BATCH, len(self.free))) / self.scale[self.free]

    def row_sizes(self, rng):
        """Of the constraints, and of the rows and columns of M: what makes all of them about 1."""
        q = self.whole(self.starts(rng))
        size = lambda a: np.where(a > 0, a, 1.0)
        _, jacobian = with_derivatives(lambda x: self.constraints(self.whole(x)), self.starts(rng))
        constraints = size(np.max(np.abs(jacobian), axis=(0, 2)))
        matrix = np.max(np.abs(self.matrices(q)), axis=0)
        column = size(np.max(matrix, axis=0))
        return constraints, size(np.max(matrix / column, axis=1)), column

    def batch(self, rng, sizes):
        """Singular configurations from BATCH random starts."""
        of_constraints, of_rows, of_columns = sizes
        n = len(self.free)
        m, k = self.shape
        left = k > m  # the kernel is of the smaller side
        closing = lambda x: self.constraints(self.whole(x)) / of_constraints
        scaled = lambda x: self.matrices(self.whole(x)) / of_rows[:, None] / of_columns

        def equations(y):
            x, xi = y[..., :n], y[..., n:]
            a = scaled(x)
            product = np.einsum("...ij,...i->...j" if left else "...ij,...j->...i", a, xi)
            return np.concatenate([closing(x), product, np.sum(xi * xi, axis=-1, keepdims=True) - 1], axis=-1)

        def steps(function, x, count):
            for _ in range(count):
                value, jacobian = with_derivatives(function, x)
                good = np.all(np.isfinite(jacobian), axis=(1, 2)) & np.all(np.isfinite(value), axis=1)
                x, value, jacobian = x[good], value[good], jacobian[good]
                if not len(x):
                    break
                step = np.einsum("bij,bj->bi", np.linalg.pinv(jacobian, rcond=1e-9), value)
                length = np.linalg.norm(step, axis=1, keepdims=True)
                x = x - step * np.minimum(1, 0.5 / np.maximum(length, 1e-300))
            return x

        x = steps(closing, self.starts(rng), 10)
        if not len(x):
            return np.zeros((0, len(self.names)))
        u, _, v = np.linalg.svd(scaled(x), full_matrices=False)
        y = steps(equations, np.concatenate([x, u[:, :, -1] if left else v[:, -1, :]], axis=1), MOST_STEPS)
        if not len(y):
            return np.zeros((0, len(self.names)))
        x = y[:, :n]
        q = self.whole(x)
        singular = np.linalg.svd(scaled(x), compute_uv=False)
        good = (np.max(np.abs(closing(x)), axis=1) < SOLVED) & (singular[:, -1] < SINGULAR * singular[:, 0])
        turns = np.where(self.is_angle, 2 * np.pi, 0)
        middle = (np.nan_to_num(self.lower, neginf=0) + np.nan_to_num(self.upper, posinf=0)) / 2
        q = q - turns * np.round((q - middle) / np.where(turns > 0, turns, 1))
        room = 1e-9 * self.scale
        good &= np.all((q >= self.lower - room) & (q <= self.upper + room), axis=1)
        if self.inequalities.codes:
            good &= np.all(self.inequalities(q) >= -1e-9 * self.size, axis=1)
        return q[good]

    def samples(self, rng, count, seconds):
        began = time.process_time()
        sizes = self.row_sizes(rng)
        found = []
        while sum(map(len, found)) < count and time.process_time() - began < seconds:
            found.append(self.batch(rng, sizes))
            if len(found) >= MOST_EMPTY and not any(map(len, found)):
                break
        return np.concatenate(found)[:count] if found else np.zeros((0, len(self.names)))


def missed(sampled, result, samples):
    """Those that are in no box."""
    boxes, place = result.boxes, {name: i for i, name in enumerate(result.variables)}
    angles = result.angles
    sides = []
    for i, name in enumerate(sampled.names):
        if sampled.is_angle[i] and name in angles:
            a = angles[name]
            index = lambda v: v if isinstance(v, int) else place[v]
            sides += [(index(a.cosine), np.cos(samples[:, i]), 1.0), (index(a.sine), np.sin(samples[:, i]), 1.0)]
        elif name in place:
            sides.append((place[name], samples[:, i], sampled.scale[i]))
    lost = []
    columns = [(boxes[:, j, 0] - NEAR * size, boxes[:, j, 1] + NEAR * size, x) for j, x, size in sides]
    for s in range(len(samples)):
        left = None
        for low, high, x in columns:
            if left is None:
                left = np.flatnonzero((low <= x[s]) & (high >= x[s]))
            else:
                left = left[(low[left] <= x[s]) & (high[left] >= x[s])]
        if not len(left):
            lost.append(s)
    return lost


def check(program, path, set_name, options):
    import corank  # pylint: disable=import-outside-toplevel

    loops = path.with_suffix(".loops")
    words = [str(path), "--loops", str(loops)] if path.suffix == ".urdf" and loops.exists() else [str(path)]
    label = f"{path.stem} {set_name}"
    rng = np.random.default_rng(options.seed)
    try:
        sampled = Sampled(program, words, set_name)
        differs = sampled.jacobian_differs(rng)
        samples = sampled.samples(rng, options.samples, options.seconds)
    except (ValueError, KeyError, NameError, SyntaxError, np.linalg.LinAlgError) as error:
        print(f"{label}: skipped: {error}", flush=True)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "r.h5"
        solve = [program, "solve", *words, "--set", set_name, "--time-limit", str(options.seconds), "-o", str(file)]
        done = subprocess.run(solve, capture_output=True, text=True, timeout=3 * options.seconds + 60)
        if not file.exists():
            print(f"{label}: skipped: {done.stderr.strip()[-150:]}", flush=True)
            return 0
        result = corank.open(str(file))
    lost = missed(sampled, result, samples) if len(samples) else []
    state = "complete" if result.complete else "ended by the limit"
    print(f"{label}: {len(samples)} samples, {len(lost)} missed; {len(result.boxes)} boxes, {state}", flush=True)
    for s in lost[:3]:
        print("  missed: " + ", ".join(f"{n}={x:.12g}" for n, x in zip(sampled.names, samples[s])), flush=True)
    if differs > 1e-10:
        print(f"  the velocity equation is not the derivative of the constraints: {differs:.2g}", flush=True)
    return len(lost) + (differs > 1e-10)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("models", nargs="+", type=pathlib.Path, metavar="MODEL_OR_FOLDER")
    parser.add_argument("--samples", type=int, default=2000)
    parser.add_argument("--seconds", type=float, default=60, help="for the search, and for the samples")
    parser.add_argument("--sets", nargs="+", choices=SETS, default=SETS)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    files = []
    for path in options.models:
        if not path.exists():
            print(f"skipped: there is no {path}")
        inside = sorted(f for f in path.rglob("*") if f.suffix in (".cuik", ".urdf"))
        files += inside if path.is_dir() else [path] * path.exists()
    return any([check(program, path, name, options) > 0 for path in files for name in options.sets])


if __name__ == "__main__":
    sys.exit(main())
