"""What is read of an engine without importing it is what its class says."""

import subprocess
import sys
from importlib.util import find_spec

import pytest
from poinsot.adapters import declared, registry
from poinsot.reference.errors import PoinsotError

NAMES = [declaration.name for declaration in declared.declared()]


def test_every_engine_file_is_read():
    assert {"mujoco", "pinocchio", "pybullet"} <= set(NAMES)
    assert sorted(NAMES) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_what_is_read_is_what_the_class_says(name):
    pytest.importorskip(name)
    engine = registry.load(name)
    if name == "mujoco" and int(engine.version().split(".")[0]) < 4:
        pytest.skip("before release 4 the class mends its schemes when it is imported")
    (read,) = (declaration for declaration in declared.declared() if declaration.name == name)
    assert (read.name, read.features) == (engine.name, engine.features)
    assert read.schemes == engine.schemes
    assert [dict(scheme.lacks) for scheme in read.schemes] == [
        dict(scheme.lacks) for scheme in engine.schemes
    ]


@pytest.mark.parametrize("name", NAMES)
def test_installed_is_whether_the_package_is_there(name):
    (read,) = (declaration for declaration in declared.declared() if declaration.name == name)
    assert read.installed is (find_spec(name) is not None)


def test_reading_imports_no_engine():
    code = (
        "import sys; from poinsot.adapters.declared import declared; declared(); "
        "print({'mujoco', 'pybullet', 'pinocchio'} & set(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


def test_a_file_without_an_engine_is_named(tmp_path):
    path = tmp_path / "empty_.py"
    path.write_text("class Empty:\n    name: str = 'empty'\n")
    with pytest.raises(PoinsotError, match=r"empty_\.py: got no class that declares"):
        declared._declaration(path)


FILE = """
from ..scenarios.features import FEATURES
from .engine import Scheme
import an_engine_that_is_nowhere

NAME = "second"
LACKS = dict.fromkeys(("ball", "hinge"), "it has none")
an_engine_that_is_nowhere.start()


class Helper:
    schemes: tuple = ()


class Engine:
    name: str = "engine"
    features: frozenset = frozenset(FEATURES)
    schemes: tuple = (Scheme("first", 1, "", {}), Scheme(NAME, 2, "twin", LACKS))
"""


def test_only_what_a_declaration_stands_on_is_carried_out(tmp_path):
    path = tmp_path / "engine_that_is_nowhere_.py"
    path.write_text(FILE)
    read = declared._declaration(path)
    assert [(scheme.name, scheme.order, dict(scheme.lacks)) for scheme in read.schemes] == [
        ("first", 1, {}),
        ("second", 2, {"ball": "it has none", "hinge": "it has none"}),
    ]
    assert "gravity" in read.features
    assert not read.installed
