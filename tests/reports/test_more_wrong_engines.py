"""More engines wrong in one known way, alone and lying about their setup: only motion gives them away."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("pybullet")

from poinsot.adapters import pybullet_
from poinsot.adapters.engine import EngineError, Setup
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio, pin
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.adapters.simulate import simulate
from poinsot.reports import setup
from poinsot.reports.judge import judge
from poinsot.reports.verdict import Status
from poinsot.scenarios.body import diagonal
from poinsot.scenarios.registry import scenes

TOP, TUMBLING, CHAIN = "heavy_top[moderate]", "free_asymmetric_top[general]", "co2_chain[mixture]"
PENDULUM = "large_pendulum[swing]"
EQUATIONS = ("acceleration", "equations of motion")


class Lying:
    """Builds something else than it was asked for, and says that it did not."""

    def build(self, scene, scheme, dt):
        self._asked = scene, dt
        super().build(self.mistaken(scene), scheme, dt)

    def mistaken(self, scene):
        return scene

    def readback(self):
        return Setup(setup.expected(*self._asked))


def first_body(scene, **changed):
    return replace(scene, bodies=(replace(scene.bodies[0], **changed), *scene.bodies[1:]))


class Upward(Lying, MuJoCo):
    def mistaken(self, scene):
        return replace(scene, gravity=tuple(-g for g in scene.gravity))


class StandardGravity(Lying, MuJoCo):
    def mistaken(self, scene):
        return replace(scene, gravity=(0.0, 0.0, -9.80665))


class GravityAMillionthOff(Lying, MuJoCo):
    def mistaken(self, scene):
        return replace(scene, gravity=tuple(g * (1 + 1e-6) for g in scene.gravity))


class Permuted(Lying, Pinocchio):
    def mistaken(self, scene):
        I1, I2, I3 = np.diag(scene.bodies[0].inertia_array)
        return first_body(scene, inertia=diagonal(I2, I3, I1))


class Skewed(Lying, MuJoCo):
    """A product of inertia of a millionth of the moments."""

    def mistaken(self, scene):
        inertia = scene.bodies[0].inertia_array.copy()
        inertia[0, 1] = inertia[1, 0] = 1e-6 * inertia[0, 0]
        return first_body(scene, inertia=tuple(tuple(row) for row in inertia.tolist()))


class OffCentre(Lying, MuJoCo):
    """The centre of mass a micrometre beside the axis."""

    def mistaken(self, scene):
        x, y, z = scene.bodies[0].center_of_mass
        return first_body(scene, center_of_mass=(x + 1e-6, y, z))


class Heavy(Lying, Pinocchio):
    """The first mass a ten-thousandth too large."""

    def mistaken(self, scene):
        return first_body(scene, mass=scene.bodies[0].mass * (1 + 1e-4))


class Gyroscopic(Lying, Pinocchio):
    """Its gyroscopic and Coriolis terms are multiplied by ``times``."""

    times = 2.0

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        model, data, more = self._model, self._data, 1 - self.times

        def added(q, v):
            return more * (pin.nle(model, data, q, v) - pin.computeGeneralizedGravity(model, data, q))

        self._mechanism = replace(self._mechanism, force=added)


class Reversed(Gyroscopic):
    times = -1.0


class SlightlyDamped(Lying, PyBullet):
    """A damping of 1e-4 /s: in ten seconds a thousandth of the spin is gone."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        pybullet_.p.changeDynamics(0, -1, angularDamping=1e-4, physicsClientId=self._world.client)


class Linearised(Lying, MuJoCo):
    """Its pendulum is pulled back by the angle in place of its sine."""

    def step(self, n):
        body, (angle,) = self._scene.bodies[0], self._data.qpos
        moment = 9.81 * body.mass * np.linalg.norm(np.cross(body.joints[0].axis, body.center_of_mass))
        for _ in range(n):
            angle = self._data.qpos[0]
            self._data.qfrc_applied[0] = moment * (np.sin(angle) - angle)
            super().step(1)


class HalfAStepLate(Lying, MuJoCo):
    """Tells velocities of the middle of the last step, as a leapfrog scheme keeps them.

    That is within a first-order scheme's own error, at every step: where that error is only bounded, and
    not predicted, it takes a twin to see it.
    """

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._before = self._data.qvel.copy()

    def step(self, n):
        super().step(n - 1)
        self._before = self._data.qvel.copy()
        super().step(1)

    def state(self):
        now = self._data.qvel.copy()
        self._data.qvel[:] = (self._before + now) / 2
        found = super().state()
        self._data.qvel[:] = now
        return found


class NeverNormalised(Lying, MuJoCo):
    """Its quaternions grow by a part in 10⁹ a step."""

    def state(self):
        found = super().state()
        return found._replace(quaternion=found.quaternion * (1 + 1e-9 * self._steps))


class NoisyEcho(Lying, MuJoCo):
    """Hands out the exact motion, with noise that hides it."""

    def state(self):
        found = super().state()
        exact = self._scene.truth(self._scene, np.array([self._steps * self._model.opt.timestep]))
        return found._replace(
            omega=exact.omega[0] + np.random.default_rng().normal(scale=1e-6, size=found.omega.shape),
            quaternion=exact.quaternion[0],
        )


def red(engine, scene):
    """Kind and observable of what fails over the ladder of an engine's first scheme."""
    scene, scheme = scenes()[scene], engine.schemes[0]
    first, *finer = (scene.whole_step(dt) for dt in scene.ladder(scheme.order, scheme.twin))
    runs = [simulate(scene, engine, scheme, first, 2)[0]]
    runs += [simulate(scene, engine, scheme, dt)[0] for dt in finer]
    verdicts = judge(runs, known=())
    return {(v.check, v.observable) for v in verdicts if v.status is not Status.PASS}


@pytest.mark.parametrize(
    ("engine", "scene", "caught"),
    [
        (Upward, TOP, {EQUATIONS, ("truth", "omega"), ("truth", "precession")}),
        (StandardGravity, TOP, {EQUATIONS, ("truth", "orientation, limit")}),
        (GravityAMillionthOff, TOP, {EQUATIONS, ("truth", "orientation, limit")}),
        (Permuted, TUMBLING, {EQUATIONS, ("truth", "omega"), ("invariant", "angular momentum")}),
        (Skewed, TUMBLING, {EQUATIONS, ("truth", "orientation, limit")}),
        (OffCentre, TOP, {EQUATIONS, ("truth", "orientation, limit")}),
        (Heavy, CHAIN, {EQUATIONS, ("truth", "position, scheme's own")}),
        (Gyroscopic, TUMBLING, {EQUATIONS, ("truth", "omega"), ("invariant", "angular momentum")}),
        (Reversed, TUMBLING, {EQUATIONS, ("truth", "omega"), ("invariant", "angular momentum")}),
        (SlightlyDamped, TUMBLING, {("truth", "orientation, limit"), ("truth", "omega, limit")}),
        (Linearised, PENDULUM, {("truth", "orientation"), ("invariant", "energy")}),
        (HalfAStepLate, CHAIN, {("truth", "velocity, scheme's own")}),
        (NeverNormalised, TUMBLING, {("invariant", "quaternion norm")}),
        (NoisyEcho, TUMBLING, {("determinism", "state"), ("order", "omega"), ("order", "orientation")}),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_a_wrong_engine_is_caught(engine, scene, caught):
    assert caught <= red(engine, scene)


@pytest.mark.parametrize("scene", [TOP, TUMBLING, CHAIN, PENDULUM])
@pytest.mark.parametrize("engine", [MuJoCo, Pinocchio, PyBullet])
def test_a_right_one_is_not_even_if_it_says_nothing_of_its_setup(engine, scene):
    assert red(type(engine.__name__, (Lying, engine), {}), scene) == set()


class Recovers(Lying, MuJoCo):
    """Leaves the finite numbers for one sample, and is back as if nothing had been."""

    def state(self):
        found = super().state()
        t = self._steps * self._model.opt.timestep
        return found._replace(omega=found.omega * np.nan) if 0.3 < t < 0.32 else found


def test_numbers_that_were_lost_for_a_moment_are_not_forgiven():
    with pytest.raises(EngineError, match=r"not finite at t = 0\.3"):
        red(Recovers, TOP)
