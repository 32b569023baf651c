"""The published score of wrong engines is that of the catalogue, and a page that is not is seen."""

import importlib.util
import sys
from pathlib import Path

import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("pybullet")

from wrong_engines import CATALOGUE, FAMILIES

PLACE = Path(__file__).resolve().parents[2] / "benchmarks" / "discernment.py"


@pytest.fixture(scope="module")
def discernment():
    specification = importlib.util.spec_from_file_location("discernment", PLACE)
    module = importlib.util.module_from_spec(specification)
    before = list(sys.path)
    specification.loader.exec_module(module)
    sys.path[:] = before
    return module


def test_the_page_names_exactly_the_catalogue(discernment):
    caught, sizes = discernment.published(discernment.PAGE.read_text(encoding="utf-8"))
    assert caught.keys() == CATALOGUE.keys()
    assert sizes.keys() == {family.what for family in FAMILIES}


def test_none_survives(discernment):
    caught, _ = discernment.published(discernment.PAGE.read_text(encoding="utf-8"))
    assert [name for name, seen in caught.items() if not seen] == []


def test_a_part_of_the_page_agrees_with_a_new_run(discernment, capsys):
    names = ["moment I3 is 1e-6 high", "quaternion is scalar-first", "last bit differs from run to run"]
    assert discernment.main(["--check", "--workers", "1", "--only", *names]) == 0
    assert "caught 3 of 3, named 3 of 3" in capsys.readouterr().out


def test_a_page_of_another_run_is_seen(discernment):
    row = discernment.Row("a", "b", "", ("truth",), "scene", "said", named=True)
    limit = discernment.Limit("mass", 1e-9, ("truth",), "scene")
    text = discernment.page([row], [limit])
    assert list(discernment.differences(text, [row], [limit])) == []
    assert list(discernment.differences(text, [row._replace(caught=())], [limit])) == ["a: not caught now"]
    assert list(discernment.differences(text, [row], [limit._replace(smallest=1.9e-9)])) == []
    assert len(list(discernment.differences(text, [row], [limit._replace(smallest=3e-9)]))) == 1
    assert len(list(discernment.differences(text, [], [], whole=True))) == 2
    assert len(list(discernment.differences(text, [row._replace(name="c")], [limit]))) == 2


def test_what_is_not_caught_is_counted_so(discernment):
    row = discernment.Row("a", "b", "", (), "", "", named=False)
    assert discernment.score([row]) == "caught 0 of 1, named 0 of 1"
    assert "Survivors: a." in discernment.page([row], [])
