"""Which Debian packages the files of a release come from, and under which licences these are."""

from __future__ import annotations

import pathlib
import re
import shutil
import subprocess
from typing import Dict, Iterable, List, NamedTuple, Set


class Package(NamedTuple):
    """A package as dpkg knows it, with the source package that it was built from."""

    name: str
    version: str
    architecture: str
    source: str
    source_version: str

    @property
    def copyright(self) -> pathlib.Path:
        return pathlib.Path("/usr/share/doc", self.name, "copyright")

    @property
    def source_page(self) -> str:
        """Where Debian keeps the source code of this very version."""
        return f"https://snapshot.debian.org/package/{self.source}/{self.source_version}/"


def output(*command: object, **options: object) -> str:
    """What the command prints; an error of its own ends the program with what it said."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: {done.stderr or done.stdout}")
    return done.stdout


def git(root: pathlib.Path, *words: str) -> str:
    """What git says of the clone, which in a container belongs to another user."""
    return output("git", "-c", "safe.directory=*", "-C", root, *words).strip()


def _owners(paths: Iterable[pathlib.Path]) -> Dict[str, str]:
    """The package of each file that belongs to one. /lib and /usr/lib are one folder, of which dpkg knows either name."""
    names = [n for p in paths for n in (str(p), re.sub(r"^/usr/(s?bin|lib)", r"/\1", str(p)))]
    if not names:
        return {}
    # It ends with status 1 where a name is not known.
    done = subprocess.run(["dpkg-query", "--search", *names], capture_output=True, text=True, check=False)
    owners = {}
    for line in done.stdout.splitlines():
        packages, _, name = line.partition(": ")
        if not line.startswith("diversion by"):
            owners[re.sub(r"^/(s?bin|lib)", r"/usr/\1", name)] = packages.split(",")[0].strip()
    return owners


def packages_of(files: Iterable[pathlib.Path]) -> Dict[pathlib.Path, Package]:
    """The package of each of these files; a file of no package is an error."""
    files = list(files)
    owners = _owners(files)
    strangers = [str(f) for f in files if str(f) not in owners]
    if strangers:
        raise SystemExit(f"these files come from no Debian package: {', '.join(strangers)}")
    fields = "${Package}\t${Version}\t${Architecture}\t${source:Package}\t${source:Version}\n"
    known = {}
    for owner in sorted(set(owners.values())):
        known[owner] = Package(*output("dpkg-query", "--show", f"--showformat={fields}", owner).rstrip("\n").split("\t"))
    return {f: known[owners[str(f)]] for f in files}


def compiled_in(build: pathlib.Path) -> List[Package]:
    """The packages whose headers the sources of its programs include: parts of them are in these. Without the tests', and without
    those of the C and C++ libraries, whose licences ask for nothing there."""
    headers: Set[pathlib.Path] = set()
    shipped = False
    for line in output("ninja", "-C", build, "-t", "deps").splitlines():
        if line and not line.startswith(" "):
            shipped = not line.startswith(("tests/", "bench/"))
        elif shipped and line.startswith("    /usr/include/") and not line.startswith("    /usr/include/c++/"):
            headers.add(pathlib.Path(line.strip()).resolve())
    owners = set(_owners(sorted(h for h in headers if h.exists())).values())
    left = {o for o in owners if not re.match(r"(libc6-dev|linux-libc-dev|libstdc\+\+-.*|libgcc-.*)(:|$)", o)}
    fields = "${Package}\t${Version}\t${Architecture}\t${source:Package}\t${source:Version}\n"
    lines = [output("dpkg-query", "--show", f"--showformat={fields}", o).rstrip("\n") for o in sorted(left)]
    return [Package(*line.split("\t")) for line in lines]


def licence_names(package: Package) -> List[str]:
    """What the package's copyright file calls its licences; empty where it is not written to be read by a machine."""
    text = package.copyright.read_text(errors="replace")
    if not text.startswith("Format:"):
        return []
    return sorted({name.strip() for name in re.findall(r"^License: *(\S.*)$", text, re.MULTILINE)})


_README = """What is in this folder
======================
corank is free software under the GNU General Public License, version 3 or later. This release brings along libraries of Debian
{debian}, unchanged except for their names and for the paths by which they find each other, and its programs contain
parts of header files of others. Each has a folder here with its copyright file, in which its licences are; the texts that these files
refer to by /usr/share/common-licenses are in the folder common-licenses.

Debian keeps the source code of each of these packages, of the very version, at the address in the last column.

{table}
"""


def write_licences(folder: pathlib.Path, bundled: Iterable[Package], compiled: Iterable[Package]) -> None:
    """The copyright files of the packages, the common licences that they refer to, and a list of it all."""
    kinds = {p: "header files" for p in compiled}
    kinds.update({p: "library" for p in bundled})
    rows, common = [], set()
    for package in sorted(kinds):
        place = folder / package.name
        place.mkdir(parents=True, exist_ok=True)
        text = package.copyright.read_bytes()
        (place / "copyright").write_bytes(text)
        common |= set(re.findall(rb"/usr/share/common-licenses/([A-Za-z0-9.-]*[A-Za-z0-9])", text))
        rows.append(f"{package.name:28} {package.version:24} {kinds[package]:13} {package.source_page}")
    (folder / "common-licenses").mkdir(exist_ok=True)
    for name in sorted(common | {b"GPL-3"}):
        original = pathlib.Path("/usr/share/common-licenses", name.decode())
        if original.exists():
            shutil.copyfile(original, folder / "common-licenses" / name.decode())
    debian = pathlib.Path("/etc/debian_version").read_text().strip()
    (folder / "README").write_text(_README.format(debian=debian, table="\n".join(rows)))
