"""What a ladder of runs shows, held against the equations and the scheme that it should have followed."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from time import perf_counter

import numpy as np

from ..adapters.centred import centred
from ..reference import quaternions, tree_schemes
from ..reference.checked import EPSILON, Array
from ..reference.errors import PoinsotError
from ..scenarios.equations import states
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory
from .acceleration import expected
from .cell import Cell
from .fitting import size
from .intervals import Intervals
from .order import extrapolated
from .supposed import Model

#: Residuals below this many roundings are nothing: right engines stay below 10.
NOTHING = 30.0
#: Intervals that a number is fitted to.
FITTED = 60
#: Intervals that are looked at before all of them are.
FEW = 5
#: Schemes whose steps are known here, by their twin names; the first to be followed is the one meant.
IMPLICIT = "implicit gyroscopic"
SCHEMES = ("semi-implicit Euler", "RKMK4", IMPLICIT, "RK4 of body velocities", "explicit Euler")
#: The implicit scheme takes ∂f/∂v of every velocity at each step: past this many it takes minutes.
MANY = 20


class OutOfTimeError(PoinsotError):
    """A search took longer than it was granted."""


@dataclass(frozen=True, eq=False)
class Evidence:
    """Cells of one scene, engine and scheme, from the coarsest step to the finest.

    ``until`` is when, by `perf_counter`, whatever still asks it to try something gets ``OutOfTimeError``.
    """

    cells: tuple[Cell, ...]
    until: float = float("inf")

    @classmethod
    def of(cls, cells: Sequence[Cell], until: float = float("inf")) -> "Evidence":
        """The cells of a ladder, in any order."""
        return cls(tuple(sorted(cells, key=lambda cell: -cell.provenance.dt)), until)

    def in_time(self) -> None:
        """Raises ``OutOfTimeError`` if its time is up."""
        if perf_counter() > self.until:
            raise OutOfTimeError("out of time")

    @property
    def scene(self) -> Scene:
        """The scene of them all."""
        return self.cells[0].scene

    @cached_property
    def cell(self) -> Cell:
        """The one whose intervals are looked at: the coarsest of an even number of steps between samples."""
        even = [c for c in self.cells if self.scene.steps_per_sample(c.provenance.dt) % 2 == 0]
        return (even or self.cells)[0]

    @property
    def told(self) -> Trajectory:
        """What that cell told."""
        return self.cell.trajectory

    @property
    def declared(self) -> str:
        """The twin name of the scheme that the engine says it is."""
        return self.cell.provenance.twin

    @cached_property
    def scheme(self) -> str:
        """That scheme if its steps are known here, else one that the steps told follow, else "exact"."""
        known = [name for name in SCHEMES if name != IMPLICIT or len(self.scene.v0) <= MANY]
        if self.declared in known:
            return self.declared
        cut = Intervals.of(self.scene, self.told)
        return next((name for name in known if cut is not None and self.followed(cut, name)), "exact")

    @cached_property
    def intervals(self) -> Intervals | None:
        """The run cut at its samples; of a scheme unknown here, the limit of the ladder for a step of 0."""
        return self.cut(lambda told: told)

    def cut(self, change: Callable[[Trajectory], Trajectory]) -> Intervals | None:
        """As ``intervals``, with every trajectory changed before."""
        if self.scheme != "exact":
            return Intervals.of(self.scene, change(self.told))
        every = [Intervals.of(self.scene, change(cell.trajectory)) for cell in self.cells]
        found = [one for one in every if one is not None]
        return _limit(found, self.cells[0].provenance.order) if len(found) >= 3 else None

    @cached_property
    def model(self) -> Model:
        """The scene's own equations, as intervals take them."""
        return Model.of(centred(self.scene).scene, by_centres=True)

    @cached_property
    def residual(self) -> Array:
        """What every interval leaves over, (n, 2 nv), in roundings; empty where there are none."""
        return self.of_intervals(self.intervals)

    def of_intervals(self, intervals: Intervals | None) -> Array:
        """The same of others."""
        self.in_time()
        if intervals is None:
            return np.empty((0, 0))
        with np.errstate(all="ignore"):
            return intervals.residual(self.model, self.scheme)

    def followed(self, intervals: Intervals, scheme: str = "", stretch: float = 1.0, steps: int = 0) -> bool:
        """Whether intervals are those of a scheme and its steps, the ladder's own if none are named."""
        scheme, n, count = scheme or self.scheme, len(intervals.q) - 1, steps or intervals.stride
        with np.errstate(all="ignore"):
            # Most that are not differ in any few.
            for which in (np.arange(0, n, max(1, n // FEW)), np.arange(n)):
                self.in_time()
                if size(intervals.residual(self.model, scheme, which, stretch, count)) > NOTHING:
                    return False
        return True

    @cached_property
    def per_interval(self) -> Array:
        """Root mean square of each interval (n,)."""
        return np.asarray(np.sqrt(np.mean(np.square(self.residual), axis=1)))

    def explained(self, left: float, before: float) -> bool:
        """Whether no more is left over than rounding, or what a term of higher order may leave."""
        return left <= max(NOTHING, 1e-4 * before)

    def fit_to_motion(self, model: Model) -> Array:
        """Residual of a supposed model over some intervals."""
        self.in_time()
        if self.intervals is None:
            return np.empty(0)
        n = len(self.intervals.q) - 1
        which = np.unique(np.linspace(0, n - 1, min(n, FITTED)).astype(int))
        return self.intervals.residual(model, self.scheme, which).ravel()

    @cached_property
    def accelerations(self) -> Array | None:
        """The engine's at the states of the acceleration check (n, nv), if any cell logged them."""
        logged = [cell.provenance.accelerations for cell in self.cells if cell.provenance.accelerations]
        found = np.array(logged[0]) if logged else None
        fits = found is not None and found.shape[1:] == (len(self.scene.v0),) and np.isfinite(found).all()
        return found if fits else None

    def fit_to_accelerations(self, model: Model) -> Array:
        """Force that a supposed model leaves over at those states, in roundings of the forces in it."""
        self.in_time()
        if self.accelerations is None:
            return np.empty(0)
        apart = self.accelerations - model.accelerate(*states(self.scene))
        force = np.einsum("nij,nj->ni", self._weights, apart)
        return np.asarray(force / (10 * EPSILON)).ravel()

    @cached_property
    def _weights(self) -> Array:
        """From accelerations to forces (n, nv, nv), as parts of the largest in the scene's own equations."""
        exact = expected(self.scene)
        # Where no force acts at all, rounding has no size of its own.
        size_of = np.maximum(exact.size, 1e-6 * np.median(exact.size))
        return np.asarray(exact.inertia / (exact.unit * size_of[:, None])[..., None])

    @cached_property
    def plain(self) -> Model:
        """The scene's own equations, as the acceleration check takes them."""
        return Model.of(self.scene)

    @cached_property
    def inconsistent(self) -> float:
        """How far what is told of bodies is from what is told of joints, in roundings."""
        return inconsistency(self.intervals, self.told)

    @cached_property
    def elsewhere(self) -> float:
        """How far the first state told is from the one asked for, in roundings."""
        return 0.0 if self.intervals is None else _elsewhere(self.cell)

    def begins(self, told: Trajectory) -> bool:
        """Whether a run begins as was asked for, though it be told otherwise than it was."""
        return _elsewhere(replace(self.cell, trajectory=told)) <= NOTHING

    @property
    def right(self) -> bool:
        """Whether everything told follows from the start, by a scheme known here, to rounding."""
        worst = max(size(self.residual), self.inconsistent, self.elsewhere)
        return self.intervals is not None and self.scheme != "exact" and worst <= NOTHING


def inconsistency(intervals: Intervals | None, told: Trajectory) -> float:
    """How far what ``told`` says of bodies is from what it says of joints, in roundings of its size."""
    if intervals is None:
        return 0.0
    scale = {
        "position": float(np.abs(told.position).max()),
        "orientation": 1.0,
        "velocity": _sweeping(told),
        "omega": float(np.abs(told.omega).max()),
    }
    turns = 1 + float(np.abs(told.joint_position).max(initial=0.0))
    parts = [
        left / (100 * EPSILON * (scale[name] + 1e-9) * turns) for name, left in intervals.leftover.items()
    ]
    return max(parts)


def _sweeping(motion: Trajectory) -> float:
    """Speed [m/s] that velocities are rounded as: engines take them about the world's origin."""
    swept = np.abs(motion.omega).max() * np.abs(motion.position).max()
    return float(max(np.abs(motion.velocity).max(), swept))


def _elsewhere(cell: Cell) -> float:
    told, truth = cell.trajectory, cell.truth
    turn = quaternions.product(quaternions.conjugate(truth.quaternion[0]), told.quaternion[0])
    found = [float(np.abs(quaternions.rotation_vector(turn)).max())]
    for name in ("position", "velocity", "omega"):
        mine, its = getattr(told, name), getattr(truth, name)
        scale = _sweeping(truth) if name == "velocity" else float(np.abs(its).max())
        found.append(float(np.abs(mine[0] - its[0]).max()) / (scale + 1e-9))
    return max(found) / (100 * EPSILON)


def _limit(every: Sequence[Intervals], order: int) -> Intervals:
    """The states that a ladder's states tend to as the step goes to 0."""
    finest = every[-1]
    dts = [one.dt for one in every]
    changes = [tree_schemes.apart(Model.of(one.scene).links, one.q, finest.q) for one in every]
    dq, before_q = extrapolated(dts, changes, order)
    v, before_v = extrapolated(dts, [one.v for one in every], order)
    noise = np.concatenate([np.abs(dq - before_q).max(axis=0), np.abs(v - before_v).max(axis=0)])
    q = tree_schemes.moved(Model.of(finest.scene).links, finest.q, dq)
    return Intervals(finest.scene, q, v, finest.dt, finest.stride, finest.rounding + noise, finest.leftover)
