"""One logged run beside what is true of it: what every check starts from."""

from dataclasses import dataclass, field
from functools import cached_property, lru_cache

import numpy as np

from ..reference.checked import EPSILON, Array
from ..reference.errors import InputError
from ..scenarios.observables import Observable
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Provenance, Trajectory
from .growth import growth
from .verdict import Status, Verdict


@dataclass(frozen=True, eq=False)
class Cell:
    """A scene and the trajectory that one engine scheme made of it at one step."""

    scene: Scene
    trajectory: Trajectory
    provenance: Provenance
    # Several checks, the rows of error against run time and the pictures ask for the same.
    _distances: dict[Observable, Array] = field(default_factory=dict, init=False, repr=False)
    _own: dict[Observable, float] = field(default_factory=dict, init=False, repr=False)

    @classmethod
    def of(cls, trajectory: Trajectory, scenes: dict[str, Scene]) -> "Cell":
        """The cell of a trajectory.

        Raises ``InputError`` if it does not say what it is, or is not the whole of that scene: what
        was not logged would pass unseen.
        """
        provenance = trajectory.provenance
        if provenance is None:
            raise InputError("trajectory: got one without provenance, expected one from simulate() or a log")
        if provenance.scene not in scenes:
            raise InputError(f"trajectory: got scene {provenance.scene!r}, which this Poinsot does not have")
        scene = scenes[provenance.scene]
        _whole(trajectory, scene)
        return cls(scene, trajectory, provenance)

    @cached_property
    def truth(self) -> Trajectory:
        """The exact motion at the trajectory's own times."""
        return _truth(self.scene, self.trajectory.t.tobytes())

    @cached_property
    def predicted(self) -> Trajectory | None:
        """What the scheme itself must give, where that is known in closed form."""
        if self.scene.scheme_motion is None:
            return None
        return self.scene.scheme_motion(
            self.scene, self.provenance.twin, self.provenance.dt, self.trajectory.t
        )

    def distance(self, observable: Observable) -> Array:
        """Distance from the truth at each sample (n,), or (1,) for a rate."""
        if observable not in self._distances:
            self._distances[observable] = observable.distance(self.scene, self.trajectory, self.truth)
        return self._distances[observable]

    def own_error(self, observable: Observable) -> float | None:
        """Largest distance of the scheme's own exact motion from the truth; ``None`` if it is not known."""
        if self.predicted is None:
            return None
        if observable not in self._own:
            self._own[observable] = float(observable.distance(self.scene, self.predicted, self.truth).max())
        return self._own[observable]

    def scale(self, observable: Observable) -> float:
        """The size against which round-off in ``observable`` is measured."""
        return _scale(self.scene, observable, self.trajectory.t.tobytes())

    def error(self, observable: Observable) -> float:
        """Largest distance from the truth over the run."""
        return float(np.max(self.distance(observable)))

    def round_off(self, observable: Observable) -> float:
        """What rounding may add up to in ``observable`` over this run.

        Every step commits an ε of the observable's size in no particular direction, which then
        grows as a kicked motion departs from the truth: three standard deviations of that walk,
        and ten ε for reading a sample and for the truth itself. What grows evenly, as the place of
        a body that flies straight, is rounded to the same side step after step: half an ε each.
        """
        scale, steps = self.scale(observable), self.provenance.steps
        walk = 3 * np.sqrt(steps) * max(1.0, growth(self.scene))
        return float(EPSILON * scale * (10 + steps / 2 + walk))

    def floor(self, observable: Observable) -> float:
        """What rounding, and contacts that give way in this engine, may add up to in ``observable``."""
        share = self.softness
        return self.round_off(observable) + (share * self.scale(observable) if share else 0.0)

    @property
    def softness(self) -> float:
        """Share of an observable's size by which contacts that give way in this engine may change it."""
        soft = self.scene.soft.get(self.provenance.engine)
        return soft.at(self.provenance.dt) if soft else 0.0

    @property
    def granted(self) -> str:
        """Why more than round-off is granted, to end a message with; or nothing."""
        soft = self.scene.soft.get(self.provenance.engine)
        return f"; {self.softness:.2g} of its size is granted as well: {soft.reason}" if soft else ""

    def verdict(
        self,
        check: str,
        observable: str,
        status: Status,
        message: str,
        measured: float | None = None,
        allowed: float | None = None,
        unit: str = "",
        at: float | None = None,
    ) -> Verdict:
        """A verdict on this cell."""
        p = self.provenance
        return Verdict(
            p.scene, p.engine, p.engine_version, p.scheme, p.dt, check, observable, status, measured, allowed,
            unit, at, message,
        )  # fmt: skip

    def compared(
        self,
        check: str,
        observable: Observable,
        distances: Array,
        allowed: float,
        message: str,
        name: str = "",
    ) -> Verdict:
        """A verdict that passes while no distance (n,) exceeds ``allowed``."""
        worst = int(np.argmax(distances))
        measured = float(distances[worst])
        at = float(self.trajectory.t[worst]) if len(distances) == len(self.trajectory.t) else None
        status = Status.PASS if measured <= allowed else Status.FAIL
        return self.verdict(
            check, name or observable.name, status, message, measured, allowed, observable.unit, at
        )


def _whole(trajectory: Trajectory, scene: Scene) -> None:
    found = trajectory.position, trajectory.joint_position, trajectory.reaction
    got = tuple(array.shape[1] for array in found)
    expected = (len(scene.bodies), len(scene.scalar_joints), len(scene.reactions))
    if got != expected:
        words = "{} bodies, {} hinges and slides and {} reactions"
        raise InputError(
            f"trajectory of {scene.full_name}: got {words.format(*got)}, expected {words.format(*expected)}"
        )
    t, times = trajectory.t, scene.sample_times()
    # Times are whole steps, whose product with dt rounds by far less than this part of a sample.
    if t.shape != times.shape or not np.all(np.abs(t - times) <= 1e-6 * times[1]):
        last = f" up to {t[-1]:g} s" if len(t) else ""
        raise InputError(
            f"trajectory of {scene.full_name}: got {len(t)} samples{last}, expected {len(times)}, "
            f"evenly up to {times[-1]:g} s"
        )


@lru_cache(maxsize=1024)
def _scale(scene: Scene, observable: Observable, times: bytes) -> float:
    return observable.scale(scene, _truth(scene, times))


@lru_cache(maxsize=64)
def _truth(scene: Scene, times: bytes) -> Trajectory:
    return scene.truth(scene, np.frombuffer(times))
