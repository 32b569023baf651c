"""Causes that the catalogue of wrong engines lacks: wrong for a moment, by little, or from the start."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")

from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.reports.cell import Cell
from poinsot.reports.judge import judge
from poinsot.reports.localisation import localised
from poinsot.scenarios.registry import scenes
from wrong_engines.entry import CHAIN, TOP, TUMBLING, Lying
from wrong_engines.trial import ladder


class Glitch(Lying, MuJoCo):
    """Tells one sample wrongly."""

    def state(self):
        found = super().state()
        now = self._steps * self._model.opt.timestep
        return found._replace(omega=found.omega * 1.01) if abs(now - 1) < 1e-9 else found


class Fast(Lying, MuJoCo):
    """Its clock runs fast by a part in ten thousand."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._model.opt.timestep *= 1 + 1e-4


class Pushed(Lying, MuJoCo):
    """Starts with another spin."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._data.qvel[-1] *= 1.01


class Slack(Lying, MuJoCo):
    """Its springs are slack a millimetre beside where they should be."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._model.qpos_spring[:] += 1e-3


class Slippery(Lying, Pinocchio):
    """Friction is a hundredth low."""

    def mistaken(self, scene):
        return replace(scene, contacts=tuple(replace(c, friction=0.99 * c.friction) for c in scene.contacts))


class OffCentre(Lying, Pinocchio):
    """The first body's centre of mass is a few millimetres away, in all directions."""

    def mistaken(self, scene):
        body = scene.bodies[0]
        centre = np.add(body.center_of_mass, (1e-3, -2e-3, 3e-3))
        return replace(
            scene, bodies=(replace(body, center_of_mass=tuple(centre.tolist())), *scene.bodies[1:])
        )


BY = "displaced by 0.001 m along its axis 1 and by -0.002 m along its axis 2 and by 0.003 m along its axis 3"


@pytest.mark.parametrize(
    ("engine", "scene", "sentence"),
    [
        (Glitch, TOP, "the sample at t = 1 s is wrong, and no other"),
        (Fast, TOP, "step is 1.0001 times the stated one: time runs so much faster"),
        (Pushed, TUMBLING, "motion begins in another state than was asked for: omega by 0.007 rad/s"),
        (Slack, CHAIN, "rest positions of the springs of all joints are off by 0.001"),
        (Slippery, "rolling[slips]", "friction of contact 'wheel on world' is 1 % low"),
        (OffCentre, TOP, f"centre of mass of body 'top' is {BY}"),
        (OffCentre, TUMBLING, f"centre of mass of body 'satellite' is {BY}"),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_what_is_wrong_is_said(engine, scene, sentence):
    runs = ladder(engine, scene, engine.schemes[0].twin)
    cells = [Cell.of(run, dict(scenes())) for run in runs]
    assert [one.sentence for one in localised(cells, judge(runs, known=()))] == [sentence]
