"""What an engine's model of a scene may hold, counted: no more than the scene names, and no less."""

from .scene import Scene

#: The parts that an engine counts in the model it has built, each in words.
PARTS: dict[str, str] = {
    "bodies": "bodies that weigh something",
    "joints": "joints that move",
    "coordinates": "velocities that the engine steps",
    "shapes": "shapes that can touch",
    "solids": "shapes that masses and inertias are worked out from",
    "pairs": "pairs of shapes that the engine may let touch",
    "contact solver": "1 where contacts or constraints are solved for",
    "constraints": "constraints beside joints",
    "actuators": "actuators, and motors that push",
    "sensors": "sensors",
    "sleeping": "1 where bodies may be put to sleep",
    "pictures": "shapes, lights and cameras that are only looked at, and windows",
    "others": "everything else",
}

#: In front of a part's name among the settings that an engine reads back.
BUILT = "built/"


def parts(scene: Scene) -> dict[str, int]:
    """How many of each of ``PARTS`` a model of ``scene`` holds, if it holds nothing that is not needed."""
    shapes = {(c.first, c.shape) for c in scene.contacts} | {(c.second, c.against) for c in scene.contacts}
    return dict.fromkeys(PARTS, 0) | {
        "bodies": len(scene.bodies),
        "joints": len(scene.joints),
        "coordinates": len(scene.v0),
        "shapes": len(shapes),
        "solids": sum(len(body.solids) for body in scene.bodies),
        "pairs": len(scene.contacts),
        "contact solver": int(bool(scene.contacts)),
    }
