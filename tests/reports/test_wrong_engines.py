"""Engines that are wrong in one known way, a few lines around a real one: each turns the right checks red.

Which checks stay green matters as much: together they tell what is wrong. Engines that lie repeat
in their readback what the scene asked for, so that only their motion gives them away.
"""

import re

import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("pybullet")

from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.reports.judge import judge
from poinsot.reports.verdict import Status
from wrong_engines import CATALOGUE, Sight
from wrong_engines.entry import CHAIN, FREE, PENDULUM, SE, TOP, TUMBLING, Lying
from wrong_engines.gravity import OffByABillionth
from wrong_engines.terms import NoGyroscopicTerm
from wrong_engines.trial import RIGHT, ladder, tried

SIGHTS = [(wrong, sight) for wrong in CATALOGUE.values() for sight in wrong.sights]
#: Each place where a wrong engine is held against right ones, with every right engine that has the scheme.
PLACES = [
    (engine, scene, twin)
    for scene, twin in sorted({(sight.scene, sight.twin) for _, sight in SIGHTS if sight.beside})
    for engine in RIGHT
    if twin in {scheme.twin for scheme in engine.schemes}
]


def marks(wrong):
    """Of a fault of several sizes the smallest is run by itself: who sees it sees the others."""
    of_its_kind = [w.size for w in CATALOGUE.values() if w.family and w.family is wrong.family]
    return [pytest.mark.long] if of_its_kind and wrong.size > min(of_its_kind) else []


def there(engine, sight):
    """What is found of an engine; skips where its version, or every right one's, lacks the scheme."""
    try:
        found = tried(engine, sight)
    except LookupError as error:
        pytest.skip(str(error))
    if sight.beside and not found.refused and not found.others:
        pytest.skip(f"the {sight.twin} of {engine.name} {engine.version()} has no twin")
    return found


@pytest.mark.parametrize(("engine", "scene", "twin"), PLACES)
def test_the_unchanged_engine_passes_everything(engine, scene, twin):
    found = there(engine, Sight(scene, twin, ()))
    assert {v.check for v in found.own} == {
        "truth",
        "order",
        "twin",
        "invariant",
        "setup",
        "determinism",
        "acceleration",
    }
    assert [v for v in [*found.own, *found.others] if v.status is not Status.PASS] == []


@pytest.mark.parametrize(
    ("wrong", "sight"),
    [
        pytest.param(wrong, sight, marks=marks(wrong), id=f"{wrong.name} in {sight.scene}, {sight.twin}")
        for wrong, sight in SIGHTS
    ],
)
def test_a_wrong_engine_turns_the_right_checks_red(wrong, sight):
    found = there(wrong.engine, sight)
    if sight.check == "refused":
        assert re.search(sight.says, found.refused)
        return
    assert not found.refused
    if sight.near is None:
        assert set(sight.red) <= found.red
    else:
        assert found.red - set(sight.near) == set(sight.red)
    red = [v for v in found.own if v.status is not Status.PASS]
    assert all(v.status is Status.FAIL for v in red)
    messages = [v.message for v in red if sight.check in ("", f"{v.check} {v.observable}")]
    assert any(re.search(sight.says, message) for message in messages), messages
    # No right engine is accused along with it.
    assert [v for v in found.others if v.status is not Status.PASS] == []


def test_names_are_one_s_own():
    assert len({wrong.name.lower() for wrong in CATALOGUE.values()}) == len(CATALOGUE) >= 40
    assert all(wrong.sights for wrong in CATALOGUE.values())


@pytest.mark.parametrize("scene", [TOP, TUMBLING, CHAIN, PENDULUM])
@pytest.mark.parametrize("engine", [MuJoCo, Pinocchio, PyBullet])
def test_a_right_engine_is_not_even_red_if_it_says_nothing_of_its_setup(engine, scene):
    silent = type(engine.__name__, (Lying, engine), {})
    assert tried(silent, Sight(scene, engine.schemes[0].twin, (), beside=False)).red == set()


def test_without_its_gyroscopic_term_a_body_does_not_turn_about_its_axis_at_all():
    found = tried(NoGyroscopicTerm, Sight(FREE, SE, ()))
    assert {round(v.measured, 9) for v in found.own if v.observable == "Omega_b"} == {5.0}


def test_one_step_is_enough_for_twins_to_tell_which_of_three_is_wrong():
    runs = [ladder(engine, TOP, SE)[1] for engine in (OffByABillionth, Pinocchio, PyBullet)]
    failed = {(v.engine, v.check) for v in judge(runs, known=()) if v.status is not Status.PASS}
    assert failed == {("mujoco", "twin")}
