"""Imports point one way: reference ← scenarios ← adapters ← reports ← poinsot."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LAYERS = ("reference", "scenarios", "adapters", "reports", "poinsot")
ENGINES = {"mujoco", "pybullet", "pybullet_data", "pinocchio"}
FILES = sorted(path for layer in LAYERS for path in (ROOT / layer).rglob("*.py"))


def imported(source, layer):
    """Absolute dotted names that a file imports, relative ones resolved as they are when installed."""
    package = ["poinsot"] if layer == "poinsot" else ["poinsot", layer]
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            stem = ".".join([*base, *(node.module.split(".") if node.module else [])])
            yield from (f"{stem}.{alias.name}" for alias in node.names)


def imports_of(path):
    return imported(path.read_text(encoding="utf-8"), path.relative_to(ROOT).parts[0])


def layer_of(name):
    parts = name.split(".")
    if parts[0] != "poinsot":
        return None
    return parts[1] if len(parts) > 1 and parts[1] in LAYERS[:-1] else "poinsot"


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_imports_point_one_way(path):
    own = LAYERS.index(path.relative_to(ROOT).parts[0])
    wrong = [name for name in imports_of(path) if (to := layer_of(name)) and LAYERS.index(to) > own]
    assert not wrong, f"{path.relative_to(ROOT)} may not import {wrong}"


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_an_engine_is_imported_in_its_own_file_alone(path):
    engines = {name.split(".")[0] for name in imports_of(path)} & ENGINES
    allowed = (
        {path.stem.removesuffix("_")} if path.parent.name == "adapters" and path.stem.endswith("_") else set()
    )
    assert engines <= allowed


def test_no_rooms_without_a_name():
    forbidden = {"utils", "util", "helpers", "common", "misc"}
    assert not [path for path in FILES if path.stem in forbidden]


@pytest.mark.parametrize("text", ["from ..adapters import runner", "from poinsot.adapters import runner"])
def test_an_arrow_the_wrong_way_is_seen(text):
    assert [layer_of(name) for name in imported(text, "reference")] == ["adapters"]
