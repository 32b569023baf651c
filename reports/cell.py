"""One logged run beside what is true of it: what every check starts from."""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from ..reference.checked import Array
from ..reference.errors import InputError
from ..scenarios.observables import Observable
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Provenance, Trajectory
from .growth import growth
from .verdict import Status, Verdict

#: Spacing of the doubles at 1: what one rounding may cost, relatively.
EPSILON = float(np.finfo(np.float64).eps)


@dataclass(frozen=True, eq=False)
class Cell:
    """A scene and the trajectory that one engine scheme made of it at one step."""

    scene: Scene
    trajectory: Trajectory
    provenance: Provenance

    @classmethod
    def of(cls, trajectory: Trajectory, scenes: dict[str, Scene]) -> "Cell":
        """The cell of a trajectory; raises ``InputError`` if it does not say what it is."""
        provenance = trajectory.provenance
        if provenance is None:
            raise InputError("trajectory: got one without provenance, expected one from simulate() or a log")
        if provenance.scene not in scenes:
            raise InputError(f"trajectory: got scene {provenance.scene!r}, which this Poinsot does not have")
        return cls(scenes[provenance.scene], trajectory, provenance)

    @property
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
        return observable.distance(self.scene, self.trajectory, self.truth)

    def error(self, observable: Observable) -> float:
        """Largest distance from the truth over the run."""
        return float(np.max(self.distance(observable)))

    def round_off(self, observable: Observable) -> float:
        """What rounding may add up to in ``observable`` over this run.

        Every step commits an ε of the observable's size in no particular direction, which then
        grows as a kicked motion departs from the truth: three standard deviations of that walk,
        and ten ε for reading a sample and for the truth itself.
        """
        scale = observable.scale(self.scene, self.truth)
        walk = 3 * np.sqrt(self.provenance.steps) * max(1.0, growth(self.scene))
        return float(EPSILON * scale * (10 + walk))

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


@lru_cache(maxsize=64)
def _truth(scene: Scene, times: bytes) -> Trajectory:
    return scene.truth(scene, np.frombuffer(times))
