"""Shapes that a viewer draws of a scene's bodies: those they are given, else those their inertias tell of.

A body made of solids is drawn as those, and any other as the ball, cylinder or brick of its inertia; what
touches is as wide as what touches, and what never turns is a bead. A line leads from what holds a body to its
centre and on to what it holds itself; three short ones show how it turns. All is in the body's axes, from
its centre of mass: there `log_views` puts each body's frame.
"""

from collections.abc import Iterator

import numpy as np

from ..reference.checked import Array
from ..reference.quaternions import from_matrix, matrix
from ..scenarios.body import IDENTITY, Body
from ..scenarios.contact import Plane, Rim, Sphere
from ..scenarios.scene import Scene
from ..scenarios.solid import Solid
from .log_primitives import Color, Part, ball, brick, cylinder, line, triangles

#: A shape that only inertia tells of is at least this part of what the scene spans, and at most these parts
#: of how far the next body of another tree is, and the furthest of its own.
SEEN, APART, WITHIN = 0.02, 0.6, 2.0
#: A bead to the way to the next body, or alone to what the scene spans.
BEAD, ALONE = 0.4, 0.1
#: A plane that is touched, to what the scene spans.
WIDE = 1.5
#: Moments as near to each other as this part of the largest are alike.
ALIKE = 1e-9
#: How long a line along an axis is to the largest edge of its body.
AXIS = 0.75
COLORS: tuple[Color, ...] = ((0.13, 0.40, 0.67), (0.84, 0.38, 0.20), (0.20, 0.58, 0.38), (0.55, 0.34, 0.64))
AXES: tuple[Color, ...] = ((0.8, 0.1, 0.1), (0.1, 0.6, 0.1), (0.1, 0.2, 0.8))
GREY, DARK = (0.6, 0.6, 0.6), (0.2, 0.2, 0.2)
#: What solids and bodies, shells, and planes that are touched hide of what is behind them.
SOLID, SHELL, PLANE = 0.85, 0.4, 0.5

_MIDDLE, _UNTURNED = np.zeros(3), np.array(IDENTITY)


def of_body(scene: Scene, place: int, positions: Array) -> tuple[str, list[Part]]:
    """In words what the body of this number is drawn as, and its parts.

    ``positions`` (n, b, 3) [m]: where the bodies of the ``scene`` come in its run.
    """
    body, color = scene.bodies[place], COLORS[place % len(COLORS)]
    center = np.array(body.center_of_mass)
    touching: list[Sphere | Rim | Plane] = [c.shape for c in scene.contacts if c.first == body.name]
    touching += [c.against for c in scene.contacts if c.second == body.name]
    if body.solids:
        words, parts = "its solids", [part for s in body.solids for part in _solid(s, center, color)]
    elif any(isinstance(shape, Plane) for shape in touching):
        planes = [shape for shape in touching if isinstance(shape, Plane)]
        at = [np.array(plane.normal) * plane.offset - center for plane in planes]
        words = "planes that are touched"
        parts = [_slab(plane, foot, positions, color) for plane, foot in zip(planes, at, strict=True)]
    elif not _turns(scene, body):
        words, parts = "a bead", [ball(_MIDDLE, _UNTURNED, [_bead(place, positions)] * 3, color, SOLID)]
    else:
        widths = [2 * shape.radius for shape in touching if isinstance(shape, (Sphere, Rim))]
        words, part = _by_inertia(body, color, _limits(scene, place, positions), widths)
        parts = [part]
    largest = max((max(part["size"].values()) for _, part in parts if "size" in part), default=0.0)
    return words, parts + list(_lines(scene, body, color, largest))


def of_world(scene: Scene, positions: Array) -> list[Part]:
    """Planes of the world that are touched, in its axes, under the middle of what happens."""
    planes = [c.against for c in scene.contacts if c.second is None and isinstance(c.against, Plane)]
    middle, found = positions.reshape(-1, 3).mean(axis=0), []
    for plane in dict.fromkeys(planes):
        normal = np.array(plane.normal)
        found.append(_slab(plane, middle + (plane.offset - normal @ middle) * normal, positions, GREY))
    return found


def _solid(solid: Solid, center: Array, color: Color) -> Iterator[Part]:
    at, turn = np.array(solid.position) - center, np.array(solid.quaternion)
    look = (DARK, 1.0) if solid.taken_away else (color, SHELL if solid.form == "shell" else SOLID)
    sizes = np.array(solid.sizes)
    if solid.form == "mesh":
        yield triangles(at, turn, solid.vertices, solid.faces, *look)
    elif solid.form == "box":
        yield brick(at, turn, sizes, *look)
    elif solid.form in ("sphere", "shell", "ellipsoid"):
        yield ball(at, turn, 2 * np.broadcast_to(sizes, 3), *look)
    else:
        width, height = 2 * sizes[0], sizes[1]
        yield cylinder(at, turn, [width, width, height], *look)
        if solid.form == "capsule":
            end = matrix(turn)[:, 2] * height / 2
            yield from (ball(at + side * end, turn, [width] * 3, *look) for side in (1, -1))


def _by_inertia(
    body: Body, color: Color, limits: tuple[float, float], widths: list[float]
) -> tuple[str, Part]:
    """A solid of the body's inertia: as it is, within ``limits`` [m], or as wide as what touches."""
    moments, axes = _principal(body.inertia_array)
    squares = np.maximum(6 * (moments.sum() - 2 * moments) / body.mass, 0.0)  # of a brick's edges
    gap = np.diff(moments) <= ALIKE * moments[-1]
    if gap.all() or (widths and not gap.any()):
        word, make, size = "ball", ball, np.full(3, np.sqrt(10 * moments.mean() / body.mass))
    elif gap.any():  # about the axis of the moment that is alone, which the last of the columns is to be
        alone, pair = (2, 0) if gap[0] else (0, 1)
        axes = np.roll(axes, 2 - alone, axis=1)
        width = np.sqrt(8 * moments[alone] / body.mass)
        height = np.sqrt(max(12 * moments[pair] - 6 * moments[alone], 0.0) / body.mass)
        word, make, size = "cylinder", cylinder, np.array([width, width, height])
    else:
        word, make, size = "brick", brick, np.sqrt(squares)
    wanted = widths[0] / size[0] if widths else float(np.clip(size.max(), *limits)) / size.max()
    words = f"a {word} of its inertia" if wanted == 1 else f"a {word} in proportion to its inertia"
    return words, make(_MIDDLE, from_matrix(axes), size * wanted, color, SOLID)


def _principal(inertia: Array) -> tuple[Array, Array]:
    """Principal moments (3,), ascending, and their axes, the columns of a rotation (3, 3)."""
    moments, axes = np.linalg.eigh(inertia)
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    return moments, axes


def _limits(scene: Scene, place: int, positions: Array) -> tuple[float, float]:
    """How large [m] a shape is at least and at most whose size is not given."""
    roots = [_carriers(scene, body)[-1] for body in scene.bodies]
    away = np.linalg.norm(positions[0] - positions[0, place], axis=1)
    kin = np.array([root is roots[place] for root in roots])
    others, own = away[~kin & (away > 0)], away[kin & (away > 0)]
    most = min([*(APART * others), *([WITHIN * own.max()] if len(own) else []), np.inf])
    return min(SEEN * span(positions), most), most


def _bead(place: int, positions: Array) -> float:
    away = np.linalg.norm(positions[0] - positions[0, place], axis=1)
    near = away[away > 0]
    return float(BEAD * near.min()) if len(near) else ALONE * span(positions)


def _slab(plane: Plane, at: Array, positions: Array, color: Color) -> Part:
    """A thin brick whose upper side is the ``plane`` around ``at`` (3,) [m]."""
    normal, width = np.array(plane.normal), WIDE * span(positions)
    across = np.cross(np.eye(3)[int(np.argmin(np.abs(normal)))], normal)
    across /= np.linalg.norm(across)
    turn = from_matrix(np.column_stack([across, np.cross(normal, across), normal]))
    size = np.array([width, width, 0.02 * width])
    return brick(at - normal * size[2] / 2, turn, size, color, PLANE)


def _lines(scene: Scene, body: Body, color: Color, largest: float) -> Iterator[Part]:
    if not _turns(scene, body):
        return
    center = np.array(body.center_of_mass)
    free = any(joint.kind == "free" for joint in body.joints)
    ends = [] if free else [-center]
    ends += [np.array(held.position) - center for held in scene.bodies if held.parent == body.name]
    yield from (line([_MIDDLE, end], color) for end in ends if end.any())
    reach = AXIS * (largest or float(np.abs(ends).max(initial=0.0)))
    yield from (line([_MIDDLE, reach * axis], paint) for axis, paint in zip(np.eye(3), AXES, strict=True))


def _carriers(scene: Scene, body: Body) -> list[Body]:
    """The body and all between it and the world, the root last."""
    known: dict[str | None, Body] = {other.name: other for other in scene.bodies}
    found = [body]
    while found[-1].parent:
        found.append(known[found[-1].parent])
    return found


def _turns(scene: Scene, body: Body) -> bool:
    """Whether any joint between the body and the world lets it turn."""
    return any(joint.kind != "slide" for one in _carriers(scene, body) for joint in one.joints)


def span(positions: Array) -> float:
    """Largest extent of all places (…, 3) along an axis [m]; 1 where nothing goes anywhere."""
    return float(np.ptp(positions.reshape(-1, 3), axis=0).max()) or 1.0
