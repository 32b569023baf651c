"""What a viewer draws of a log: where each body is, now and then, and the shapes of each.

Foxglove and Rerun know these messages by name. Nothing here is read back by Poinsot.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory
from . import log_shapes
from .log_primitives import Part
from .log_schema import FrameTransform, SceneUpdate

#: A viewer's frames: up to so many a simulated second, and in a log, and transforms in all.
FRAMES_PER_SECOND, FRAMES, TRANSFORMS = 50, 300, 3000
#: No shape is wider than this makes it [m].
FARTHEST = 1e15
WORLD = "world"
#: Nanoseconds in a second.
NANOS = 1_000_000_000


def frames(t: npt.NDArray[np.float64], bodies: int) -> slice:
    """Which of the samples at ``t`` (n,) [s] a viewer gets: evenly spaced, from the first."""
    wanted = min(FRAMES, TRANSFORMS // bodies, FRAMES_PER_SECOND * (t[-1] - t[0]))
    return slice(None, None, max(1, int(np.ceil((len(t) - 1) / max(1.0, wanted)))))


def transforms(scene: Scene, motion: Trajectory, times: list[int]) -> Iterator[bytes]:
    """Encoded ``foxglove.FrameTransform``: from the world to each body's centre of mass and axes.

    ``times`` [ns] has one entry for each sample of ``motion``, and bodies follow one another.
    """
    placed = np.concatenate([motion.position, motion.quaternion], axis=2).tolist()
    # One message a body, filled anew each time: to make one takes five times as long.
    messages = [FrameTransform(parent_frame_id=WORLD, child_frame_id=body.name) for body in scene.bodies]
    for time, places in zip(times, placed, strict=True):
        seconds, nanos = divmod(time, NANOS)
        for message, numbers in zip(messages, places, strict=True):
            stamp, at, turn = message.timestamp, message.translation, message.rotation
            stamp.seconds, stamp.nanos = seconds, nanos
            at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w = numbers
            yield message.SerializeToString()


def update(scene: Scene, motion: Trajectory, time: int) -> bytes:
    """Encoded ``foxglove.SceneUpdate``: the shapes of each body, fixed to it, and of the world."""
    # A log keeps whatever an engine gave; what is not a place is drawn at the origin.
    places = np.clip(np.nan_to_num(motion.position), -FARTHEST, FARTHEST)
    entities = []
    for place, body in enumerate(scene.bodies):
        words, parts = log_shapes.of_body(scene, place, places)
        told = {"mass": f"{body.mass:g} kg", "drawn as": words}
        entities.append(_entity(body.name, time, parts, told))
    world = log_shapes.of_world(scene, places)
    if world:
        entities.append(_entity(WORLD, time, world, {"drawn as": "planes that are touched"}))
    return bytes(SceneUpdate(entities=entities).SerializeToString())


def _entity(name: str, time: int, parts: Sequence[Part], told: Mapping[str, str]) -> dict[str, Any]:
    fields: dict[str, Any] = {}
    for field, part in parts:
        fields.setdefault(field, []).append(part)
    return {
        "timestamp": _timestamp(time),
        "frame_id": name,
        "id": name,
        "frame_locked": True,
        "metadata": [{"key": key, "value": value} for key, value in told.items()],
        **fields,
    }


def _timestamp(time: int) -> dict[str, int]:
    seconds, nanos = divmod(time, NANOS)
    return {"seconds": seconds, "nanos": nanos}
