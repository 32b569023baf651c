"""A wrong engine on the scenes where it is to be seen: run over the ladder, judged beside right ones."""

from functools import cache
from typing import Any, NamedTuple

from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reference.errors import PoinsotError
from poinsot.reports.judge import judge
from poinsot.reports.verdict import Status, Verdict
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.trajectory import Trajectory

from .entry import Sight

RIGHT = (MuJoCo, Pinocchio, PyBullet)


class Found(NamedTuple):
    """Verdicts on an engine, those on the right ones beside it, and why it broke down, if it did."""

    own: list[Verdict]
    others: list[Verdict]
    refused: str = ""

    @property
    def red(self) -> set[str]:
        """Checks that the engine does not pass, as ``"kind observable"``."""
        return {f"{v.check} {v.observable}" for v in self.own if v.status is not Status.PASS}


def ladder(engine: type[Any], scene_name: str, twin: str) -> tuple[Trajectory, ...]:
    """Every step of the scheme of this twin name, the coarsest run twice; nothing if it cannot run."""
    scene = scenes()[scene_name]
    scheme = next((scheme for scheme in engine.schemes if scheme.twin == twin), None)
    if scheme is None or unsupported(scene, engine, scheme):
        return ()
    first, *finer = (scene.whole_step(dt) for dt in scene.ladder(scheme.order, twin))
    steps = [(first, 2), *((dt, 1) for dt in finer)]
    return tuple(simulate(scene, engine, scheme, dt, repeats)[0] for dt, repeats in steps)


def tried(engine: type[Any], sight: Sight) -> Found:
    """What is found of ``engine`` there; right engines are those that it is not made of."""
    try:
        mine = ladder(engine, sight.scene, sight.twin)
    except PoinsotError as error:
        return Found([], [], str(error))
    if not mine:
        raise LookupError(f"{engine.name} {engine.version()} has no {sight.twin} for {sight.scene}")
    right = [other for other in RIGHT if not issubclass(engine, other)] if sight.beside else []
    others = [run for other in right for run in _right(other, sight.scene, sight.twin)]
    verdicts = judge([*mine, *others], known=())
    return Found(*([v for v in verdicts if (v.engine == engine.name) is own] for own in (True, False)))


@cache
def _right(engine: type[Any], scene: str, twin: str) -> tuple[Trajectory, ...]:
    return ladder(engine, scene, twin)
