"""The text of a MuJoCo model with every digit, which MuJoCo's own writer cuts to six."""

from collections.abc import Iterable
from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np


def mjcf(spec: Any, integrator: str, switched_off: Iterable[str]) -> str:
    """MJCF of the bodies, joints, contacts and options of an ``MjSpec``; MuJoCo reads the same bits back."""
    root = Element("mujoco", model=spec.modelname)
    option = spec.option
    element = SubElement(
        root,
        "option",
        timestep=_digits(option.timestep),
        gravity=_digits(option.gravity),
        integrator=integrator,
    )
    SubElement(element, "flag", dict.fromkeys(switched_off, "disable"))
    _add_meshes(root, spec.meshes)
    world = SubElement(root, "worldbody")
    _add_geoms(world, spec.worldbody)
    for body in spec.worldbody.bodies:
        _add_body(world, body)
    if spec.pairs:
        element.set("cone", "elliptic")  # as mujoco_contact sets it; MjSpec tells only a number
        element.set("impratio", _digits(option.impratio))
        element.set("tolerance", _digits(option.tolerance))
        _add_pairs(SubElement(root, "contact"), spec.pairs)
    indent(root)
    return tostring(root, encoding="unicode") + "\n"


def _add_body(parent: Element, body: Any) -> None:
    simple = "auto" if body.simple else "false"
    element = SubElement(
        parent, "body", name=body.name, pos=_digits(body.pos), quat=_digits(body.quat), simple=simple
    )
    if body.explicitinertial:
        SubElement(
            element,
            "inertial",
            pos=_digits(body.ipos),
            quat=_digits(body.iquat),
            mass=_digits(body.mass),
            diaginertia=_digits(body.inertia),
        )
    for joint in body.joints:
        _add_joint(element, joint)
    _add_geoms(element, body)
    for child in body.bodies:
        _add_body(element, child)


def _add_joint(parent: Element, joint: Any) -> None:
    kind = joint.type.name.removeprefix("mjJNT_").lower()
    element = SubElement(parent, "joint", name=joint.name, type=kind)
    if kind in ("hinge", "slide"):
        element.set("axis", _digits(joint.axis))
        element.set("stiffness", _digits(joint.stiffness))
        element.set("damping", _digits(joint.damping))


def _add_geoms(parent: Element, body: Any) -> None:
    for geom in body.geoms:
        element = SubElement(
            parent,
            "geom",
            name=geom.name,
            type=geom.type.name.removeprefix("mjGEOM_").lower(),
            size=_digits(geom.size),
            pos=_digits(geom.pos),
            quat=_digits(geom.quat),
            contype="0",
            conaffinity="0",
        )
        if body.explicitinertial or body.name == "world":
            continue
        element.set("group", str(geom.group))
        element.set("density", _digits(geom.density))
        if geom.typeinertia.name.endswith("SHELL"):
            element.set("shellinertia", "true")
        if geom.meshname:
            element.set("mesh", geom.meshname)


def _add_meshes(root: Element, meshes: Iterable[Any]) -> None:
    for mesh in meshes:
        asset = root.find("asset")
        SubElement(
            SubElement(root, "asset") if asset is None else asset,
            "mesh",
            name=mesh.name,
            inertia=mesh.inertia.name.removeprefix("mjMESH_INERTIA_").lower(),
            vertex=_digits(mesh.uservert),
            face=" ".join(str(number) for number in mesh.userface),
        )


def _add_pairs(parent: Element, pairs: Iterable[Any]) -> None:
    for pair in pairs:
        SubElement(
            parent,
            "pair",
            name=pair.name,
            geom1=pair.geomname1,
            geom2=pair.geomname2,
            condim=str(pair.condim),
            friction=_digits(pair.friction),
            solref=_digits(pair.solref),
            solreffriction=_digits(pair.solreffriction),
            solimp=_digits(pair.solimp),
        )


def _digits(value: Any) -> str:
    return " ".join(repr(float(x)) for x in np.atleast_1d(value))
