"""Engines by name, file, module and entry point; what is missing and what is no engine are told apart."""

import importlib
import re
import sys
from importlib.metadata import EntryPoint

import pytest
from poinsot.adapters import registry
from poinsot.adapters.engine import Scheme
from poinsot.reference.errors import InputError, UnavailableError

from poinsot import adapters

ENGINE = """
from poinsot.adapters.engine import Scheme

class Mine:
    name = "mine"
    schemes = (Scheme("only", 1, "", {}),)
    features = frozenset()
    settings = {}
    version = build = step = state = readback = acceleration = model_text = close = lambda *arguments: None

class Half:
    name = "half"
    schemes = ()
"""


@pytest.fixture
def own(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(ENGINE)
    return path


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder that counts as one of adapters/, for engine files of one's own."""
    monkeypatch.setattr(adapters, "__path__", [*adapters.__path__, str(tmp_path)])
    before = set(sys.modules)
    yield tmp_path
    for name in set(sys.modules) - before:
        if name.startswith("poinsot.adapters."):
            del sys.modules[name]


def test_the_three_are_found_by_their_files():
    assert {"mujoco", "pinocchio", "pybullet"} <= set(registry.names())


@pytest.mark.parametrize("name", ["mujoco", "pinocchio", "pybullet"])
def test_a_name_loads_the_engine_of_that_name(name):
    pytest.importorskip(name)
    engine = registry.load(name)
    assert engine.name == name
    assert registry.engines()[name] is engine


def test_a_new_file_is_a_new_engine(folder):
    (folder / "mine_.py").write_text(ENGINE.partition("class Half")[0])
    assert "mine" in registry.names()
    assert registry.load("mine").name == "mine"


def test_an_engine_whose_package_is_missing_is_unavailable_and_says_how_to_get_it(folder):
    (folder / "absent_engine_.py").write_text("import absent_engine\n")
    with pytest.raises(UnavailableError, match=re.escape("pip install 'poinsot[absent_engine]'")):
        registry.load("absent_engine")
    assert registry.engines()["absent_engine"].startswith("absent_engine is not installed")


@pytest.mark.parametrize(
    "line", ["import another_absent_package", "from poinsot.reference import no_such_module"]
)
def test_any_other_failed_import_is_a_fault(folder, line):
    (folder / "broken_.py").write_text(f"{line}\n")
    with pytest.raises(ImportError):
        registry.load("broken")


@pytest.mark.parametrize(("text", "count"), [("x = 1\n", 0), (ENGINE, 2)])
def test_a_file_holds_one_engine(folder, text, count):
    (folder / "odd_.py").write_text(text)
    with pytest.raises(InputError, match=f"got {count} classes with schemes, expected one engine a file"):
        registry.load("odd")


def test_ones_own_by_file(own):
    assert registry.load(f"{own}:Mine").name == "mine"


def test_ones_own_by_module(own, monkeypatch):
    monkeypatch.syspath_prepend(own.parent)
    assert registry.load("mine:Mine").name == "mine"
    sys.modules.pop("mine")


def test_ones_own_by_entry_point(own, monkeypatch, request):
    monkeypatch.syspath_prepend(own.parent)
    point = EntryPoint("registered", "mine:Mine", registry.ENTRY_POINTS)
    monkeypatch.setattr(importlib.metadata, "entry_points", lambda group: [point])
    registry._points.cache_clear()
    request.addfinalizer(registry._points.cache_clear)
    assert "registered" in registry.names()
    assert registry.load("registered").name == "mine"
    assert registry.engines()["registered"].name == "mine"
    sys.modules.pop("mine")


@pytest.mark.parametrize(
    ("spec", "says"),
    [
        ("mujocco", "did you mean 'mujoco'?"),
        ("drake", "path/to/file.py:Class"),
        ("{own}:Half", "Half lacks features"),
        ("{own}:Scheme", "which is no engine: Scheme lacks"),
        ("{own}:Mime", "has no 'Mime'; did you mean 'Mine'?"),
        ("{own}.gone.py:Mine", "expected an existing Python file before the colon"),
        ("no_such_package.engine:Mine", "got module 'no_such_package.engine', which cannot be found"),
        ("json:dumps", "which is no engine"),
    ],
)
def test_what_is_no_engine_is_refused_with_what_was_meant(own, spec, says):
    with pytest.raises(InputError, match=re.escape(says)) as caught:
        registry.load(spec.format(own=own))
    assert str(caught.value).startswith("engine: got ")


def test_a_fault_inside_ones_own_module_is_not_taken_for_a_missing_one(tmp_path, monkeypatch):
    (tmp_path / "faulty.py").write_text("import absent_dependency\n")
    monkeypatch.syspath_prepend(tmp_path)
    says = r"^engine: faulty: ModuleNotFoundError: No module named 'absent_dependency'$"
    with pytest.raises(InputError, match=says):
        registry.load("faulty:Mine")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("\nraise RuntimeError('no licence')", "line 2: RuntimeError: no licence"),
        ("import absent_dependency", "line 1: ModuleNotFoundError: No module named 'absent_dependency'"),
        ("class Mine", "SyntaxError: "),
    ],
)
def test_a_fault_in_ones_own_file_is_told_in_one_line_with_its_place(tmp_path, text, says):
    path = tmp_path / "faulty.py"
    path.write_text(text)
    with pytest.raises(InputError, match=re.escape(says)) as caught:
        registry.load(f"{path}:Mine")
    assert str(caught.value).startswith(f"engine: {path}")
    assert "\n" not in str(caught.value)


def test_ones_own_file_finds_its_neighbours(own, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "path", [*sys.path])
    beside = own.with_name("beside.py")
    beside.write_text("from mine import Mine")
    assert registry.load(f"{beside}:Mine").name == "mine"
    sys.modules.pop("mine")


class Two:
    name = "two"
    schemes = (Scheme("Euler", 1, "", {}), Scheme("RK4", 4, "", {}))


def test_a_scheme_by_name_and_the_first_without_one():
    assert registry.scheme_of(Two, "RK4").order == 4
    assert registry.scheme_of(Two, None).name == "Euler"


def test_an_unknown_scheme_is_answered_with_those_there_are():
    with pytest.raises(InputError, match=re.escape("scheme of two: got 'RK5'; did you mean 'RK4'?")):
        registry.scheme_of(Two, "RK5")
