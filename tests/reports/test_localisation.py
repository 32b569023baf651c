"""One sentence says what is wrong with each wrong engine, and none is said of a right one."""

import re
from dataclasses import replace

import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("pybullet")

from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.adapters.simulate import simulate
from poinsot.reports import evidence, localisation
from poinsot.reports.cell import Cell
from poinsot.reports.common_causes import Localisation, grouped, spoken
from poinsot.reports.evidence import NOTHING, Evidence
from poinsot.reports.fitting import size
from poinsot.reports.judge import judge
from poinsot.reports.localisation import localised
from poinsot.reports.verdict import Status
from poinsot.scenarios.registry import scenes
from wrong_engines import CATALOGUE
from wrong_engines.entry import CHAIN, FREE, PENDULUM, RK, SE, TOP, TUMBLING
from wrong_engines.trial import RIGHT, ladder

#: Wrong engines that leave no log to look into: the run itself says what happened.
WITHOUT_A_LOG = {"not finite for a moment, then well again"}
SIGHTS = [(wrong, sight) for wrong in CATALOGUE.values() for sight in wrong.sights if wrong.located]


def marks(wrong):
    """Those that are sought in the motion, and faults of several sizes, take minutes together."""
    return [pytest.mark.long] if wrong.family else []


def said(runs, beside=()):
    """What is said of ``runs``, all of one engine, when they are judged."""
    verdicts = judge([*runs, *beside], known=())
    mine = [v for v in verdicts if v.engine == runs[0].provenance.engine]
    cells = [Cell.of(run, dict(scenes())) for run in runs]
    return [one.sentence for one in localised(cells, mine)]


@pytest.mark.parametrize(
    ("wrong", "sight"),
    [
        pytest.param(wrong, sight, marks=marks(wrong), id=f"{wrong.name} in {sight.scene}, {sight.twin}")
        for wrong, sight in SIGHTS
    ],
)
def test_what_is_wrong_is_said(wrong, sight):
    right = [other for other in RIGHT if sight.beside and not issubclass(wrong.engine, other)]
    beside = [run for other in right for run in ladder(other, sight.scene, sight.twin)]
    runs = ladder(wrong.engine, sight.scene, sight.twin)
    if not runs:
        pytest.skip("this version of the engine has no such scheme")
    (sentence,) = said(runs, beside)
    assert re.search(wrong.located, sentence), sentence


def test_four_in_five_of_the_catalogue_are_named():
    named = [wrong.name for wrong in CATALOGUE.values() if wrong.located]
    assert len(named) >= 0.8 * len(CATALOGUE.keys() - WITHOUT_A_LOG)


@pytest.mark.parametrize("scene", [TOP, FREE, TUMBLING, CHAIN, PENDULUM])
@pytest.mark.parametrize("engine", [MuJoCo, Pinocchio, PyBullet])
def test_nothing_is_said_of_a_right_engine(engine, scene):
    for scheme in engine.schemes[:1]:
        assert said(ladder(engine, scene, scheme.twin)) == []


@pytest.mark.parametrize(
    "scene", ["gyrostat", "two_body[spring]", "axis_theorems[offset]", "double_pendulum[small]"]
)
@pytest.mark.parametrize("twin", [SE, RK, "implicit gyroscopic"])
@pytest.mark.parametrize("engine", [MuJoCo, Pinocchio])
def test_every_interval_of_a_right_run_follows_from_its_start_to_rounding(engine, twin, scene):
    """What all sentences rest on: equations, scheme and telling are known here as engines have them."""
    scheme = next(scheme for scheme in engine.schemes if scheme.twin == twin)
    run, _ = simulate(scenes()[scene], engine, scheme, max(scenes()[scene].ladder(scheme.order, twin)))
    found = Evidence.of([Cell.of(run, dict(scenes()))])
    assert size(found.residual) < NOTHING / 3
    assert found.right


def test_a_right_engine_at_a_step_far_too_coarse_is_not_accused_of_anything():
    scheme = MuJoCo.schemes[0]
    run, _ = simulate(scenes()[TOP], MuJoCo, scheme, 0.01)
    assert Evidence.of([Cell.of(run, dict(scenes()))]).right


def test_where_the_check_itself_is_wrong_the_engine_is_not_accused():
    scene = scenes()[CHAIN]
    strict = replace(scene, errors={})
    run, _ = simulate(strict, MuJoCo, MuJoCo.schemes[0], scene.dt)
    verdict = judge([run], {CHAIN: strict}, known=())[0]
    failed = [replace(verdict, check="truth", status=Status.FAIL)]
    (one,) = localised([Cell.of(run, {CHAIN: strict})], failed)
    assert not one.found
    assert one.sentence.startswith("not localised: every sample follows from the one before")


def test_two_mistakes_at_once_are_not_taken_for_one():
    class Both(MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._model.opt.gravity *= 1.01
            self._model.dof_damping[:] = 1e-3

    (sentence,) = said(ladder(Both, TOP, SE))
    assert sentence.startswith("not localised")


def test_a_short_log_of_one_step_size_is_enough():
    class Weak(MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._model.opt.gravity *= 0.99

    run, _ = simulate(scenes()[TOP], Weak, MuJoCo.schemes[0], 1e-3)
    assert said([replace(run, provenance=replace(run.provenance, accelerations=()))]) == [
        "gravity is 9.7119 m/s², not 9.81"
    ]


def test_a_search_stops_when_its_time_is_up(monkeypatch):
    class Both(MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._model.opt.gravity *= 1.01
            self._model.dof_damping[:] = 1e-3

    asked = []
    monkeypatch.setattr(localisation, "perf_counter", lambda: 0.0)
    monkeypatch.setattr(evidence, "perf_counter", lambda: asked.append(1) or float(len(asked)))
    (sentence,) = said(ladder(Both, TOP, SE))
    assert sentence == "not localised: the search stopped after 30 s"
    assert len(asked) == 31


def one(scene, *causes, found=True, scheme="Euler"):
    return Localisation((scene, "alpha", "1.0", scheme), causes, found)


def test_what_explains_several_scenes_is_said_once_and_settles_what_one_cannot_tell():
    parts = grouped(
        [
            one("a", "gravity is 9.8 m/s², not 9.81"),
            one("b", "mass of body 'bob' is 0.1 % high", "gravity is 9.8 m/s², not 9.81"),
            one("c", "not localised: nothing explains it", found=False),
        ]
    )
    assert [part["scenes"] for part in parts] == [["a", "b"], ["c"]]
    assert spoken(parts[0]) == "alpha Euler: gravity is 9.8 m/s², not 9.81 (in 2 scenes)"
    assert [part["found"] for part in parts] == [True, False]


def test_the_same_fault_of_bodies_of_other_names_is_one():
    (part,) = grouped([one("a", "mass of body 'x' is 1 % high"), one("b", "mass of body 'y' is 1 % high")])
    assert part["sentence"] == "mass of a body is 1 % high"


def test_what_cannot_be_told_apart_is_said_to_be_so():
    found = one("a", "mass is 1 % high", "gravity is 1 % high")
    assert found.sentence == (
        "either mass is 1 % high or gravity is 1 % high, which these data cannot tell apart"
    )
