"""What joints do to the bodies that they hold, looked at: forces, moments, and the size of their rounding."""

import numpy as np

from ..reference.checked import Array
from .observables import Observable
from .scene import Scene
from .trajectory import Trajectory


def force() -> Observable:
    """Forces of the joints on the scene's ``reactions`` bodies, in the bodies' axes."""
    return _part("reaction force", "N", slice(3), 0)


def moment() -> Observable:
    """Moments of the joints about the origins of those bodies' frames, in the bodies' axes."""
    return _part("reaction moment", "N m", slice(3, 6), 1)


def _part(name: str, unit: str, part: slice, arms: int) -> Observable:
    def difference(scene: Scene, a: Trajectory, b: Trajectory) -> Array:
        return np.asarray((a.reaction - b.reaction)[..., part].reshape(len(a.t), -1))

    def scale(scene: Scene, b: Trajectory) -> float:
        exact = float(np.linalg.norm(b.reaction[..., part].reshape(len(b.t), -1), axis=1).max())
        return exact + float(np.sum([_cancelled(scene, name, b, arms) for name in scene.reactions]))

    return Observable(name, unit, "state", difference, scale)


def _cancelled(scene: Scene, name: str, b: Trajectory, arms: int) -> float:
    """Weight and centrifugal forces of a body's parts, or their moments: these cancel in balance."""
    (place,) = (i for i, body in enumerate(scene.bodies) if body.name == name)
    body = scene.bodies[place]
    spread = np.trace(body.inertia_array) / (2 * body.mass) + np.square(body.center_of_mass).sum()
    reach, fastest = np.sqrt(spread), np.square(b.omega[:, place]).sum(axis=1).max()
    pull = np.linalg.norm(scene.gravity) + fastest * reach
    return float(body.mass * pull * reach**arms)
