"""Makes the tarball, the Debian package with everything in it, and the wheel, from a build that exists.

    artefacts.py BUILD OUTPUT      BUILD: the folder of a release build; OUTPUT: where the artefacts go

Beside each artefact stands NAME.bundled.json, from which sbom.py knows what is in it.
"""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import os
import pathlib
import re
import shutil
import sys
import tarfile
import tempfile
import zipfile
from typing import Iterable, List

import bundling
from origins import Package, compiled_in, git, output, packages_of, write_licences

ROOT = pathlib.Path(__file__).resolve().parents[2]
PLATFORM = "manylinux_{}_{}_x86_64".format(*bundling.GLIBC)
SUMMARY = "All singularities of a robot mechanism, each with a proof"
# What the package's functions hand their answers to.
EXTRAS = {
    "arrays": ["numpy>=1.22,<2"],
    "tables": ["numpy>=1.22,<2", "pandas"],
    "exact": ["sympy"],
    "plots": ["numpy>=1.22,<2", "matplotlib"],
    "cluster": ["numpy>=1.22,<2", "distributed"],
}


class Release:
    """A build, and where its artefacts go."""

    def __init__(self, build: pathlib.Path, folder: pathlib.Path) -> None:
        self.build = build
        self.folder = folder
        cache = (build / "CMakeCache.txt").read_text()
        if "CMAKE_BUILD_TYPE:STRING=Release\n" not in cache:
            raise SystemExit(f"{build} is no release build")
        self.version = re.search(r"^CMAKE_PROJECT_VERSION:STATIC=(.*)$", cache, re.MULTILINE)[1]
        self.seconds = int(git(ROOT, "log", "-1", "--format=%ct"))  # since 1970: of all files
        self.compiled = compiled_in(build)

    def install(self, component: str, prefix: pathlib.Path) -> None:
        """What `cmake --install` puts there for the component, stripped."""
        output("cmake", "--install", self.build, "--component", component, "--prefix", prefix, "--strip")

    def describe(self, artefact: pathlib.Path, bundled: Iterable[Package], compiled: Iterable[Package]) -> None:
        """Writes which packages are in the artefact."""
        contents = {
            "version": self.version,
            "bundled": [p._asdict() for p in sorted(set(bundled))],
            "compiled": [p._asdict() for p in sorted(set(compiled))],
        }
        artefact.with_name(artefact.name + ".bundled.json").write_text(json.dumps(contents, indent=1) + "\n")
        print(f"{artefact.name}: {artefact.stat().st_size / 1e6:.1f} MB, with {len(set(bundled))} packages of Debian's")


def _without(packages: Iterable[Package], others: Iterable[Package]) -> List[Package]:
    sources = {p.source for p in others}
    return [p for p in packages if p.source not in sources]


def _tree(release: Release, tree: pathlib.Path) -> List[Package]:
    """Fills the folder with the programs, the models, the manual, the libraries and the licences; returns whose libraries."""
    release.install("program", tree)
    originals = bundling.bundle(
        sorted((tree / "bin").iterdir()), tree / "lib" / "corank", bundling.C_LIBRARY, own_names=False
    )
    documents = tree / "share" / "doc" / "corank"
    documents.mkdir(parents=True, exist_ok=True)
    for name in ("LICENSE", "CHANGELOG.md", "CITATION.cff", "cmake/copyright"):
        shutil.copy(ROOT / name, documents)
    bundled = list(packages_of(originals).values())
    compiled = [p for p in release.compiled if p.name != "pybind11-dev"]
    write_licences(documents / "licences", bundled, _without(compiled, bundled))
    return bundled


def _pack(release: Release, tree: pathlib.Path, archive: pathlib.Path) -> None:
    """The folder as .tar.gz, the same for the same contents."""

    def settle(info: tarfile.TarInfo) -> tarfile.TarInfo:
        info.uid = info.gid = 0
        info.uname = info.gname = "root"
        info.mtime = release.seconds
        info.mode = 0o755 if info.isdir() or info.mode & 0o100 else 0o644
        return info

    with open(archive, "wb") as file, gzip.GzipFile("", "wb", 6, file, mtime=release.seconds) as packed:
        with tarfile.open(fileobj=packed, mode="w", format=tarfile.GNU_FORMAT) as tar:
            tar.add(tree, tree.name, recursive=False, filter=settle)
            for path in sorted(tree.rglob("*")):
                tar.add(path, path.relative_to(tree.parent), recursive=False, filter=settle)


_CONTROL = """Package: corank-bundled
Version: {version}-1
Architecture: amd64
Section: science
Priority: optional
Maintainer: {maintainer}
Installed-Size: {size}
Depends: libc6 (>= {glibc})
Conflicts: corank
Provides: corank (= {version}-1)
Description: singularities of robot mechanisms, each with a proof
 corank takes the model of a robot mechanism, as equations, as links and
 joints or as URDF, and returns all its singularities in boxes, with a proof
 of what each box holds. This package brings along all libraries that the
 command line needs, for systems that have other versions of them than
 Debian 12.
"""


def make_tarball_and_package(release: Release, work: pathlib.Path) -> None:
    """corank-VERSION-linux-x86_64.tar.gz, and the same tree as a .deb for any Debian from 12 on."""
    tree = work / f"corank-{release.version}"
    bundled = _tree(release, tree)
    compiled = _without([p for p in release.compiled if p.name != "pybind11-dev"], bundled)
    tarball = release.folder / f"corank-{release.version}-linux-x86_64.tar.gz"
    _pack(release, tree, tarball)
    release.describe(tarball, bundled, compiled)

    root = work / "package"
    home = root / "usr" / "lib" / "corank"
    shutil.copytree(tree, home, symlinks=True)
    (root / "usr" / "bin").mkdir(parents=True)
    for program in sorted((home / "bin").iterdir()):
        (root / "usr" / "bin" / program.name).symlink_to(f"../lib/corank/bin/{program.name}")
    (home / "share").rename(root / "usr" / "share")
    (root / "usr" / "share" / "doc" / "corank").rename(root / "usr" / "share" / "doc" / "corank-bundled")
    size = sum(p.stat().st_size for p in root.rglob("*") if p.is_file() and not p.is_symlink()) // 1024
    maintainer = re.search(r"^CORANK_MAINTAINER:.*=(.*)$", (release.build / "CMakeCache.txt").read_text(), re.MULTILINE)[1]
    (root / "DEBIAN").mkdir()
    glibc = ".".join(map(str, bundling.GLIBC))
    (root / "DEBIAN" / "control").write_text(
        _CONTROL.format(version=release.version, maintainer=maintainer, size=size, glibc=glibc)
    )
    for path in root.rglob("*"):
        if not path.is_symlink():
            path.chmod(0o755 if path.is_dir() or path.stat().st_mode & 0o100 else 0o644)
    package = release.folder / f"corank-bundled_{release.version}-1_amd64.deb"
    environment = {**os.environ, "SOURCE_DATE_EPOCH": str(release.seconds)}
    output("dpkg-deb", "--root-owner-group", "-z3", "--build", root, package, env=environment)
    release.describe(package, bundled, compiled)


def _metadata(release: Release) -> str:
    lines = [
        "Metadata-Version: 2.1",
        "Name: corank",
        f"Version: {release.version}",
        f"Summary: {SUMMARY}",
        "License: GPL-3.0-or-later",
        "Classifier: License :: OSI Approved :: GNU General Public License v3 or later (GPLv3+)",
        "Classifier: Operating System :: POSIX :: Linux",
        "Classifier: Programming Language :: C++",
        "Classifier: Programming Language :: Python :: 3.11",
        "Requires-Python: >=3.11,<3.12",
    ]
    for extra, requirements in EXTRAS.items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {r} ; extra == "{extra}"' for r in requirements]
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", _DESCRIPTION])


_DESCRIPTION = """corank takes the model of a robot mechanism and returns all its singularities, each with a proof.

Searches, checks and reports need no other package. Arrays need NumPy (`corank[arrays]`), data frames pandas (`corank[tables]`), exact
numbers SymPy (`corank[exact]`), plots matplotlib (`corank[plots]`), searches on many machines distributed (`corank[cluster]`);
what needs one of them says so.
"""


def make_wheel(release: Release, work: pathlib.Path) -> None:
    """corank-VERSION-cp311-cp311-manylinux_2_36_x86_64.whl: the package, and its libraries in corank.libs beside it."""
    release.install("python", work / "python")
    tree = work / "wheel"
    shutil.copytree(work / "python" / "lib" / "python3" / "dist-packages", tree)
    modules = sorted((tree / "corank").glob("*.so"))
    if [m.name.split(".")[1][:11] for m in modules] != ["cpython-311"]:
        raise SystemExit(f"{release.build} has no Python package for CPython 3.11")
    outside = bundling.C_LIBRARY | bundling.CXX_RUNTIME
    originals = bundling.bundle(modules, tree / "corank.libs", outside, own_names=True)
    bundled = list(packages_of(originals).values())
    compiled = _without(release.compiled, bundled)

    name = f"corank-{release.version}"
    tag = f"cp311-cp311-{PLATFORM}"
    information = tree / f"{name}.dist-info"
    information.mkdir()
    (information / "METADATA").write_text(_metadata(release))
    (information / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: corank\nRoot-Is-Purelib: false\nTag: {tag}\n")
    shutil.copy(ROOT / "LICENSE", information)
    shutil.copy(ROOT / "cmake" / "copyright", information)
    write_licences(information / "licences", bundled, compiled)

    files = [p for p in sorted(tree.rglob("*")) if p.is_file() and "__pycache__" not in p.parts]
    record = []
    for file in files:
        digest = base64.urlsafe_b64encode(hashlib.sha256(file.read_bytes()).digest()).rstrip(b"=").decode()
        record.append(f"{file.relative_to(tree)},sha256={digest},{file.stat().st_size}")
    (information / "RECORD").write_text("\n".join([*record, f"{information.name}/RECORD,,"]) + "\n")

    wheel = release.folder / f"{name}-{tag}.whl"
    stamp = tuple(int(n) for n in output("date", "--utc", f"--date=@{release.seconds}", "+%Y %m %d %H %M %S").split())
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:
        for file in [*files, information / "RECORD"]:
            entry = zipfile.ZipInfo(str(file.relative_to(tree)), stamp)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if file.suffix == ".so" or ".so." in file.name else 0o100644) << 16
            archive.writestr(entry, file.read_bytes())
    release.describe(wheel, bundled, compiled)


def main() -> None:
    release = Release(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
    with tempfile.TemporaryDirectory() as work:
        make_wheel(release, pathlib.Path(work))
        make_tarball_and_package(release, pathlib.Path(work))


if __name__ == "__main__":
    main()
