"""Where an engine has a body's centre of mass, by where it says that the body is."""

from dataclasses import replace

import numpy as np

from ..reference import equations_of_motion, quaternions
from ..reference.checked import Array
from ..reference.tree_schemes import apart
from .evidence import NOTHING, Evidence
from .fitting import size
from .intervals import Intervals, unit_quaternions

#: What a place told may differ by from sample to sample, as a part of the largest, if it is one point.
STEADY = 1e-10
#: Differences below this are of rounding, in the truth too.
NEAR = 1e-9


def displaced_centres(evidence: Evidence) -> str:
    """What is said of bodies whose place told and whose motion both speak of another centre of mass."""
    cut = evidence.intervals
    if cut is None or evidence.scheme == "exact":
        return ""
    by, fits = _from_joints(evidence, cut)
    # Where a free body that others hang on begins elsewhere, it is that one, and not the others.
    if evidence.elsewhere > NOTHING and (found := _of_the_start(evidence)):
        return found
    return _of_centres(evidence, by) if np.any(by) and fits else ""


def elsewhere(evidence: Evidence) -> str:
    """What is said of bodies that are told elsewhere than joints or start put them, and move rightly."""
    cut = evidence.intervals
    if cut is None or evidence.scheme == "exact" or size(evidence.residual) > NOTHING:
        return ""
    by, _ = _from_joints(evidence, cut)
    if np.any(by):
        name = evidence.scene.bodies[int(np.argmax(np.abs(by).max(axis=1)))].name
        return f"position told of body {name!r} is that of another point than its centre of mass"
    if evidence.inconsistent > NOTHING or evidence.elsewhere <= NOTHING:
        return ""
    ahead = _ahead(evidence, cut)
    if ahead:
        whole = "sample" if ahead == cut.stride else "step"
        return f"state is {f'{ahead} steps' if 1 < ahead < cut.stride else f'one {whole}'} early"
    return f"motion begins in another state than was asked for: {', '.join(_start(evidence))}"


def _ahead(evidence: Evidence, cut: Intervals) -> int:
    """By how many steps the first state told is ahead of the start; 0 if it is not one that follows it."""
    asked = Intervals.of(evidence.scene, replace(evidence.cell.truth, provenance=evidence.told.provenance))
    for steps in range(1, cut.stride + 1):
        if asked is None:
            break
        q, v = asked.advanced(evidence.model, evidence.scheme, np.array([0]), steps=steps)
        off = max(_largest(apart(evidence.model.links, q[0], cut.q[0])), _largest(v[0] - cut.v[0]))
        if off <= NEAR * (1 + _largest(cut.v)):
            return steps
    return 0


def displaced(name: str, by: Array) -> str:
    """In words, a centre of mass that is not where it should be, ``by`` (3,) [m] in its body's axes."""
    axes = np.flatnonzero(np.abs(by) > 1e-6 * np.abs(by).max())
    parts = [f"by {by[k]:.3g} m along its axis {k + 1}" for k in axes]
    return f"centre of mass of body {name!r} is displaced {' and '.join(parts)}"


def _from_joints(evidence: Evidence, cut: Intervals) -> tuple[Array, bool]:
    """How far (b, 3) bodies are told from where joints put them, in their axes; 0 if not steadily.

    And whether the velocities told are those of these places.
    """
    told, links = evidence.told, evidence.model.links
    q = unit_quaternions(cut.scene, cut.q)
    position, _, velocity, _ = equations_of_motion.link_motion(links, q, cut.v)
    back = quaternions.conjugate(told.quaternion)
    away = quaternions.rotated(back, told.position - position)
    mean, spread = away.mean(axis=0), np.ptp(away, axis=0).max()
    size_of_all = float(np.abs(told.position).max()) + 1e-9
    if spread > STEADY * size_of_all:
        return np.zeros_like(mean), False
    mean[np.abs(mean) < 100 * STEADY * size_of_all] = 0.0
    moving = quaternions.rotated(told.quaternion, np.cross(told.omega, mean))
    left = np.abs(told.velocity - velocity - moving).max()
    return mean, bool(left <= 100 * STEADY * (float(np.abs(told.velocity).max()) + 1e-9))


def _of_centres(evidence: Evidence, by: Array) -> str:
    """The centres themselves are there if the motion is that of bodies which have them there."""
    model, names = evidence.model, [body.name for body in evidence.scene.bodies]
    for at, vector in enumerate(by):
        model = model.displaced(at, vector)
    if size(evidence.fit_to_motion(model)) > NOTHING:
        return ""
    first, *more = [displaced(name, vector) for name, vector in zip(names, by, strict=True) if vector.any()]
    return f"{first}, and those of {len(more)} more" if more else first


def _of_the_start(evidence: Evidence) -> str:
    """The same of a free body, which is told by its centre of mass: it begins elsewhere."""
    told, truth = evidence.told, evidence.cell.truth
    away, faster = (getattr(told, n)[0] - getattr(truth, n)[0] for n in ("position", "velocity"))
    by = quaternions.rotated(quaternions.conjugate(told.quaternion[0]), away)
    free = np.array([any(joint.kind == "free" for joint in body.joints) for body in evidence.scene.bodies])
    left = (faster - quaternions.rotated(told.quaternion[0], np.cross(told.omega[0], by)))[free]
    same = [_largest(getattr(told, n)[0] - getattr(truth, n)[0]) for n in ("quaternion", "omega")]
    moved = [int(at) for at in np.flatnonzero(free) if _largest(by[at]) > NEAR]
    if max(*same, _largest(left)) > NEAR * (1 + _largest(told.velocity)) or len(moved) != 1:
        return ""
    (at,) = moved
    if size(evidence.fit_to_motion(evidence.model.displaced(at, by[at]))) > NOTHING:
        return ""
    return displaced(evidence.scene.bodies[at].name, by[at])


def _start(evidence: Evidence) -> list[str]:
    """In what the first state told is another than the one asked for."""
    told, truth = evidence.told, evidence.cell.truth
    parts = {"position": "m", "velocity": "m/s", "omega": "rad/s"}
    off = {name: _largest(getattr(told, name)[0] - getattr(truth, name)[0]) for name in parts}
    return [f"{name} by {off[name]:.3g} {unit}" for name, unit in parts.items() if off[name] > NEAR] or [
        "orientation"
    ]


def _largest(values: Array) -> float:
    return float(np.abs(values).max(initial=0.0))
