"""Writes a bill of materials of a release: SPDX 2.3 as JSON, with what is in each artefact.

    sbom.py BUILD RELEASE      RELEASE: the folder of the artefacts; their *.bundled.json are read, and removed
"""

from __future__ import annotations

import hashlib
import json
import pathlib
import re
import sys
import time
from typing import Any, Dict, List
from urllib.parse import quote

from artefacts import ROOT, Release
from origins import Package, git, licence_names

UNKNOWN = "NOASSERTION"


def identifier(*words: str) -> str:
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", "-".join(words))


def debian_package(package: Package) -> Dict[str, Any]:
    names = licence_names(package)
    comment = "Its copyright file, which goes along, has its licences"
    return {
        "name": package.name,
        "SPDXID": identifier("Debian", package.name, package.version),
        "versionInfo": package.version,
        "supplier": "Organization: Debian",
        "downloadLocation": package.source_page,
        "filesAnalyzed": False,
        "sourceInfo": f"built from Debian's source package {package.source} {package.source_version}",
        "licenseConcluded": UNKNOWN,
        "licenseDeclared": UNKNOWN,
        "licenseComments": f"{comment}: {', '.join(names)}" if names else comment,
        "copyrightText": UNKNOWN,
        "externalRefs": [
            {
                "referenceCategory": "PACKAGE-MANAGER",
                "referenceType": "purl",
                "referenceLocator": f"pkg:deb/debian/{quote(package.name)}@{quote(package.version)}?arch={package.architecture}",
            }
        ],
    }


def three() -> Dict[str, Any]:
    """three.js, parts of which are in every page that a report writes."""
    version = re.search(r"\) ([0-9.]+) that", (ROOT / "third_party" / "three" / "README.md").read_text())[1]
    return {
        "name": "three",
        "SPDXID": identifier("three"),
        "versionInfo": version,
        "downloadLocation": "https://threejs.org",
        "filesAnalyzed": False,
        "licenseConcluded": "MIT",
        "licenseDeclared": "MIT",
        "copyrightText": "Copyright 2010-2026 three.js authors",
    }


def artefact(file: pathlib.Path, version: str, commit: str) -> Dict[str, Any]:
    return {
        "name": file.name,
        "SPDXID": identifier("Artefact", file.name),
        "versionInfo": version,
        "packageFileName": file.name,
        "downloadLocation": UNKNOWN,
        "filesAnalyzed": False,
        "checksums": [{"algorithm": "SHA256", "checksumValue": hashlib.sha256(file.read_bytes()).hexdigest()}],
        "sourceInfo": f"built from commit {commit} of corank",
        "licenseConcluded": UNKNOWN,
        "licenseDeclared": "GPL-3.0-or-later",
        "copyrightText": "2026 The corank developers",
    }


def bill(release: Release) -> Dict[str, Any]:
    commit = git(ROOT, "describe", "--always", "--dirty", "--abbrev=40")
    packages: List[Dict[str, Any]] = []
    relations: List[Dict[str, str]] = []
    known: Dict[str, Dict[str, Any]] = {}

    def relate(one: str, kind: str, other: str) -> None:
        relations.append({"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other})

    def add(one: str, kind: str, package: Dict[str, Any]) -> None:
        known[package["SPDXID"]] = package
        relate(one, kind, package["SPDXID"])

    files = [f for ending in ("*.deb", "*.tar.gz", "*.whl") for f in sorted(release.folder.glob(ending))]
    for file in files:
        entry = artefact(file, release.version, commit)
        packages.append(entry)
        relate("SPDXRef-DOCUMENT", "DESCRIBES", entry["SPDXID"])
        add(entry["SPDXID"], "CONTAINS", three())
        listed = file.with_name(file.name + ".bundled.json")
        contents = json.loads(listed.read_text()) if listed.exists() else {}
        for package in contents.get("bundled", []):
            add(entry["SPDXID"], "CONTAINS", debian_package(Package(**package)))
        # Debian's packages bring along nothing: what they depend on is in their own lists.
        compiled = [Package(**p) for p in contents["compiled"]] if contents else release.compiled
        for package in compiled:
            add(entry["SPDXID"], "STATIC_LINK", debian_package(package))
    digest = hashlib.sha256("".join(p["checksums"][0]["checksumValue"] for p in packages).encode()).hexdigest()
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"corank-{release.version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/corank-{release.version}-{digest[:32]}",
        "comment": "CONTAINS: a library that goes along. STATIC_LINK: parts of header files are compiled in.",
        "creationInfo": {
            "created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(release.seconds)),
            "creators": ["Organization: The corank developers", "Tool: corank-scripts-release-sbom"],
        },
        "packages": packages + [known[name] for name in sorted(known)],
        "relationships": relations,
    }


def main() -> None:
    release = Release(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
    text = json.dumps(bill(release), indent=1) + "\n"
    (release.folder / f"corank-{release.version}.spdx.json").write_text(text)
    for listed in release.folder.glob("*.bundled.json"):
        listed.unlink()


if __name__ == "__main__":
    main()
