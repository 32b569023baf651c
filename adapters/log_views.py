"""What a viewer draws of a log: where each body is, now and then, and a box for each.

Foxglove and Rerun know these messages by name. Nothing here is read back by Poinsot.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

from ..scenarios.body import Body
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory
from .log_schema import FrameTransform, SceneUpdate

#: A viewer's frames: up to so many a simulated second, and in a log, and transforms in all.
FRAMES_PER_SECOND, FRAMES, TRANSFORMS = 50, 300, 3000
#: A plate has no thickness and would not be seen: no edge is thinner than this part of the longest.
THINNEST = 0.02
WORLD = "world"
_COLORS = ((0.13, 0.40, 0.67), (0.84, 0.38, 0.20), (0.20, 0.58, 0.38), (0.55, 0.34, 0.64))


def frames(t: npt.NDArray[np.float64], bodies: int) -> slice:
    """Which of the samples at ``t`` (n,) [s] a viewer gets: evenly spaced, from the first."""
    wanted = min(FRAMES, TRANSFORMS // bodies, FRAMES_PER_SECOND * (t[-1] - t[0]))
    return slice(None, None, max(1, int(np.ceil((len(t) - 1) / max(1.0, wanted)))))


def transforms(scene: Scene, motion: Trajectory, times: list[int]) -> Iterator[bytes]:
    """Encoded ``foxglove.FrameTransform``: from the world to each body's centre of mass and axes.

    ``times`` [ns] has one entry for each sample of ``motion``, and bodies follow one another.
    """
    for time, positions, quaternions in zip(times, motion.position, motion.quaternion, strict=True):
        for body, position, quaternion in zip(scene.bodies, positions, quaternions, strict=True):
            message = FrameTransform(
                timestamp=_timestamp(time),
                parent_frame_id=WORLD,
                child_frame_id=body.name,
                translation=_xyz(position),
                rotation=_xyz(quaternion),
            )
            yield message.SerializeToString()


def boxes(scene: Scene, time: int) -> bytes:
    """Encoded ``foxglove.SceneUpdate``: a box of the mass and inertia of each body, fixed to it."""
    entities = [
        {
            "timestamp": _timestamp(time),
            "frame_id": body.name,
            "id": body.name,
            "frame_locked": True,
            "cubes": [_cube(body, _COLORS[place % len(_COLORS)])],
        }
        for place, body in enumerate(scene.bodies)
    ]
    return bytes(SceneUpdate(entities=entities).SerializeToString())


def _cube(body: Body, color: tuple[float, float, float]) -> dict[str, Any]:
    moments, axes = np.linalg.eigh(body.inertia_array)
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    # A solid box with edges a, b, c has the moment m (b² + c²)/12 about the axis along a, and so on.
    edges = np.sqrt(np.maximum(6 * (moments.sum() - 2 * moments) / body.mass, 0.0))
    return {
        "pose": {"position": {}, "orientation": _xyz(Rotation.from_matrix(axes).as_quat())},
        "size": _xyz(np.maximum(edges, THINNEST * edges.max())),
        "color": dict(zip("rgba", (*color, 1.0), strict=True)),
    }


def _xyz(values: npt.NDArray[np.float64]) -> dict[str, float]:
    return dict(zip("xyzw", values.tolist(), strict=False))


def _timestamp(time: int) -> dict[str, int]:
    seconds, nanos = divmod(time, 1_000_000_000)
    return {"seconds": seconds, "nanos": nanos}
