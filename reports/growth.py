"""How much a small kick grows over a scene: what round-off can be multiplied by."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..reference.checked import Array
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory

KICK = 1e-9


@lru_cache(maxsize=256)
def growth(scene: Scene) -> float:
    """Largest distance from the truth, in units of the kick, that a kick of 1e-9 leads to.

    Each velocity in turn is changed by 1e-9 of the largest one; distances are relative to the size
    of each state observable, the worst of which counts.
    """
    t = scene.sample_times()
    truth = scene.truth(scene, t)
    size = max(float(np.max(np.abs(scene.v0))), _speed(truth)) or 1.0
    return max(_departure(scene, t, truth, place, KICK * size) for place in range(len(scene.v0)))


def _departure(scene: Scene, t: Array, truth: Trajectory, place: int, kick: float) -> float:
    v0 = list(scene.v0)
    v0[place] += kick
    kicked = scene.truth(replace(scene, v0=tuple(v0)), t)
    states = (observable for observable in scene.observables if observable.kind == "state")
    return max(
        float(np.max(state.distance(scene, kicked, truth))) / (state.scale(scene, truth) or 1.0) / KICK
        for state in states
    )


def _speed(truth: Trajectory) -> float:
    return float(np.max(np.abs(truth.joint_velocity), initial=0.0))
