"""Shared libraries beside the programs that need them: copied from this machine, found by paths relative to themselves."""

from __future__ import annotations

import hashlib
import os
import pathlib
import re
import shutil
from typing import Dict, Iterable, List, Set

from origins import output

# The C library, which every machine has; the release asks for this version of it at least.
GLIBC = (2, 36)
C_LIBRARY = {
    "ld-linux-x86-64.so.2", "libc.so.6", "libdl.so.2", "libm.so.6", "libmvec.so.1", "libpthread.so.0", "libresolv.so.2",
    "librt.so.1", "libutil.so.1",
}  # fmt: skip
# What Cairo draws letters with where a machine has no fonts.
FONT = pathlib.Path("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")
# The runtime of C++, of which an interpreter should have one: other modules of it use it, too.
CXX_RUNTIME = {"libstdc++.so.6", "libgcc_s.so.1"}


def needed(file: pathlib.Path) -> List[str]:
    """The names of the libraries that the file asks for itself."""
    return output("patchelf", "--print-needed", file).split()


def libraries(file: pathlib.Path, outside: Set[str]) -> Dict[str, pathlib.Path]:
    """The libraries that the file needs, directly or not, by the name under which they are asked for."""
    found = {}
    for line in output("ldd", file).splitlines():
        name, arrow, rest = line.strip().partition(" => ")
        if arrow and name not in outside:
            if rest.startswith("not found"):
                raise SystemExit(f"{file} needs {name}, which is not on this machine")
            found[name] = pathlib.Path(rest.split(" (")[0]).resolve()
    # What only a library outside asks for stays outside.
    wanted, open_ends = set(), [file]
    while open_ends:
        for name in needed(open_ends.pop()):
            if name in found and name not in wanted:
                wanted.add(name)
                open_ends.append(found[name])
    return {name: found[name] for name in sorted(wanted)}


def bundle(files: Iterable[pathlib.Path], folder: pathlib.Path, outside: Set[str], own_names: bool) -> List[pathlib.Path]:
    """Copies what the files need into the folder, and lets them and the copies find it there. With own_names a library is
    called by what is in it, so that a process that has another one of the same name gets both. Returns the originals."""
    files = list(files)
    originals: Dict[str, pathlib.Path] = {}
    for file in files:
        originals.update(libraries(file, outside))
    folder.mkdir(parents=True, exist_ok=True)
    names = {}
    for name, original in originals.items():
        digest = hashlib.sha256(original.read_bytes()).hexdigest()[:8]
        names[name] = re.sub(r"\.so\b", f"-{digest}.so", name, count=1) if own_names else name
        copy = folder / names[name]
        shutil.copyfile(original, copy)
        copy.chmod(0o644)
    for file in files + [folder / name for name in names.values()]:
        # One change at a time: patchelf 0.14 mixes up the strings of several.
        for name in needed(file):
            if names.get(name, name) != name:
                output("patchelf", "--replace-needed", name, names[name], file)
        if file.parent == folder and own_names:
            output("patchelf", "--set-soname", file.name, file)
        # RPATH, not RUNPATH: LD_LIBRARY_PATH of the user's must not bring other libraries in.
        relative = os.path.relpath(folder, file.parent)
        place = "$ORIGIN" if relative == "." else f"$ORIGIN/{relative}"
        output("patchelf", "--force-rpath", "--set-rpath", place, file)
    fonts = [_bundle_font(folder, folder / names["libcairo.so.2"])] if "libcairo.so.2" in names else []
    check(files + sorted(p for p in folder.iterdir() if p.is_file()), folder, outside)
    return sorted({*originals.values(), *fonts})


def _bundle_font(folder: pathlib.Path, cairo: pathlib.Path) -> pathlib.Path:
    """Puts a font there, which the copy of Cairo uses on machines that have none."""
    here = pathlib.Path(__file__).parent
    (folder / "fonts").mkdir()
    shutil.copyfile(FONT, folder / "fonts" / FONT.name)
    shutil.copyfile(here / "fonts.conf", folder / "fonts" / "fonts.conf")
    library = folder / "libcorank_fonts.so"
    output("gcc", "-O2", "-Wall", "-Wextra", "-s", "-shared", "-fPIC", f"-Wl,-soname,{library.name}", "-Wl,-rpath,$ORIGIN",
           here / "fonts.c", "-o", library)  # fmt: skip
    library.chmod(0o644)
    output("patchelf", "--add-needed", library.name, cairo)
    return FONT


def check(files: Iterable[pathlib.Path], folder: pathlib.Path, outside: Set[str]) -> None:
    """Every library that is asked for is in the folder or outside, and no newer C library is asked for."""
    for file in files:
        if not output("patchelf", "--print-rpath", file).startswith("$ORIGIN"):
            raise SystemExit(f"{file} does not look for libraries beside itself")
        for name in needed(file):
            if name not in outside and not (folder / name).exists():
                raise SystemExit(f"{file} asks for {name}, which is not bundled")
        for version in re.findall(r"\bGLIBC_(\d+)\.(\d+)", output("readelf", "--version-info", "--wide", file)):
            if tuple(map(int, version)) > GLIBC:
                raise SystemExit(f"{file} asks for glibc {'.'.join(version)}: build the release on Debian 12")
