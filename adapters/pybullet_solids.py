"""Bodies made of solids, whose inertia PyBullet works out from collision shapes.

It is told their mass and where their centre is: it works out neither. Of a single sphere, box or cylinder
its inertia is right, of anything else it is that of a box around it.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..reference.errors import InputError
from ..reference.quaternions import matrix
from ..scenarios.body import Body
from ..scenarios.scene import Scene
from ..scenarios.solid import Solid

#: What no scheme of PyBullet's carries, each with the reason.
LACKING = {
    "ellipsoid": "PyBullet has no ellipsoid among its shapes",
    "shell": "PyBullet works out inertias of what is filled; it has no shell",
    "hollow": "PyBullet takes nothing away: its inertia of several shapes is that of a box around them",
}


def flags(p: Any, scene: Scene, tree: Sequence[int]) -> int:
    """Flags to load a tree with. Raises ``InputError`` where only some of its bodies are of solids."""
    made = {bool(scene.bodies[index].solids) for index in tree}
    if made == {True, False}:
        raise InputError(
            f"scene {scene.full_name}: a tree of bodies of which only some are made of solids; PyBullet "
            "works out the inertia of all of a tree or of none"
        )
    return int(p.URDF_USE_IMPLICIT_CYLINDER if made == {True} else p.URDF_USE_INERTIA_FROM_FILE)


def axes(body: Body) -> Array | None:
    """Axes (3, 3) of the frame in which PyBullet takes a body's inertia, where its solids say."""
    return matrix(np.array(body.solids[0].quaternion)) if len(body.solids) == 1 else None


def lines(body: Body, number: int, origin: Any) -> Iterator[str]:
    """Lines of URDF for the solids of the body of this number; ``origin`` writes a place and a turn."""
    for index, solid in enumerate(body.solids):
        place = origin(solid.position, matrix(np.array(solid.quaternion)), solid.quaternion)
        yield f"  <collision>{place}<geometry>{_form(solid, _file(number, index))}</geometry></collision>"


def meshes(scene: Scene, tree: Iterable[int]) -> dict[str, str]:
    """Name and text of every file that the URDF of a tree names: meshes as Wavefront OBJ."""
    return {
        _file(number, index): _obj(solid)
        for number in tree
        for index, solid in enumerate(scene.bodies[number].solids)
        if solid.form == "mesh"
    }


def touch_nothing(p: Any, client: int, scene: Scene, places: Iterable[tuple[int, int]]) -> None:
    """Keep the shapes that inertias were taken from out of each other's way."""
    for body, place in zip(scene.bodies, places, strict=True):
        if body.solids:
            p.setCollisionFilterGroupMask(*place, 0, 0, physicsClientId=client)


def _form(solid: Solid, file: str) -> str:
    sizes = [repr(float(size)) for size in solid.sizes]
    if solid.form == "sphere":
        return f'<sphere radius="{sizes[0]}"/>'
    if solid.form == "box":
        return f'<box size="{" ".join(sizes)}"/>'
    if solid.form == "mesh":
        return f'<mesh filename="{file}"/>'
    return f'<{solid.form} radius="{sizes[0]}" length="{sizes[1]}"/>'


def _file(number: int, index: int) -> str:
    return f"mesh_{number}_{index}.obj"


def _obj(solid: Solid) -> str:
    corners = [f"v {' '.join(repr(float(x)) for x in vertex)}" for vertex in solid.vertices]
    return "\n".join([*corners, *(f"f {a + 1} {b + 1} {c + 1}" for a, b, c in solid.faces), ""])
