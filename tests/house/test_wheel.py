"""What ships is what the tree holds, under poinsot and nowhere else."""

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = {
    "poinsot": "",
    "reference": "reference",
    "scenarios": "scenarios",
    "adapters": "adapters",
    "reports": "reports",
}
SUFFIXES = {".py", ".typed", ".toml", ".md", ".j2", ".css", ".js"}


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """A wheel built from a copy of the tree, so that nothing left by an earlier build can slip in."""
    folder = tmp_path_factory.mktemp("wheel")
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT, check=True, capture_output=True, text=True,
    ).stdout.splitlines()  # fmt: skip
    for name in listed:
        if (ROOT / name).is_file():
            (folder / "tree" / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / "tree" / name).write_bytes((ROOT / name).read_bytes())
    command = [
        sys.executable,
        "-m",
        "pip",
        "wheel",
        "--quiet",
        "--no-deps",
        "-w",
        str(folder),
        str(folder / "tree"),
    ]
    subprocess.run(command, check=True, capture_output=True)
    return zipfile.ZipFile(next(folder.glob("*.whl")))


def shipped(wheel):
    return {name for name in wheel.namelist() if ".dist-info/" not in name}


def test_the_wheel_holds_the_tree(wheel):
    expected = set()
    for folder, inside in FOLDERS.items():
        for path in (ROOT / folder).rglob("*"):
            published = "published" in path.parts
            if path.is_file() and path.suffix in SUFFIXES and not published:
                expected.add(
                    "/".join(
                        part for part in ("poinsot", inside, str(path.relative_to(ROOT / folder))) if part
                    )
                )
    assert shipped(wheel) == expected


def test_nothing_lands_beside_the_package(wheel):
    assert {name.split("/")[0] for name in shipped(wheel)} == {"poinsot"}


def test_the_wheel_is_typed_and_licensed(wheel):
    assert "poinsot/py.typed" in shipped(wheel)
    metadata = wheel.read(next(name for name in wheel.namelist() if name.endswith("METADATA"))).decode()
    assert "License-Expression: Apache-2.0" in metadata
    assert any(name.endswith("licenses/LICENSE") for name in wheel.namelist())
