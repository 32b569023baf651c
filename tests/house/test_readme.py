"""What the README says to type is what continuous integration types."""

import re
from pathlib import Path

import pytest

import poinsot

ROOT = Path(__file__).resolve().parents[2]


def commands():
    """The shell blocks of the README's first section."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return [block.strip() for block in re.findall(r"```sh\n(.*?)```", text, re.DOTALL)][:2]


def test_the_two_commands_are_run_word_for_word():
    script = (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
    install, check = commands()
    assert "poinsot run" in install
    assert "pytest" in check
    assert install in script
    assert check in script


def test_the_example_runs():
    pytest.importorskip("mujoco")
    pytest.importorskip("pinocchio")
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    module = {}
    exec(example, module)
    assert module["q"].shape == (3, 4)
    assert {"truth", "invariant", "setup", "determinism"} <= {
        v.check for v in module["poinsot"].judge(module["runs"])
    }


def test_every_scene_is_named():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(\w+)` \| (.*?) ?\|$", text, re.MULTILINE)
    variants: dict[str, set[str]] = {}
    for scene in poinsot.scenes().values():
        variants.setdefault(scene.name, set()).add(scene.variant)
    assert {name: set(told.split(", ")) for name, told in rows} == variants
    assert len(rows) == len(variants)
