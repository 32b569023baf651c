"""What a compiled MuJoCo model holds, counted."""

from typing import Any

import numpy as np

from ..scenarios.parts import BUILT
from .mujoco_solids import GROUP

#: Sizes of a model that are no parts of it: room for numbers and names, trees that bodies make up.
_SIZES = {
    "nB", "nC", "nD", "nJmom", "nM", "na", "narena", "nbody", "nbuffer", "nbvh", "nbvhdynamic", "nbvhstatic",
    "nconmax", "nemax", "ngeom", "njmax", "njnt", "nnames", "nnames_map", "nout", "npair", "npaths", "nq",
    "nsensordata", "ntree", "nv",
}  # fmt: skip
_CONSTRAINTS, _ACTUATORS, _SENSORS = {"neq", "ntendon"}, {"nu", "nactuator"}, {"nsensor"}
_PICTURES = {"nlight", "ncam", "nmat", "ntex", "nskin"}


def built(mujoco: Any, model: Any) -> dict[str, int]:
    """Parts of ``model`` by the names of ``scenarios.parts``, each with ``built/`` in front."""
    off, enabled, bit = model.opt.disableflags, model.opt.enableflags, mujoco.mjtDisableBit
    solving = not (off & bit.mjDSBL_CONTACT and off & bit.mjDSBL_CONSTRAINT)
    asleep = getattr(mujoco.mjtEnableBit, "mjENBL_SLEEP", 0)
    sizes = {name: int(getattr(model, name)) for name in dir(model) if _is_size(model, name)}
    found = {
        "bodies": int(np.count_nonzero(model.body_mass)),
        "joints": model.njnt,
        "coordinates": model.nv,
        "shapes": len(_distinct(model)),
        "solids": int(np.count_nonzero(model.geom_group == GROUP)),
        "pairs": model.npair + _may_touch(model),
        "contact solver": int(solving),
        "constraints": _sum(sizes, _CONSTRAINTS) + int(model.jnt_limited.sum()),
        "actuators": max(sizes.get(name, 0) for name in _ACTUATORS),
        "sensors": _sum(sizes, _SENSORS),
        "sleeping": int(bool(enabled & int(asleep))),
        "pictures": _sum(sizes, _PICTURES) + _only_seen(model),
        "others": _others(model, sizes) + int(enabled & ~int(asleep)).bit_count(),
    }
    return {BUILT + name: count for name, count in found.items()}


def _is_size(model: Any, name: str) -> bool:
    return name.startswith("n") and isinstance(getattr(model, name), (int, np.integer))


def _sum(sizes: dict[str, int], names: set[str]) -> int:
    return sum(sizes.get(name, 0) for name in names)


def _distinct(model: Any) -> set[tuple[float, ...]]:
    """Shapes that can touch: where two contacts name the same one, it is there twice."""
    touching = set(np.ravel([model.pair_geom1, model.pair_geom2]).tolist())
    masked = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    rows = [*sorted(touching | set(np.flatnonzero(masked).tolist()))]
    what = np.column_stack([model.geom_bodyid, model.geom_type, model.geom_size, model.geom_pos])
    return {tuple(what[row].tolist()) for row in rows}


def _only_seen(model: Any) -> int:
    """Shapes that take part in no contact and weigh nothing, and meshes that no solid has."""
    masked = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    touching = set(np.ravel([model.pair_geom1, model.pair_geom2]).tolist()) | set(np.flatnonzero(masked))
    solids = model.geom_group == GROUP
    meshes = set(range(model.nmesh)) - set(model.geom_dataid[solids].tolist())
    return len(set(np.flatnonzero(~solids)) - touching) + len(meshes)


def _may_touch(model: Any) -> int:
    """Pairs of shapes of different bodies that their masks let touch."""
    kind, with_, body = model.geom_contype, model.geom_conaffinity, model.geom_bodyid
    meet = (kind[:, None] & with_[None, :]) | (with_[:, None] & kind[None, :])
    return int(np.count_nonzero(np.triu(meet != 0, 1) & (body[:, None] != body[None, :])))


def _others(model: Any, sizes: dict[str, int]) -> int:
    """Kinds of parts that have no name here, rotors and dry friction in joints, a medium all around."""
    meshes = {name for name in sizes if name.startswith("nmesh")}
    named = meshes | _SIZES | _CONSTRAINTS | _ACTUATORS | _SENSORS | _PICTURES
    medium = (model.opt.density, model.opt.viscosity, *model.opt.wind)
    surplus = (model.dof_armature, model.dof_frictionloss, model.body_gravcomp, medium)
    return sum(size > 0 for name, size in sizes.items() if name not in named) + sum(
        int(np.count_nonzero(part)) for part in surplus
    )
