"""Bodies made of solids, whose mass and inertia MuJoCo's compiler works out."""

from typing import Any

import numpy as np

from ..scenarios.body import Body
from ..scenarios.solid import Solid

#: Why no scheme of MuJoCo's carries a solid with a hollow.
NO_HOLLOW = {
    "hollow": "MuJoCo takes nothing away: a density below 0 it refuses ('mass, inertia or density are "
    "negative'), and its only hollow is that of a shell without thickness"
}

#: Marks the geoms that inertias come from, which are there for nothing else.
GROUP = 5


def add_solids(mujoco: Any, spec: Any, added: Any, body: Body) -> None:
    """Give the body ``added`` to a model its solids, as geoms that touch nothing."""
    for number, solid in enumerate(body.solids):
        name = f"{body.name}, solid {number}"
        geom = added.add_geom(name=name, density=solid.density, contype=0, conaffinity=0, group=GROUP)
        x, y, z, w = solid.quaternion
        geom.pos, geom.quat = solid.position, (w, x, y, z)
        form = "sphere" if solid.form == "shell" else solid.form
        geom.type = getattr(mujoco.mjtGeom, f"mjGEOM_{form.upper()}")
        if solid.form == "shell":
            geom.typeinertia = mujoco.mjtGeomInertia.mjINERTIA_SHELL
        if solid.form == "mesh":
            mesh = spec.add_mesh(name=name, uservert=np.ravel(solid.vertices), userface=np.ravel(solid.faces))
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_EXACT
            geom.meshname = name
        else:
            geom.size = _size(solid)


def _size(solid: Solid) -> list[float]:
    """MuJoCo's three numbers: of lengths from end to end it takes the halves."""
    if solid.form == "box":
        return [edge / 2 for edge in solid.sizes]
    if solid.form in ("cylinder", "capsule"):
        return [solid.sizes[0], solid.sizes[1] / 2, 0.0]
    return [*solid.sizes, 0.0, 0.0][:3]
