"""What an engine does not tell of its setup, found out by trying: a body is moved, and what it does is seen.

Every probe moves a scene both ways. Forces of inertia are even in the velocities, so that what is
odd in the change of velocity is damping, a motor, a clamp or sleep.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..reference.quaternions import conjugate, cross, rotated
from ..scenarios.blows import lasting
from ..scenarios.scene import Scene

#: ``change(q, v, dt, steps)``: change of the velocities (nv,) over so many steps, by their duration.
Change = Callable[[Array, Array, float, int], Array]

#: Slow enough [m/s, rad/s] for forces of inertia to be nothing, over steps that any damping shows in.
SLOW, SECONDS, STEPS = 1e-9, 1.0, 5
#: So fast [m/s, rad/s] that no scene comes near, over a step [s] in which nothing turns far.
FAST, INSTANT = 1e7, 1e-9
#: A slower motion over a longer step: rounding is 2e-16/AGES of what damping does.
SLOWER, AGES = 1e-15, 1e9


def of_world(scene: Scene, change: Change) -> dict[str, float]:
    """The settings of the world that PyBullet does not tell, of a ``scene`` where nothing pulls or brakes."""
    linear, angular = decays(scene, change)
    limit = speed_limit(scene, change)
    return {"linear_damping": linear, "angular_damping": angular, "velocity_limit": limit}


def of_joints(
    scene: Scene, change: Change, displaced: Sequence[Array], resting: Sequence[Array]
) -> dict[str, float]:
    """Stiffness and damping of every hinge and slide, of a ``scene`` without gravity.

    ``displaced`` and ``resting`` are the accelerations (nv,) that a unit of force in each joint
    gives where nothing else pulls or brakes, at the coordinates of these names.
    """
    found: dict[str, float] = {}
    for i, joint in enumerate(scene.scalar_joints):
        found[f"joint/{joint.name}/stiffness"] = stiffness(scene, i, change, displaced[i])
        found[f"joint/{joint.name}/damping"] = damper(scene, i, change, resting[i])
    return found


def decays(scene: Scene, change: Change) -> tuple[float, float]:
    """Rates [1/s] at which translations and turns die away; about 1 where a motor or sleep ends them.

    A scene without joints to slide or move along shows both in its turns, and the other way.
    """
    rates: dict[bool, list[float]] = {True: [], False: []}
    for index, linear in enumerate(_linear(scene)):
        v = _along(scene, index, SLOW)
        left = 1 + _odd(change, rest(scene), v, SECONDS, STEPS)[index] * STEPS * SECONDS / SLOW
        rates[linear].append((1 - abs(float(left)) ** (1 / STEPS)) / SECONDS)
    every = [*rates[True], *rates[False]] or [0.0]
    worst = [max(rates[linear] or every, key=abs) for linear in (True, False)]
    return worst[0], worst[1]


def speed_limit(scene: Scene, change: Change) -> float:
    """Largest component of a velocity [m/s, rad/s] that survives a step; inf if ``FAST`` does."""
    found = np.inf
    for index in range(len(scene.v0)):
        v = _along(scene, index, FAST)
        kept = FAST + _odd(change, rest(scene), v, INSTANT, 1)[index] * INSTANT
        if kept < 0.9 * FAST:
            found = min(found, kept)
    return float(found)


def stiffness(scene: Scene, number: int, change: Change, response: Array) -> float:
    """Spring constant of the hinge or slide of this number.

    ``response`` (nv,) is the acceleration that a unit of its force gives where it is ``displaced``.
    """
    q = displaced(scene, number)
    pulled = change(q, np.zeros(len(scene.v0)), 1.0, 1)
    return _share(pulled / -q[_scalars(scene)[number][0]], response)


def damper(scene: Scene, number: int, change: Change, response: Array) -> float:
    """Damping constant of the hinge or slide of this number; ``response`` as in ``stiffness``, at rest."""
    v = _along(scene, _scalars(scene)[number][1], SLOWER)
    return _share(_odd(change, rest(scene), v, AGES, 1) / -SLOWER, response)


def rest(scene: Scene) -> Array:
    """Coordinates (nq,) of the start, but with every spring slack."""
    q = np.array(scene.q0)
    for joint, (at_q, _) in zip(scene.scalar_joints, _scalars(scene), strict=True):
        if joint.stiffness:
            q[at_q] = 0.0
    return q


def displaced(scene: Scene, number: int) -> Array:
    """Coordinates at rest but for the hinge or slide of this number, which is further from 0 by 1."""
    q, place = rest(scene), _scalars(scene)[number][0]
    q[place] += np.copysign(1.0, q[place])
    return q


def _scalars(scene: Scene) -> list[tuple[int, int]]:
    """Places of the coordinate and the velocity of every hinge and slide."""
    return [
        (at_q.start, at_v.start)
        for _, joint, at_q, at_v in scene.slices()
        if joint.kind in ("hinge", "slide")
    ]


def limit(change: Change, q: Array, v: Array) -> Array:
    """The change of velocity (nv,) in the limit of small steps, of free bodies only.

    Its mean over both ways of a motion is even in the step, so that of each level of the
    extrapolation the error falls by two more orders.
    """
    spin = float(np.abs(v.reshape(-1, 6)[:, 3:]).max()) or 1.0
    steps = [0.1 / spin / 2**k for k in range(5)]
    table = [(change(q, v, dt, 1) + change(q, -v, dt, 1)) / 2 for dt in steps]
    for level in range(1, len(table)):
        table = [finer + (finer - coarser) / (4**level - 1) for coarser, finer in pairwise(table)]
    return table[0]


def at_origin(center: Array, turn: Array, omega: Array, arm: Array) -> Array:
    """Acceleration (6,) of a free joint from that of its body's centre of mass, and of ω, in world axes.

    ``turn`` (4,) and ``omega`` (3,), in body axes, are the joint's; ``arm`` (3,) is where the centre
    is in the body [m].
    """
    omega, alpha, arm = rotated(turn, omega), center[3:], rotated(turn, arm)
    origin = center[:3] - cross(alpha, arm) - cross(omega, cross(omega, arm))
    return np.concatenate([origin, rotated(conjugate(turn), alpha)])


def without(scene: Scene, *settings: str) -> Scene:
    """The scene without contacts and burning, ``gravity`` and forces, ``stiffness`` or ``damping``.

    What forces it keeps act for ever, blows too.
    """
    lost: dict[str, Any] = dict.fromkeys(set(settings) - {"gravity"}, 0.0)
    bodies = [
        replace(body, joints=tuple(replace(joint, **lost) for joint in body.joints)) for body in scene.bodies
    ]
    weightless = "gravity" in settings
    gravity, forces = ((0.0, 0.0, 0.0), ()) if weightless else (scene.gravity, lasting(scene.forces))
    return replace(scene, bodies=tuple(bodies), gravity=gravity, forces=forces, contacts=(), burning=())


def _share(change: Array, response: Array) -> float:
    """How many times the response is in the change; not a number if there is no response."""
    size = float(response @ response)
    return float(change @ response) / size + 0.0 if size else np.nan


def _odd(change: Change, q: Array, v: Array, dt: float, steps: int) -> Array:
    return (change(q, v, dt, steps) - change(q, -v, dt, steps)) / 2


def _along(scene: Scene, index: int, speed: float) -> Array:
    v = np.zeros(len(scene.v0))
    v[index] = speed
    return v


def _linear(scene: Scene) -> Iterator[bool]:
    """Of each velocity whether it is one of translation."""
    for joint in scene.joints:
        yield from {"free": (True,) * 3 + (False,) * 3, "slide": (True,)}.get(
            joint.kind, (False,) * (3 if joint.kind == "ball" else 1)
        )
