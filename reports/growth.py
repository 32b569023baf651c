"""How much a small kick grows over a scene: what round-off can be multiplied by."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..scenarios import equations
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory

KICK = 1e-9
#: Where the motion has to be integrated, to about 1e-7.
LARGER_KICK = 1e-4


@lru_cache(maxsize=256)
def growth(scene: Scene) -> float:
    """Largest distance from the truth, in units of the kick, that a kick of 1e-9 leads to.

    Each velocity in turn is changed by 1e-9 of the largest one; distances are relative to the size
    of each state observable, the worst of which counts.
    """
    t = scene.sample_times()
    truth = scene.truth(scene, t)
    size = max(float(np.max(np.abs(scene.v0))), _speed(truth)) or 1.0
    kicks = np.eye(len(scene.v0)) * size
    of_truth = [scene.truth(replace(scene, v0=tuple((scene.v0 + KICK * kick).tolist())), t) for kick in kicks]
    found = max(_departure(scene, kicked, truth) / KICK for kicked in of_truth)
    if found:
        return found
    # A truth that knows one motion alone, as of what hangs at rest, takes no notice of a kick.
    starts = scene.v0 + LARGER_KICK * np.vstack([np.zeros(len(kicks)), kicks])
    free, *integrated = equations.motions(scene, starts, t)
    return max(_departure(scene, kicked, free) / LARGER_KICK for kicked in integrated)


def _departure(scene: Scene, kicked: Trajectory, truth: Trajectory) -> float:
    """Largest distance in any state observable, relative to its size."""
    return max(
        float(np.max(state.distance(scene, kicked, truth))) / (state.scale(scene, truth) or 1.0)
        for state in scene.observables
        if state.kind == "state"
    )


def _speed(truth: Trajectory) -> float:
    return float(np.max(np.abs(truth.joint_velocity), initial=0.0))
