"""Uniform solids that a body is made of, whose mass and inertia an engine is to work out by itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..reference import inertia_of_shapes, quaternions
from ..reference.checked import Array, finite, positive, unit_quaternion
from ..reference.errors import InputError

if TYPE_CHECKING:
    from .body import Quaternion, Vector

Form = Literal["sphere", "shell", "box", "cylinder", "capsule", "ellipsoid", "mesh"]

#: How many lengths each form has.
SIZES: dict[str, int] = {
    "sphere": 1, "shell": 1, "box": 3, "cylinder": 2, "capsule": 2, "ellipsoid": 3, "mesh": 0,
}  # fmt: skip


@dataclass(frozen=True)
class Solid:
    """One uniform solid, fixed to a body at ``position`` [m] and turned by ``quaternion`` in its frame.

    ``sizes`` [m] are the arguments of the function of this name in `reference.inertia_of_shapes`: radius of
    a sphere or a shell, edges of a box, radius and height of a cylinder or a capsule (along z, the height
    between its round ends), half axes of an ellipsoid. A mesh has ``vertices`` [m] and triangular ``faces``
    instead, counted against the clock as seen from outside. ``density`` is in kg/m³, of a shell, which is
    all surface, in kg/m². One that is ``taken_away`` leaves a hollow.
    """

    form: Form
    sizes: tuple[float, ...]
    density: float
    position: Vector = (0.0, 0.0, 0.0)
    quaternion: Quaternion = (0.0, 0.0, 0.0, 1.0)
    vertices: tuple[Vector, ...] = ()
    faces: tuple[tuple[int, int, int], ...] = ()
    taken_away: bool = False

    def __post_init__(self) -> None:
        if self.form not in SIZES:
            raise InputError(f"solid: got form {self.form!r}, expected one of {', '.join(SIZES)}")
        if len(self.sizes) != SIZES[self.form]:
            raise InputError(f"{self.form}: got sizes {self.sizes}, expected {SIZES[self.form]} of them")
        if bool(self.vertices) != (self.form == "mesh"):
            raise InputError(
                f"{self.form}: got {len(self.vertices)} vertices; a mesh has some, nothing else does"
            )
        positive(f"{self.form} density", self.density)
        finite(f"{self.form} position", self.position, (3,))
        unit_quaternion(f"{self.form} quaternion", self.quaternion)
        self.whole()  # raises for lengths and faces that cannot be

    def whole(self) -> inertia_of_shapes.Solid:
        """Volume, centre and inertia of one kilogram in its own axes, in closed form."""
        if self.form == "mesh":
            return inertia_of_shapes.polyhedron(self.vertices, self.faces)
        form: inertia_of_shapes.Solid = getattr(inertia_of_shapes, self.form)(*self.sizes)
        return form

    def mass(self) -> float:
        """Mass [kg], below 0 of what is taken away."""
        return (-1 if self.taken_away else 1) * self.density * self.whole().volume


def together(solids: Sequence[Solid]) -> tuple[float, Array, Array]:
    """Mass [kg], centre (3,) [m] and inertia about it (3, 3) [kg m²] of solids, in their body's axes."""
    masses = [solid.mass() for solid in solids]
    mass = positive("mass of all solids together", sum(masses))
    turns = [quaternions.matrix(np.array(solid.quaternion)) for solid in solids]
    centres = [
        np.array(solid.position) + turn @ solid.whole().centre
        for solid, turn in zip(solids, turns, strict=True)
    ]
    centre = sum((m * place for m, place in zip(masses, centres, strict=True)), np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for m, place, turn, solid in zip(masses, centres, turns, solids, strict=True):
        arm = place - centre
        inertia += m * (turn @ solid.whole().inertia @ turn.T + (arm @ arm) * np.eye(3) - np.outer(arm, arm))
    return mass, centre, (inertia + inertia.T) / 2
