"""Shapes for contact, as the URDF for PyBullet has them."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..reference.errors import InputError
from ..scenarios.contact import Plane, Sphere
from ..scenarios.scene import Scene

#: Half the width and half the depth [m] of the box that stands for a plane that moves.
WIDTH, DEPTH = 10.0, 0.5
#: How far [m] the box is raised: PyBullet sees what touches one only inside it, and rounding would part them.
RAISED = 1e-13


def shapes(scene: Scene, number: int) -> Iterator[str]:
    """Lines of URDF for the shapes of the body of this number, without those no contact names."""
    name = scene.bodies[number].name
    pairs = [(c.first, c.shape) for c in scene.contacts] + [(c.second, c.against) for c in scene.contacts]
    for shape in dict.fromkeys(shape for body, shape in pairs if body == name):
        yield from _shape(shape)


def _shape(shape: Any) -> Iterator[str]:
    origin, form = "", ""
    if isinstance(shape, Sphere):
        form = f'<sphere radius="{shape.radius!r}"/>'
    elif isinstance(shape, Plane):
        center = np.array(shape.normal) * (shape.offset + RAISED - DEPTH)
        if abs(shape.normal[2]) != 1:
            raise InputError(f"{shape} of a body: PyBullet's box stands for it only along z")
        origin = f'<origin xyz="{" ".join(repr(float(x)) for x in center)}" rpy="0 0 0"/>'
        form = f'<box size="{2 * WIDTH!r} {2 * WIDTH!r} {2 * DEPTH!r}"/>'
    yield f"  <collision>{origin}<geometry>{form}</geometry></collision>"
