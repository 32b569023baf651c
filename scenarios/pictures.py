"""Curves that show a motion to a person; the report draws the engine's over the truth's."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..reference import quaternions
from ..reference.checked import Array
from .trajectory import Trajectory

if TYPE_CHECKING:
    from .scene import Scene


@dataclass(frozen=True)
class Picture:
    """One curve: ``points(scene, motion)`` gives (n, 2) or (n, 3), one column for each of ``axes``.

    ``axes`` are labels with units; ``equal`` asks for the same length of a unit on every axis.
    """

    title: str
    axes: tuple[str, ...]
    points: Callable[[Scene, Trajectory], Array]
    equal: bool = True


def tip(title: str = "Tip of the symmetry axis e3") -> Picture:
    """Where the first body's e3 points, on the unit sphere in world axes."""

    def points(scene: Scene, motion: Trajectory) -> Array:
        return quaternions.rotated(motion.quaternion[:, 0], np.array([0.0, 0.0, 1.0]))

    return Picture(title, ("x", "y", "z"), points)


def body_cone() -> Picture:
    """The first body's angular velocity in its own axes."""
    return Picture(
        "ω on the body cone", ("ω1 [rad/s]", "ω2 [rad/s]", "ω3 [rad/s]"), lambda scene, m: m.omega[:, 0]
    )


def space_cone() -> Picture:
    """The first body's angular velocity in world axes."""
    return Picture(
        "ω on the space cone",
        ("ωx [rad/s]", "ωy [rad/s]", "ωz [rad/s]"),
        lambda scene, m: quaternions.rotated(m.quaternion[:, 0], m.omega[:, 0]),
    )


def against_time(title: str, label: str, value: Callable[[Scene, Trajectory], Array]) -> Picture:
    """One scalar of the motion, ``value`` (n,), over time."""
    return Picture(
        title, ("t [s]", label), lambda scene, m: np.column_stack([m.t, value(scene, m)]), equal=False
    )
