"""What cmake --install puts somewhere works there: the package, the words that bash completes, the manual pages."""

import gzip
import os
import pathlib
import shutil
import subprocess
import sys

import pytest

BUILD = pathlib.Path(os.environ["CORANK_BUILD_DIR"])


def output(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_installed_package_works_by_itself(tmp_path, models):
    output("cmake", "--install", str(BUILD), "--component", "python", "--prefix", str(tmp_path))
    place = tmp_path / "lib" / "python3" / "dist-packages"
    program = (
        "import corank; print(corank.__file__); "
        f"print(len(corank.load({str(models / 'three_slider.cuik')!r}).solve('forward').points))"
    )
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    said = output(sys.executable, "-c", program, env={**environment, "PYTHONPATH": str(place)}, cwd=tmp_path)
    assert said.split() == [str(place / "corank" / "__init__.py"), "8"]
    assert (place / "corank" / "py.typed").exists() and (place / "corank" / "_corank.pyi").exists()


@pytest.fixture(scope="module")
def manual():
    folder = BUILD / "app" / "manual"
    if not folder.exists():
        pytest.skip("there was no help2man when the build was configured")
    return folder


def completed(manual, *words):
    bash = shutil.which("bash")
    quoted = " ".join(f"'{w}'" for w in words)
    script = (
        f"source {manual / 'corank.bash'}; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; "
        '_corank; printf "%s\\n" "${COMPREPLY[@]}"'
    )
    return output(bash, "-c", script).split()


def test_bash_completes_subcommands_options_and_sets(manual, tmp_path):
    assert completed(manual, "corank", "so") == ["solve"]
    assert completed(manual, "corank", "solve", "--sigma-") == ["--sigma-length", "--sigma-angle"]
    assert completed(manual, "corank", "solve", "--set", "forward-c") == ["forward-cusps"]
    assert completed(manual, "corank", "derive", "--format", "l") == ["latex"]
    (tmp_path / "model.cuik").touch()
    assert completed(manual, "corank", "solve", str(tmp_path / "mo")) == [str(tmp_path / "model.cuik")]


def test_every_subcommand_has_its_manual_page(manual):
    listed = output(str(BUILD / "app" / "corank"), "--help").split("Subcommands:")[1].split("\n\n")[0]
    names = [line.split()[0] for line in listed.splitlines() if line.startswith("  ") and line[2] != " "]
    assert "solve" in names and len(names) >= 9
    for name in names:
        page = gzip.decompress((manual / f"corank-{name}.1.gz").read_bytes()).decode()
        assert f".TH CORANK-{name.upper()} " in page and f"corank-{name} \\- " in page
        assert ".SH OPTIONS" in page
