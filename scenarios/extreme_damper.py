"""A mass on a damper so stiff that it stops in far less than a step: which schemes take dampers implicitly.

Catches an engine that says it does and does not, and one that does and says nothing.
"""

import numpy as np

from ..reference import scheme_stability, schemes
from ..reference.checked import Array
from . import observables
from .body import Body, Joint, diagonal
from .scene import Scene
from .trajectory import Trajectory, of_one_body

MASS, REACH = 1.0, 1e-2
#: What each scheme does with a damper in a joint, by twin.
SCHEMES: dict[str, schemes.Scheme] = {
    "semi-implicit Euler": "semi_implicit_euler",
    "implicit gyroscopic": "implicit_damping",
    "implicitfast": "implicit_damping",
    "discrete": "implicit_damping",
    "RKMK4": "rk4",
}


def _rate(scene: Scene) -> float:
    return scene.joints[0].damping / scene.bodies[0].mass


def _truth(scene: Scene, t: Array) -> Trajectory:
    """V = v0 exp(−ct/m), and what it adds up to."""
    rate, nothing = _rate(scene), np.zeros(len(t))
    speed = scene.v0[0] * np.exp(-rate * t)
    x = scene.q0[0] - scene.v0[0] * np.expm1(-rate * t) / rate
    along = [np.column_stack([part, nothing, nothing]) for part in (x, speed)]
    upright = np.tile([0.0, 0.0, 0.0, 1.0], (len(t), 1))
    motion = of_one_body(t, along[0], upright, along[1], np.zeros((len(t), 3)))
    return Trajectory(
        t, motion.position, motion.quaternion, motion.velocity, motion.omega, x[:, None], speed[:, None]
    )


def _stable_step(scene: Scene, twin: str) -> float | None:
    if twin not in SCHEMES:
        return None
    return scheme_stability.largest_decaying_step(SCHEMES[twin], _rate(scene))


def stiff_damper(damping: float) -> Scene:
    """1 kg thrown into a damper [N s/m], to come to rest after a centimetre; run for 32 of its own times."""
    rate = damping / MASS
    slide = Joint("damper", "slide", (1.0, 0.0, 0.0), damping=damping)
    return Scene(
        name="stiff_damper",
        variant=f"{damping:g}",
        summary=f"A mass thrown into a damper of {damping:g} N s/m.",
        source="Hairer & Wanner, Solving Ordinary Differential Equations II, § IV.2",
        bodies=(Body("mass", MASS, diagonal(1.0, 1.0, 1.0), (slide,)),),
        # Not from zero, where an engine that resets itself would put it: a damper can stop it at once too.
        q0=(-REACH / 2,),
        v0=(REACH * rate,),
        duration=32 / rate,
        samples=32,
        dt=0.1 / rate,
        truth=_truth,
        stable_step=_stable_step,
        observables=(observables.position(), observables.velocity()),
    )
