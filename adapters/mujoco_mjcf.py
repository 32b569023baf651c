"""The text of a MuJoCo model with every digit, which MuJoCo's own writer cuts to six."""

from collections.abc import Iterable
from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np


def mjcf(spec: Any, integrator: str, switched_off: Iterable[str]) -> str:
    """MJCF of the bodies, joints and options of an ``MjSpec``; MuJoCo reads the same bits back."""
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
    world = SubElement(root, "worldbody")
    for body in spec.worldbody.bodies:
        _add_body(world, body)
    indent(root)
    return tostring(root, encoding="unicode") + "\n"


def _add_body(parent: Element, body: Any) -> None:
    simple = "auto" if body.simple else "false"
    element = SubElement(
        parent, "body", name=body.name, pos=_digits(body.pos), quat=_digits(body.quat), simple=simple
    )
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
    for child in body.bodies:
        _add_body(element, child)


def _add_joint(parent: Element, joint: Any) -> None:
    kind = joint.type.name.removeprefix("mjJNT_").lower()
    element = SubElement(parent, "joint", name=joint.name, type=kind)
    if kind in ("hinge", "slide"):
        element.set("axis", _digits(joint.axis))
        element.set("stiffness", _digits(joint.stiffness))
        element.set("damping", _digits(joint.damping))


def _digits(value: Any) -> str:
    return " ".join(repr(float(x)) for x in np.atleast_1d(value))
