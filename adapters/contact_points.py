"""Where two shapes touch, for engines that are told their points of contact."""

from typing import NamedTuple

import numpy as np

from ..reference.checked import Array
from ..scenarios.contact import Plane, Rim, Sphere


class Touch(NamedTuple):
    """A point (3,) [m] between two shapes, the normal (3,) from the first to the second, and their gap [m].

    All in world axes; a gap below 0 is how deep they lie in each other.
    """

    point: Array
    normal: Array
    gap: float


def touch(
    shape: Sphere | Rim, place: Array, turn: Array, against: Sphere | Plane, second: Array, second_turn: Array
) -> Touch:
    """Where two shapes are nearest; ``place`` (3,) [m] and ``turn`` (3, 3) are of their bodies' frames."""
    if isinstance(against, Plane):
        up = second_turn @ np.array(against.normal)
        height = float(up @ (place - second)) - against.offset
        return _on_a_plane(shape, place, turn, up, height)
    if isinstance(shape, Rim):
        raise TypeError(f"{shape} against {against}: a rim touches only planes")
    apart = second - place
    distance = float(np.linalg.norm(apart))
    normal, gap = apart / distance, distance - shape.radius - against.radius
    return Touch(place + (shape.radius + gap / 2) * normal, normal, gap)


def _on_a_plane(shape: Sphere | Rim, place: Array, turn: Array, up: Array, height: float) -> Touch:
    if isinstance(shape, Sphere):
        down = -up
    else:  # the lowest point of the circle: down, as far as the disc's own plane goes down
        axis = turn[:, 2]
        down = -up + (up @ axis) * axis
        down = down / np.linalg.norm(down)
    gap = height + shape.radius * float(up @ down)
    return Touch(place + shape.radius * down, -up, gap)
