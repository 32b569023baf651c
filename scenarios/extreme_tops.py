"""Free bodies at their extremes: spun fast, thin or flat, all but symmetric, all but steady."""

from dataclasses import replace

from ..reference import top_schemes, torque_free, wobble
from . import free_body, middle_axis, observables
from .body import Body, Joint, diagonal
from .scene import Scene

ATTITUDE = (0.1, 0.7, -0.1, 0.7)
#: What each scheme does with the gyroscopic torque of a free body that carries no other, by twin.
SCHEMES: dict[str, top_schemes.Gyroscopic] = {
    "semi-implicit Euler": "explicit",
    "implicit gyroscopic": "implicit",
    "implicitfast": "implicit",
    "discrete": "implicit",
    "RKMK4": "rk4",
}


def _stable_step(scene: Scene, twin: str) -> float | None:
    if twin not in SCHEMES:
        return None
    (I1, _, _), _, (_, _, I3) = scene.bodies[0].inertia
    return top_schemes.largest_stable_step(SCHEMES[twin], I1, I3, scene.v0[5])


def _spun(name: str, value: float, moments: tuple[float, float, float], omega3: float) -> Scene:
    """Spun at ``omega3`` [rad/s], and as fast across, for about five turns of ω in the body."""
    I1, _, I3 = moments
    rate = abs(torque_free.body_cone_rate(I1, I3, omega3))
    return Scene(
        name=name,
        variant=f"{value:g}",
        summary="A free body spun about an axis far from its own.",
        source="Landau & Lifshitz, Mechanics, §§ 33, 36, 37",
        bodies=(Body("top", 1.0, diagonal(*moments), (Joint("free", "free"),)),),
        q0=(0.0, 0.0, 0.0, *ATTITUDE),
        v0=(0.0, 0.0, 0.0, 0.8 * omega3, 0.6 * omega3, omega3),
        duration=32 / rate,
        samples=32,
        # The explicit scheme gains 1 + z² a step, which at z = 0.3 a trial of 200 steps sees well.
        dt=0.3 / rate,
        truth=free_body.truth,
        stable_step=_stable_step,
        observables=(observables.orientation(), observables.omega(), observables.energy()),
    )


def spin(omega3: float) -> Scene:
    """A plate, I3 = 2 I1, spun at ``omega3`` [rad/s]."""
    return _spun("spin", omega3, (0.01, 0.01, 0.02), omega3)


def inertia_ratio(ratio: float) -> Scene:
    """From a needle to a plate, I3 = ``ratio`` I1; raises ``InputError`` beyond 2, which no body has."""
    return _spun("inertia_ratio", ratio, (0.01, 0.01, ratio * 0.01), 10.0)


def near_symmetric(difference: float) -> Scene:
    """Moments that differ by a part ``difference``, up to 1e-3: to that, theory is a symmetric body's."""
    return _spun("near_symmetric", difference, (0.01, 0.01 * (1 + difference), 0.015), 10.0)


def near_separatrix(deviation: float) -> Scene:
    """Spun about the middle axis but for ``deviation``, until it has flipped once and half again."""
    across = middle_axis.SPIN * deviation
    omega = (middle_axis.SPIN, 0.8 * across, -0.6 * across)
    # Between two flips of the way there lies half a period; the start is all but in the middle of it.
    return replace(
        middle_axis.SCENES[0],
        name="near_separatrix",
        variant=f"{deviation:g}",
        v0=(*middle_axis.VELOCITY, *omega),
        duration=0.5 * wobble.flip_period(middle_axis.MOMENTS, omega),
        observables=(observables.orientation(), observables.omega(), observables.energy()),
        errors={},
    )
