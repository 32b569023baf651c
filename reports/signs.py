"""Signs that a log bears by itself, without a fit: stuck, late, reset, clamped, rounded, copied."""

from collections.abc import Callable, Sequence

import numpy as np

from ..reference.checked import EPSILON, Array
from ..scenarios.trajectory import Trajectory
from .evidence import NOTHING, Evidence
from .fitting import digits, size
from .order import ABOVE
from .tellings import CHANNELS
from .truth import own_error

Sign = Callable[[Evidence], str]
#: Fewest samples that make a plateau.
PLATEAU = 5
#: A clamp is a number that somebody chose: of so few digits.
ROUND = 3


def plain(evidence: Evidence) -> str:
    """What nothing else could look like; empty if nothing of it is seen."""
    return _first(evidence, (_frozen, _late, _jump, _clamped, _copied, _single))


def weaker(evidence: Evidence) -> str:
    """What wrong equations may look like too, for when none explains the motion."""
    return _first(evidence, (_noisy, _interpolated, _stuck, _unfitting))


def _first(evidence: Evidence, every: Sequence[Sign]) -> str:
    return next((found for sign in every if (found := sign(evidence))), "")


def _frozen(evidence: Evidence) -> str:
    told, truth = evidence.told, evidence.cell.truth
    still = np.all([_unmoved(getattr(told, name)) for name in CHANNELS], axis=0)
    moving = ~np.all([_unmoved(getattr(truth, name)) for name in CHANNELS], axis=0)
    held = still & moving
    tail = len(held) - int(np.argmin(held[::-1])) if not held.all() else 0
    if held.all():
        return "answers do not move at all"
    if len(held) - tail >= 3:
        return f"answers do not move after t = {told.t[tail]:g} s"
    if held.mean() > 0.2:
        return (
            f"answers stand still over {held.mean():.0%} of the samples: they are told less often than asked"
        )
    return ""


def _stuck(evidence: Evidence) -> str:
    """Whether one part alone never changes."""
    told, truth = evidence.told, evidence.cell.truth
    for name, words in CHANNELS.items():
        array, true = getattr(told, name), getattr(truth, name)
        if array.size and _unmoved(array).all() and not _unmoved(true, 1e-9).all():
            return f"{words} never changes, though the rest does"
        if array.size and not np.any(array) and np.any(true):
            return f"{words} is told as 0"
    return ""


def _late(evidence: Evidence) -> str:
    """Whether only the first interval is of another length: all that follows is told so much later."""
    cut = evidence.intervals
    if cut is None or len(cut.q) < 4 or evidence.scheme == "exact":
        return ""
    if size(evidence.residual[1:]) > NOTHING or size(evidence.residual[0]) <= NOTHING:
        return ""
    first = np.array([0])
    for steps in range(2 * cut.stride + 1):
        left = cut.residual(evidence.model, evidence.scheme, first, steps=steps)
        if size(left) <= NOTHING:
            return _lateness(cut.stride - steps, cut.stride)
    return ""


def _lateness(steps: int, stride: int) -> str:
    way, n = ("late" if steps > 0 else "early"), abs(steps)
    if n == stride:
        return f"state is one sample {way}"
    return f"state is {'one step' if n == 1 else f'{n} steps'} {way}: time is off by so much"


def _jump(evidence: Evidence) -> str:
    """Whether a few intervals alone go wrong."""
    cut = evidence.intervals
    if cut is None or evidence.scheme == "exact":
        return ""
    bad = np.flatnonzero(evidence.per_interval > NOTHING)
    n = len(evidence.per_interval)
    if not len(bad) or len(bad) > max(2, n // 20) or _clamped(evidence):
        return ""
    at = int(bad[0])
    t = evidence.told.t[at]
    if len(bad) == 2 and bad[1] == at + 1:
        return f"the sample at t = {evidence.told.t[at + 1]:g} s is wrong, and no other"
    if evidence.inconsistent > NOTHING:
        return ""
    if at and any(
        np.allclose(
            np.hstack(_forward(evidence, steps)), np.hstack([cut.q[at + 1], cut.v[at + 1]]), atol=1e-9
        )
        for steps in range(cut.stride + 1)
    ):
        return f"state was reset to the start between t = {t:g} s and {evidence.told.t[at + 1]:g} s"
    return f"state jumps between t = {t:g} s and {evidence.told.t[at + 1]:g} s, and is right before and after"


def _forward(evidence: Evidence, steps: int) -> tuple[Array, Array]:
    cut = evidence.intervals
    if cut is None:
        return np.empty(0), np.empty(0)
    q, v = cut.advanced(evidence.model, evidence.scheme, np.array([0]), steps=steps)
    return q[0], v[0]


def _clamped(evidence: Evidence) -> str:
    """Whether speeds stay at one largest value where the true ones go beyond it."""
    told, truth = evidence.told, evidence.cell.truth
    for name, unit in (("omega", "rad/s"), ("velocity", "m/s"), ("joint_velocity", "")):
        got, true = (getattr(m, name).reshape(len(told.t), -1) for m in (told, truth))
        for mine, its in ((got, true), (_lengths(told, name), _lengths(truth, name))):
            for k in range(mine.shape[1]):
                top = float(np.abs(mine[1:, k]).max())
                at = np.abs(np.abs(mine[1:, k]) - top) <= 1e-9 * top
                beyond = np.abs(its[1:, k]) > top * 1.001
                bounded = (at & beyond).sum() >= PLATEAU and beyond[~at].sum() < at.sum()
                # What was so from the start is no clamp's doing.
                bounded &= bool(np.ptp(np.abs(mine[:, k])) > 1e-6 * top)
                if top and bounded and (digits(top) <= ROUND or _varies(its[1:, k][at & beyond])):
                    return f"{CHANNELS[name]} is clamped at {top:.6g} {unit}".rstrip()
    return ""


def _varies(values: Array) -> bool:
    return bool(np.ptp(values) > 0.01 * np.abs(values).max())


def _copied(evidence: Evidence) -> str:
    """Whether every step has the exact motion, where the scheme has an error of its own."""
    states = [o for o in evidence.scene.observables if o.kind == "state"]
    coarse = evidence.cells[0]
    for observable in states:
        own, floor = own_error(coarse, observable), coarse.floor(observable)
        if own is None or own <= 100 * ABOVE * floor or coarse.error(observable) > ABOVE * floor:
            return ""
    return "answers are the exact motion itself, not an integration of it" if states else ""


def _noisy(evidence: Evidence) -> str:
    """Whether the exact motion is told with noise: no error beside it, and another one at each sample."""
    states = [o for o in evidence.scene.observables if o.kind == "state"]
    coarse = evidence.cells[0]
    sizes = []
    for observable in states:
        own = own_error(coarse, observable)
        apart = observable.difference(coarse.scene, coarse.trajectory, coarse.truth)[1:]
        level = float(np.sqrt(np.mean(apart**2)))
        if np.abs(apart).max() <= coarse.floor(observable):
            continue
        if own is None or level > 0.05 * own or not _white(apart):
            return ""
        sizes.append(f"{level:.1g} {observable.unit} in {observable.name}")
    return f"answers are the exact motion itself with noise of {', '.join(sizes)}" if sizes else ""


def _white(apart: Array) -> bool:
    """Whether successive differences (n, k) know nothing of each other."""
    centred = apart - apart.mean(axis=0)
    power = float(np.sum(centred**2))
    return bool(abs(float(np.sum(centred[1:] * centred[:-1]))) < 5 / np.sqrt(apart.size) * power)


def _interpolated(evidence: Evidence) -> str:
    """Whether most samples lie on straight lines, or on parabolas, between a few that do not."""
    told = evidence.told
    for name in ("position", "velocity", "omega", "joint_position", "joint_velocity"):
        array = getattr(told, name).reshape(len(told.t), -1)
        array = array[:, np.ptp(array, axis=0) > 1e-9 * (1 + np.abs(array).max(initial=0.0))]
        true = getattr(evidence.cell.truth, name).reshape(len(told.t), -1)
        for order in (2, 3, 4):
            if not array.shape[1] or len(array) < 4 * order:
                continue
            bend, bent = (np.abs(np.diff(x, order, axis=0)).max(axis=1) for x in (array, true))
            flat = bend < 64 * EPSILON * np.abs(array).max()
            if flat.mean() > 0.3 and not flat.all() and bent.min() > 1e4 * EPSILON * np.abs(array).max():
                knots = 1 + round(len(flat) / max(1, int(np.sum(~flat)) / (order - 1)))
                return f"{CHANNELS[name]} is interpolated between coarser steps, of about {knots} samples"
    return ""


def _single(evidence: Evidence) -> str:
    """Whether a part of the state has no more digits than single precision keeps."""
    found = []
    for name, words in CHANNELS.items():
        values = getattr(evidence.told, name)[1:].ravel()
        # What has few digits anyway, as 0 and whole numbers, tells nothing.
        least = 1e-6 * np.abs(getattr(evidence.cell.truth, name)).max(initial=0.0)
        values = values[(values.astype(np.float16) != values) & (np.abs(values) > least)]
        rounded = values.astype(np.float32)
        # Exact when it was rounded, it may have been turned into other axes and back since.
        exact = np.abs(rounded - values) < 1e-3 * np.spacing(np.abs(rounded))
        if len(np.unique(rounded)) > 20 and exact.mean() > 0.95:
            found.append(words)
    if len(found) > 2:
        return "state is kept in single precision"
    return (
        f"{' and '.join(found)} {'is' if len(found) == 1 else 'are'} kept in single precision"
        if found
        else ""
    )


def _unfitting(evidence: Evidence) -> str:
    """Whether what is told of bodies and of joints cannot both be true."""
    cut = evidence.intervals
    if cut is None or evidence.inconsistent <= NOTHING or size(evidence.residual) > NOTHING:
        return ""
    name, off = max(cut.leftover.items(), key=lambda found: found[1])
    return f"{name} told of the bodies does not fit their joints: it is off by up to {off:.3g}"


def _lengths(motion: Trajectory, name: str) -> Array:
    array = getattr(motion, name)
    return np.linalg.norm(array, axis=-1) if array.ndim == 3 else np.empty((len(array), 0))


def _unmoved(array: Array, share: float = 0.0) -> Array:
    """Where (n − 1,) a part of the state is as it was a sample before."""
    change = np.abs(np.diff(array.reshape(len(array), -1), axis=0))
    return np.asarray((change <= share * (np.abs(array).max(initial=0.0) + 1e-300)).all(axis=1))
