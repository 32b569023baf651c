"""Bodies made of solids, whose mass and inertia Coal, Pinocchio's library of shapes, works out."""

from typing import Any

import numpy as np

from ..scenarios.body import Body
from ..scenarios.solid import Solid

#: Why no scheme of Pinocchio's carries a shell.
NO_SHELL = {"shell": "Pinocchio and Coal work out inertias of what is filled; they have no shell"}


def inertia(pin: Any, body: Body) -> Any:
    """The body's inertia as Pinocchio keeps it: told by the scene, or the sum of what its solids have."""
    if not body.solids:
        return pin.Inertia(body.mass, np.array(body.center_of_mass), body.inertia_array)
    total = pin.Inertia.Zero()
    for solid in body.solids:
        turn = pin.Quaternion(*np.roll(solid.quaternion, 1)).normalized()
        part = pin.SE3(turn, np.array(solid.position)).act(_alone(pin, solid))
        total = total - part if solid.taken_away else total + part
    return total


def _alone(pin: Any, solid: Solid) -> Any:
    """A solid's inertia in its own axes, of what Coal says a density of 1 has."""
    shape = _SHAPES[solid.form](pin.coal, solid)
    about_centre = solid.density * shape.computeMomentofInertiaRelatedToCOM()
    return pin.Inertia(solid.density * shape.computeVolume(), shape.computeCOM(), about_centre)


def _mesh(coal: Any, solid: Solid) -> Any:
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(solid.faces), len(solid.vertices))
    mesh.addVertices(np.array(solid.vertices))
    mesh.addTriangles(np.array(solid.faces))
    mesh.endModel()
    return mesh


_SHAPES: dict[str, Any] = {
    "sphere": lambda coal, solid: coal.Sphere(*solid.sizes),
    "box": lambda coal, solid: coal.Box(*solid.sizes),
    "cylinder": lambda coal, solid: coal.Cylinder(*solid.sizes),
    "capsule": lambda coal, solid: coal.Capsule(*solid.sizes),
    "ellipsoid": lambda coal, solid: coal.Ellipsoid(*solid.sizes),
    "mesh": _mesh,
}
