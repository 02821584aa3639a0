#!/usr/bin/env python3
"""Ends commands of corank at random moments, by --time-limit and by signals, and looks at how they take it.

  scripts/check_stops.py PROGRAM FOLDER... [--cases 200 | --each 1] [--seed 1] [--slack 1] [--command aspects]
                         [--only WORD] [--large] [--pages]

Each case takes one command, one model of the folders and one moment; --each N takes every command on every model N times;
--large adds models of thousands of variables and joints, which it writes itself. What is checked:
- the program ends within --slack seconds of processor time after the moment;
- its exit status is one of a statement, or, of a command that has no handler yet, the signal's;
- every result file that it left is one that `corank verify` reads and finds nothing wrong with, and no half-written file
  is left;
- a report that ended by itself or by a statement has left a page.
--pages instead makes the report of every model with the options' defaults: a page within a minute of wall time, or of
processor time where other programs take the machine.
Prints one line for each case that fails, then the counts; exit status 1 if any failed.
"""
import argparse
import json
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time

TICK = os.sysconf("SC_CLK_TCK")
SETS = [
    *["cspace", "forward", "inverse", "cspace-singular", "boundary", "forward-inverse"],
    *["ro", "rpm", "ii", "ri", "io", "iim"],
    *["forward-cusps", "inverse-cusps", "forward-nodes", "inverse-nodes", "nodes"],
]
SECONDS_OF_A_PAGE = 60
# Of results that are there before: what is checked is not the search that makes them.
OF_RESULTS = ["verify", "verify-claims", "plot", "angles", "report-results"]
COMMANDS = [
    *["solve", "solve-boundary", "aspects", "cusps", "topology", "path", "clearance", "clearance-best", "clearance-map"],
    *["map", "sweep", "report", "derive", *OF_RESULTS],
]


def processor_time(pid):
    """Of a process and all below it, in seconds; those that ended and were waited for are in their parent's."""
    total = 0
    waiting = [pid]
    while waiting:
        p = waiting.pop()
        try:
            fields = pathlib.Path(f"/proc/{p}/stat").read_text().rsplit(")", 1)[1].split()
            for task in pathlib.Path(f"/proc/{p}/task").iterdir():
                waiting += [int(c) for c in (task / "children").read_text().split()]
        except (FileNotFoundError, ProcessLookupError, IndexError):
            continue
        total += sum(int(fields[i]) for i in (11, 12, 13, 14)) / TICK
    return total


class Model:
    """A file, with what a random question about it needs to know."""

    def __init__(self, program, file, folder):
        self.program, self.file, self.folder = program, file, folder
        loops = pathlib.Path(file).with_suffix(".loops")
        self.words = [file, "--loops", str(loops)] if file.endswith(".urdf") and loops.exists() else [file]
        self._facts = None
        self._results = {}

    def facts(self):
        if self._facts is None:
            try:
                derived = subprocess.run(
                    [self.program, "derive", *self.words, "--json"], capture_output=True, text=True, timeout=20
                )
                self._facts = json.loads(derived.stdout) if derived.returncode == 0 else {}
            except (subprocess.TimeoutExpired, ValueError):
                self._facts = {}
        return self._facts

    def coordinates(self, kind=None):
        return [c for c in self.facts().get("coordinates", []) if kind in (None, c["kind"])]

    def mobility(self):
        return max(1, len(self.coordinates()) - len(self.facts().get("constraints", [])))

    def result(self, name, *arguments):
        """A result file of a few seconds' search, made once; nothing where the command makes none."""
        if name not in self._results:
            path = self.folder / f"{pathlib.Path(self.file).stem}-{abs(hash(self.file)) % 10**8}-{name}.h5"
            command = [self.program, arguments[0], *self.words, *arguments[1:], "--time-limit", "3", "-o", str(path)]
            try:
                subprocess.run(command, capture_output=True, timeout=120)
            except subprocess.TimeoutExpired:
                print(f"{' '.join(command)}: not ended after 120 s", flush=True)
            self._results[name] = str(path) if path.exists() else None
        return self._results[name]


def number(text, default):
    """What a range's end is worth, roughly: constants of the model are not looked up."""
    try:
        return float(text)
    except (TypeError, ValueError):
        return default


def point(model, names, rng):
    """Values for these coordinates, in their ranges where these are plain numbers."""
    values = []
    for c in model.coordinates():
        if c["name"] in names:
            low, high = number(c["lower"], -1.0), number(c["upper"], 1.0)
            values.append(f"{c['name']}={rng.uniform(low, high) if low < high else low:.4g}")
    return ",".join(values)


def plane(model, rng):
    """Two constants, or two coordinates where the others are determined by them, for a map."""
    constants = [(n, number(v, None)) for n, v in model.facts().get("constants", {}).items()]
    constants = [(n, v) for n, v in constants if v]
    if len(constants) >= 2 and rng.random() < 0.5:
        chosen = [(n, min(v / 2, v * 2), max(v / 2, v * 2)) for n, v in rng.sample(constants, 2)]
    else:
        coordinates = rng.sample(model.coordinates(), 2) if len(model.coordinates()) >= 2 else []
        chosen = [(c["name"], number(c["lower"], -1.0), number(c["upper"], 1.0)) for c in coordinates]
    return [word for n, low, high in chosen for word in ("--over", f"{n}={low:.6g}:{high:.6g}")]


def arguments(name, model, folder, rng):
    """The words of a command, without the program; nothing where the model has no such question."""
    out = str(folder / "out.h5")
    lengths = [c["name"] for c in model.coordinates("length")]
    if name == "solve":
        words = ["solve", *model.words, "-o", out]
        if model.facts().get("inputs"):
            words += ["--set", rng.choice(SETS)]
        kept = ["--checkpoint", str(folder / "kept")]
        extras = [[], [], ["--proof"], ["--digits", "30"], kept, ["--area"]]
        extra = rng.choice(extras)
        return words + (extra if extra != ["--area"] or "boundary" in words else [])
    if name == "solve-boundary":
        return ["solve", *model.words, "-o", out, "--set", "boundary"]
    if name == "report":
        return ["report", *model.words, "-o", str(folder / "page")]
    if name == "aspects":
        return ["aspects", *model.words, "-o", rng.choice([out, str(folder / "out.svg")])]
    if name == "cusps":
        return ["aspects", *model.words, "--cusps"]
    if name == "topology":
        return ["topology", *model.words, "-o", out]
    if name == "derive":
        form = rng.choice(["text", "latex", "cuik", "model"])
        return ["derive", *model.words, "--set", rng.choice(SETS), "--format", form]
    if name == "path":
        names = [c["name"] for c in rng.sample(model.coordinates(), min(model.mobility(), len(model.coordinates())))]
        if not names:
            return None
        ends = [w for end in ("--from", "--to") for w in (end, point(model, names, rng), end + "-mode", "1")]
        return ["path", *model.words, *ends, "-o", out, "--report", str(folder / "path.html")]
    if name == "clearance":
        names = [n for n in model.facts().get("outputs") or [] if n in lengths] or lengths[:3]
        if not names:
            return None
        proof = rng.choice([[], ["--proof", str(folder / "claim")]])
        return ["clearance", *model.words, "--at", point(model, names, rng), "--in", ",".join(names), *proof]
    if name in ("clearance-best", "clearance-map"):
        names = ([n for n in model.facts().get("outputs") or [] if n in lengths] + lengths)[:2]
        if len(names) < 2 or names[0] == names[1]:
            return None
        if name == "clearance-map":
            return ["clearance", *model.words, "--map", ",".join(names), "-o", str(folder / "map.svg")]
        return ["clearance", *model.words, "--best", ",".join(f"{n}=[0,1]" for n in names)]
    if name == "map":
        over = plane(model, rng)
        return ["map", *model.words, *over, "-o", rng.choice([out, str(folder / "map.svg")])] if over else None
    if name == "sweep":
        constants = [(n, number(v, None)) for n, v in model.facts().get("constants", {}).items()]
        constants = [(n, v) for n, v in constants if v]
        if not constants:
            return None
        n, v = rng.choice(constants)
        return ["sweep", *model.words, "-D", f"{n}={v}:{v * 1.1:.6g}:3", "-o", str(folder / "family")]
    if name == "verify-claims":
        made = model.result(rng.choice(["topology", "aspects"]), rng.choice(["topology", "aspects"]))
        return ["verify", made] if made else None
    sets = ["--set", rng.choice(["cspace", "forward", "inverse"])] if model.facts().get("inputs") else []
    made = model.result("-".join(["solve", *sets[1:]]), "solve", *sets, "--proof")
    if made is None:
        return None
    if name == "verify":
        return ["verify", made, *rng.choice([[], ["--require-proof"], ["--sample", "200"]])]
    if name == "report-results":
        return ["report", "--results", made, "-o", str(folder / "page")] if sets else None
    if name == "plot":
        picture = rng.choice(["p.svg", "p.pdf", "p.png", "p.gcl", "p.vtp"])
        return ["plot", made, "--axes", "1,2", "-o", str(folder / picture)]
    return ["angles", made, "1", "2", str(folder / "angles.sol")]


def moment_of(rng):
    return round(10 ** rng.uniform(-1.3, 1.0), 2)  # 0.05 to 10 s, small ones more often


def write_large_models(folder):
    """Files on which reading, deriving and setting up take longest: many variables, many joints, many limits."""
    for n in (2000, 100_000):
        variables = "".join(f"x{i} : [-1, 1]\n" for i in range(n))
        chain = "".join(f"x{i}^2 + x{i + 1}^2 = 1;\n" for i in range(n - 1))
        (folder / f"chain_{n}.cuik").write_text(f"[SYSTEM VARS]\n{variables}[SYSTEM EQS]\n{chain}")
    for n in (100, 400, 9_999):
        links = "".join(f'<link name="l{i}"/>' for i in range(n + 1))
        joints = "".join(
            f'<joint name="j{i}" type="revolute"><parent link="l{i}"/><child link="l{i + 1}"/>'
            f'<origin xyz="0.1 0 {0.1 * (i % 3):.1f}"/><axis xyz="{i % 3 == 0:d} {i % 3 == 1:d} {i % 3 == 2:d}"/>'
            f'<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>'
            for i in range(n)
        )
        (folder / f"arm_{n}.urdf").write_text(f'<?xml version="1.0"?><robot name="arm">{links}{joints}</robot>')


def failed_in(found):
    """What a check's JSON counts as failed; boxes that no check can confirm (partial ones) are none."""
    if isinstance(found, dict):
        return sum(v if k == "failed" else failed_in(v) for k, v in found.items() if k != "failures") + len(
            found.get("contradictions") or []
        )
    return sum(failed_in(v) for v in found) if isinstance(found, list) else 0


def faults_of_files(program, folder):
    faults = []
    for file in folder.rglob("*"):
        if file.suffix == ".part":
            faults.append(f"half-written {file.name}")
        if file.suffix != ".h5":
            continue
        check = subprocess.run(
            [program, "verify", str(file), "--json", "--time-limit", "10"], capture_output=True, text=True, timeout=200
        )
        if check.returncode in (0, 3, 4):
            continue
        try:
            failed = check.returncode != 1 or failed_in(json.loads(check.stdout))
        except ValueError:
            failed = True
        if failed:
            words = (check.stderr or check.stdout).strip()[-200:].replace("\n", " ")
            faults.append(f"verify {file.name}: exit status {check.returncode}: {words}")
    return faults


def run_case(program, name, words, way, moment, slack, folder):
    command = [program, *words]
    if way == "limit":
        command += ["--time-limit", str(moment)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    began = time.monotonic()
    with open(folder.parent / "stderr", "w+", encoding="utf-8") as said:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=said, cwd=folder)
        used_then = None
        ended = killed = False
        while not ended:
            if used_then is None and time.monotonic() - began >= moment:
                used_then = processor_time(process.pid)
                if way != "limit":
                    process.send_signal(way)
            if not killed and time.monotonic() - began > moment + 40 * slack:
                process.kill()
                killed = True
            ended = process.poll() is not None
            if not ended:
                time.sleep(0.01)
        said.seek(0)
        error = said.read()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    over = 0 if used_then is None else used - used_then
    faults = []
    if over > slack:
        faults.append(f"{over:.1f} s of processor time after the moment")
    statements = (0, 1, 2, 3, 4, 5) if name.startswith("verify") else (0, 1, 2, 3, 5)
    if process.returncode not in statements and (way == "limit" or process.returncode != -way):
        faults.append(f"exit status {process.returncode}")
    if "a bug in corank" in error:
        faults.append(error.strip().splitlines()[-1])
    if name in ("report", "sweep") and process.returncode in (0, 3):
        page = folder / ("page" if name == "report" else "family") / "index.html"
        if not page.exists():
            faults.append("no page")
    faults += faults_of_files(program, folder)
    return faults, command, process.returncode, used, over, used_then is not None


def page_of(program, model):
    """The report with the options' defaults: what is wrong with it, and how long it took."""
    with tempfile.TemporaryDirectory() as folder:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        began = time.monotonic()
        command = [program, "report", *model.words, "-o", folder]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=10 * SECONDS_OF_A_PAGE)
            status, error = done.returncode, done.stderr
        except subprocess.TimeoutExpired:
            status, error = -1, ""
        wall = time.monotonic() - began
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        faults = []
        if min(wall, used) > SECONDS_OF_A_PAGE:
            faults.append("longer than a minute")
        if status in (0, 3) and not (pathlib.Path(folder) / "index.html").exists():
            faults.append("no page")
        if status not in (0, 1, 2, 3) or "a bug in corank" in error:
            faults.append(f"exit status {status}: {error.strip()[-200:]}")
        return faults, command, status, wall, used


def check_pages(program, models):
    failed = 0
    longest = (0.0, 0.0, "")
    for model in models:
        faults, command, status, wall, used = page_of(program, model)
        longest = max(longest, (wall, used, model.file))
        if faults:
            failed += 1
            print(f"{' '.join(command)}: {'; '.join(faults)} (status {status}, {wall:.0f} s, used {used:.0f} s)", flush=True)
    print(f"{len(models)} pages, {failed} failed; the longest {longest[0]:.0f} s, used {longest[1]:.0f} s: {longest[2]}")
    return failed > 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("folders", nargs="+", type=pathlib.Path, metavar="FOLDER", help="of models, or a model")
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--each", type=int, default=0, help="every command on every model so many times; no --cases")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--slack", type=float, default=1.0)
    parser.add_argument("--command", action="append", choices=COMMANDS, help="only these commands")
    parser.add_argument("--only", default="", help="only models with this in their path")
    parser.add_argument("--large", action="store_true", help="models of thousands of variables and joints, too")
    parser.add_argument("--pages", action="store_true", help="the reports of all models, undisturbed")
    options = parser.parse_args()
    # Where this runs in the background a shell has it ignore SIGINT, and what it starts would, until it has a handler.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    temporary = tempfile.TemporaryDirectory()
    kept = pathlib.Path(temporary.name)
    (kept / "large").mkdir()
    folders = list(options.folders)
    if options.large:
        write_large_models(kept / "large")
        folders.append(kept / "large")
    files = [f for folder in folders for f in ([folder] if folder.is_file() else folder.rglob("*"))]
    files = sorted({str(f.resolve()) for f in files if f.suffix in (".cuik", ".urdf", ".world") and options.only in str(f)})
    models = [Model(options.program, file, kept) for file in files]
    if options.pages:
        return check_pages(options.program, models)
    commands = options.command or COMMANDS
    rng = random.Random(options.seed)
    pairs = [(name, model) for model in models for name in commands] * options.each
    if not pairs:
        pairs = [(rng.choice(commands), rng.choice(models)) for _ in range(options.cases)]
    failed = met = 0
    worst = 0.0
    for case, (name, model) in enumerate(pairs):
        rng = random.Random(f"{options.seed} {case} {name} {pathlib.Path(model.file).name}")
        moment = moment_of(rng)
        way = rng.choice(["limit", signal.SIGTERM, signal.SIGINT])
        if way == "limit" and name in ("report", "report-results", "sweep"):
            way = signal.SIGTERM  # its limit is of each search
        with tempfile.TemporaryDirectory() as own:
            folder = pathlib.Path(own) / "here"
            folder.mkdir()
            words = arguments(name, model, folder, rng)
            if words is None:
                continue
            faults, command, status, used, over, was_met = run_case(
                options.program, name, words, way, moment, options.slack, folder
            )
        met += was_met
        worst = max(worst, over)
        if faults:
            failed += 1
            how = "--time-limit" if way == "limit" else way.name
            print(
                f"{case}: {' '.join(command)}: {how} at {moment} s: {'; '.join(faults)} "
                f"(status {status}, used {used:.1f} s)",
                flush=True,
            )
    print(
        f"{len(pairs)} cases, {met} of them still at work at their moment, {failed} failed; "
        f"at most {worst:.2f} s of processor time after the moment"
    )
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
