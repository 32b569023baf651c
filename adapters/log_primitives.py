"""What a viewer can draw, as ``foxglove`` messages: balls, bricks, cylinders, triangles and lines."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..reference.checked import Array
from ..scenarios.body import IDENTITY

#: A field of ``foxglove.SceneEntity``, and one element of it.
Part = tuple[str, dict[str, Any]]
Color = tuple[float, float, float]

#: No edge is thinner than this part of the longest: a plate has no thickness, and is to be seen.
THINNEST = 0.02
#: Width of lines [pixels], on a screen of any scale.
WIDTH = 2.0


def ball(at: Array, turn: Array, size: npt.ArrayLike, color: Color, alpha: float) -> Part:
    """An ellipsoid with these three diameters [m]."""
    return "spheres", _placed(at, turn, color, alpha) | {"size": xyz(_seen(size))}


def brick(at: Array, turn: Array, size: npt.ArrayLike, color: Color, alpha: float) -> Part:
    """A box with these three edges [m]."""
    return "cubes", _placed(at, turn, color, alpha) | {"size": xyz(_seen(size))}


def cylinder(at: Array, turn: Array, size: npt.ArrayLike, color: Color, alpha: float) -> Part:
    """A cylinder about its z axis: two diameters and the height [m]."""
    scales = {"bottom_scale": 1.0, "top_scale": 1.0}
    return "cylinders", _placed(at, turn, color, alpha) | {"size": xyz(_seen(size))} | scales


def triangles(
    at: Array,
    turn: Array,
    corners: Sequence[Sequence[float]],
    faces: Sequence[Sequence[int]],
    color: Color,
    alpha: float,
) -> Part:
    """Triangular ``faces`` between ``corners`` [m]."""
    return "triangles", _placed(at, turn, color, alpha) | {
        "points": [xyz(np.array(corner)) for corner in corners],
        "indices": [number for face in faces for number in face],
    }


def line(points: Sequence[Array], color: Color) -> Part:
    """Straight lines from each of ``points`` (3,) [m] to the next."""
    return "lines", _placed(np.zeros(3), np.array(IDENTITY), color, 1.0) | {
        "thickness": WIDTH,
        "scale_invariant": True,
        "points": [xyz(point) for point in points],
    }


def xyz(values: Array) -> dict[str, float]:
    """A vector (3,) or a quaternion (4,), as messages have them."""
    return dict(zip("xyzw", values.tolist(), strict=False))


def _placed(at: Array, turn: Array, color: Color, alpha: float) -> dict[str, Any]:
    pose = {"position": xyz(at + 0.0), "orientation": xyz(turn)}
    return {"pose": pose, "color": dict(zip("rgba", (*color, alpha), strict=True))}


def _seen(size: npt.ArrayLike) -> Array:
    edges = np.asarray(size, dtype=np.float64)
    return np.asarray(np.maximum(edges, THINNEST * edges.max()))
