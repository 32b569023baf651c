"""Three tables, each on the one before about an axis of its own: ω31 = ω32 + ω21, as vectors.

Each table is a ball in its inertia, and far heavier than the next: nothing drives the last one but that it
is carried, so its rate on the second changes as ω̇ of the two below it says. Catches an engine that adds
rates as numbers, or whose carried joint lacks the term of Coriolis, that nothing else here hides.
"""

import numpy as np

from ..reference import quaternions
from ..reference.checked import Array
from . import hinged, observables, pictures
from .body import Body, Joint, Vector, diagonal
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: Axes of the hinges, each in the table below; where each stands on it [m].
AXES: tuple[Vector, ...] = ((0.0, 0.0, 1.0), (0.6, 0.0, 0.8), (0.0, 0.8, -0.6))
PLACES: tuple[Vector, ...] = ((0.0, 0.0, 0.2), (0.5, -0.2, 0.1), (0.1, 0.3, 0.2))
#: Moments [kg m²] and masses [kg]: what the next table does to the one below is lost in rounding.
MOMENTS, MASSES = (2e13, 1e13, 0.02), (1e12, 1e12, 0.5)
#: Angles [rad] and rates [rad/s] of the hinges at the start.
ANGLES, RATES = (0.4, -0.7, 1.1), (3.0, -4.0, 6.0)


def _hinges(scene: Scene, t: Array) -> tuple[Array, Array]:
    """Angles and rates (n, 3): σ̇3 = −σ2 (ω1×a2)·a3, a3 going round a2 at σ2 as seen from the first table."""
    angles, rates = np.array(scene.q0), np.array(scene.v0)
    turned = angles[:2] + np.outer(t, rates[:2])
    first, second, third = np.array(AXES)
    push = rates[0] * np.cross(first, second)
    A, B = push @ third, push @ np.cross(second, third)
    (sine, cosine), (sine0, cosine0) = ((np.sin(x), np.cos(x)) for x in (turned[:, 1], angles[1]))
    rate = rates[2] - A * (sine - sine0) + B * (cosine - cosine0)
    swung = (A * (cosine - cosine0) + B * (sine - sine0)) / rates[1]
    angle = angles[2] + (rates[2] + A * sine0 - B * cosine0) * t + swung
    steady = np.broadcast_to(rates[:2], turned.shape)
    return np.column_stack([turned, angle]), np.column_stack([steady, rate])


def _truth(scene: Scene, t: Array) -> Trajectory:
    angle, rate = _hinges(scene, t)
    q, omega = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (len(t), 4)), np.zeros((len(t), 3))
    position, velocity, rows = np.zeros((len(t), 3)), np.zeros((len(t), 3)), []
    for i, (axis, place) in enumerate(zip(np.array(AXES), np.array(PLACES), strict=True)):
        position = position + quaternions.rotated(q, place)
        velocity = velocity + np.cross(omega, quaternions.rotated(q, place))
        omega = omega + rate[:, i, None] * quaternions.rotated(q, axis)
        q = quaternions.product(q, quaternions.from_rotation_vector(np.outer(angle[:, i], axis)))
        rows.append((position, q, velocity, quaternions.rotated(quaternions.conjugate(q), omega)))
    places, turns, speeds, spins = (np.stack(part, axis=1) for part in zip(*rows, strict=True))
    return Trajectory(t, places, turns, speeds, spins, angle, rate)


def _missing(scene: Scene, motion: Trajectory) -> Array:
    """ω31 − ω32 − ω21, and ω1 less its hinge's (n, 6), world axes; ω32, ω21 by the hinges' own rates."""
    omega = quaternions.rotated(motion.quaternion, motion.omega)
    total = np.zeros_like(omega[:, 0])
    for i in (1, 2):
        axis = quaternions.rotated(motion.quaternion[:, i - 1], np.array(AXES[i]))
        total = total + motion.joint_velocity[:, i, None] * axis
    first = omega[:, 0] - motion.joint_velocity[:, :1] * np.array(AXES[0])
    return np.hstack([omega[:, 2] - omega[:, 0] - total, first])


def _fastest(scene: Scene, motion: Trajectory) -> float:
    return float(np.abs(motion.joint_velocity).sum(axis=1).max())


def _stack() -> Scene:
    names = ("first", "second", "third")
    return Scene(
        name="stacked_turntables",
        summary="Three turntables, each on the one before about another axis: ω31 = ω32 + ω21.",
        source="Goldstein, Classical Mechanics, ch. 4.8; Landau & Lifshitz, Mechanics, § 31",
        bodies=tuple(
            Body(
                name, mass, diagonal(moment, moment, moment), (Joint(f"{name} hinge", "hinge", axis),),
                parent=parent, position=place,
            )
            for name, mass, moment, axis, parent, place in zip(
                names, MASSES, MOMENTS, AXES, (None, *names), PLACES, strict=False
            )
        ),
        q0=ANGLES,
        v0=RATES,
        duration=1.28,
        samples=80,
        truth=_truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.velocity(),
            hinged.angle(),
            observables.invariant("ω31 − ω32 − ω21", "rad/s", _missing, _fastest),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.against_time(
                "Rate of the third hinge", "σ3 [rad/s]", lambda scene, m: m.joint_velocity[:, 2]
            ),
        ),
        ladders={1: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4), 4: (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3)},
        errors=every_scheme(ERRORS, like="semi-implicit Euler"),
    )  # fmt: skip


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, tuple[float, ...]] = {
    "semi-implicit Euler": (1.8, 4.9, 0.0, 0.0, 1.8, 0.0, 0.0),
    "implicit gyroscopic": (1.8, 4.9, 0.0, 0.0, 1.8, 0.0, 0.0),
    "RKMK4": (0.41, 0.51, 0.0, 0.0, 0.22, 0.0, 0.0),
}

SCENES = (_stack(),)
