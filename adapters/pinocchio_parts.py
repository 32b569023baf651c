"""What a Pinocchio model holds, counted. It has no place for shapes, pictures or sleep; contacts are ours."""

from typing import Any

import numpy as np

from ..scenarios.parts import BUILT


def built(pin: Any, model: Any, contacts: Any) -> dict[str, int]:
    """Parts of ``model`` by the names of ``scenarios.parts``, each with ``built/`` in front.

    ``contacts`` is the solver of contacts that steps are given to, or ``None``.
    """
    pairs = [contact for contact, *_ in contacts.pairs] if contacts else []
    shapes = {(c.first, c.shape) for c in pairs} | {(c.second, c.against) for c in pairs}
    kinds = [frame.type for frame in model.frames]
    # A free body is a translation and then a ball joint: one joint of the scene's.
    translations = sum(nq == nv == 3 for nq, nv in zip(model.nqs, model.nvs, strict=True))
    bodies = [frame for frame in model.frames if frame.type == pin.FrameType.BODY]
    rotors = (getattr(model, name, ()) for name in ("armature", "rotorInertia", "friction", "damping"))
    own = (pin.FrameType.BODY, pin.FrameType.SENSOR)
    found = {
        "bodies": sum(frame.inertia.mass > 0 for frame in bodies),
        "joints": model.njoints - 1 - translations,
        "coordinates": model.nv,
        "shapes": len(shapes),
        "pairs": len(pairs),
        "contact solver": int(contacts is not None),
        "constraints": len(model.mimicking_joints),
        "actuators": sum(int(np.count_nonzero(part)) for part in rotors),
        "sensors": kinds.count(pin.FrameType.SENSOR),
        # The universe is a frame too.
        "others": sum(kind not in own for kind in kinds) - 1,
    }
    return {BUILT + name: int(count) for name, count in found.items()}
