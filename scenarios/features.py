"""What a scene may ask of an engine, what this one asks, and what its model is therefore built without."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .blows import Blow
from .contact import Rim

if TYPE_CHECKING:
    from .scene import Scene

#: Everything a scene may ask of an engine; what it does not name is left out of the model.
FEATURES: dict[str, str] = {
    "free": "a body that moves freely",
    "ball": "ball joints",
    "hinge": "hinges",
    "slide": "sliding joints",
    "weld": "a body welded to its parent",
    "tree": "several bodies joined to each other",
    "gravity": "gravity",
    "spring": "springs in joints",
    "damper": "dampers in joints",
    "contact": "contact",
    "friction": "friction in contacts",
    "rim": "contact on the rim of a disc",
    "force": "forces that depend on where bodies are or how fast",
    "blow": "forces that act for a while",
    "burning": "masses that fall while a scene runs",
    "reaction": "reactions of joints",
    "solid": "masses and inertias that the engine works out from shapes",
    "ellipsoid": "solid ellipsoids",
    "shell": "hollow spheres that are all surface",
    "hollow": "solids with a hollow",
}

#: Features that only have a meaning beside another: not told of as left out where that one is.
DETAILS: dict[str, str] = {
    "blow": "force", "friction": "contact", "rim": "contact",
    "ellipsoid": "solid", "shell": "solid", "hollow": "solid",
}  # fmt: skip

#: What no scene gets unless a later feature names it, in words for the report.
NEVER_BUILT = ("collision shapes", "contact solver", "actuators", "sensors", "renderer", "ground")


def needed(scene: Scene) -> frozenset[str]:
    """What an engine must have to build ``scene``: keys of ``FEATURES``."""
    found = {joint.kind for joint in scene.joints}
    solids = [solid for body in scene.bodies for solid in body.solids]
    optional = {
        "weld": any(not body.joints for body in scene.bodies),
        "tree": any(body.parent for body in scene.bodies),
        "gravity": any(scene.gravity),
        "spring": any(joint.stiffness for joint in scene.joints),
        "damper": any(joint.damping for joint in scene.joints),
        "contact": bool(scene.contacts),
        "friction": any(contact.friction for contact in scene.contacts),
        "rim": any(isinstance(contact.shape, Rim) for contact in scene.contacts),
        "force": bool(scene.forces),
        "blow": any(isinstance(force, Blow) for force in scene.forces),
        "burning": bool(scene.burning),
        "reaction": bool(scene.reactions),
        "solid": bool(solids),
        "ellipsoid": any(solid.form == "ellipsoid" for solid in solids),
        "shell": any(solid.form == "shell" for solid in solids),
        "hollow": any(solid.taken_away for solid in solids),
    }
    return frozenset(found | {name for name, present in optional.items() if present})


def left_out(scene: Scene) -> tuple[str, ...]:
    """What an engine's model of ``scene`` does not hold, in words."""
    built = {"collision shapes", "contact solver"} if scene.contacts else set[str]()
    if any(contact.second is None for contact in scene.contacts):
        built.add("ground")
    never = [part for part in NEVER_BUILT if part not in built]
    missing = [name for name in FEATURES if name not in scene.features]
    told = [FEATURES[name] for name in missing if DETAILS.get(name) not in missing]
    return (*told, *never)
