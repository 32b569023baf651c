"""What tests of scenes share: a wrong engine's failed checks, and how fast a phase of the truth turns."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.engine import Engine, Setup
from poinsot.adapters.simulate import simulate
from poinsot.reference.checked import Array
from poinsot.reports import setup
from poinsot.reports.judge import judge
from poinsot.reports.verdict import Status
from poinsot.scenarios.body import Body
from poinsot.scenarios.scene import Scene

_FIELDS = ("position", "quaternion", "velocity", "omega", "joint_position", "joint_velocity")


class _Lying:
    """Repeats what was asked for, whatever was built: only its motion gives it away."""

    def build(self, scene, scheme, dt):
        self._asked = scene, dt
        super().build(scene, scheme, dt)

    def readback(self):
        return Setup(setup.expected(*self._asked))


@pytest.fixture
def failed() -> Callable[..., set[tuple[str, str]]]:
    """Kind and observable of every check that fails on an engine alone, over the ladder of a scheme.

    A ``duration`` [s] cuts the scene short: to save time where nothing is expected to fail.
    """

    def find(
        engine: type[Engine], scene: Scene, twin: str = "semi-implicit Euler", duration: float = 0.0
    ) -> set[tuple[str, str]]:
        if duration:
            samples = round(scene.samples * duration / scene.duration)
            scene = replace(scene, duration=duration, samples=samples)
        liar = type(engine.__name__, (_Lying, engine), {})
        scheme = next(scheme for scheme in engine.schemes if scheme.twin == twin)
        steps = scene.ladder(scheme.order, twin)
        runs = [simulate(scene, liar, scheme, scene.whole_step(dt))[0] for dt in steps]
        verdicts = judge(runs, {scene.full_name: scene}, ())
        return {(v.check, v.observable) for v in verdicts if v.status is Status.FAIL}

    return find


@pytest.fixture
def as_if() -> Callable[..., type[Engine]]:
    """MuJoCo with what ``change(body)`` (3, 3) says in place of the inertia of every body."""
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    def make(change: Callable[[Body], Array]) -> type[Engine]:
        class Wrong(mujoco_.MuJoCo):
            def build(self, scene, scheme, dt):
                tensors = (tuple(map(tuple, change(body).tolist())) for body in scene.bodies)
                pairs = zip(scene.bodies, tensors, strict=True)
                bodies = tuple(replace(body, inertia=tensor) for body, tensor in pairs)
                super().build(replace(scene, bodies=bodies), scheme, dt)

        return Wrong

    return make


@pytest.fixture
def own_rate() -> Callable[..., float]:
    """Rate [rad/s] at which the exact motion itself turns the phase that a rate observable follows."""

    def find(scene: Scene, name: str, duration: float = 0.0, samples: int = 2000) -> float:
        (observable,) = (o for o in scene.observables if o.name == name)
        t = np.linspace(0.0, duration or scene.duration, samples)
        motion = scene.truth(scene, t)
        arrays = {field: getattr(motion, field) for field in _FIELDS}
        stopped = replace(motion, **{field: np.repeat(a[:1], len(t), axis=0) for field, a in arrays.items()})
        return float(observable.difference(scene, motion, stopped)[0, 0])

    return find
