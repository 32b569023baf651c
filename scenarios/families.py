"""Families of scenes with a parameter that is swept to its extremes, each with the steps to try it at."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from ..reference.errors import InputError
from ..reference.spelling import nearest
from .extreme_chains import heavy_inside, heavy_outside
from .extreme_damper import stiff_damper
from .extreme_gimbal import near_gimbal_lock
from .extreme_tops import inertia_ratio, near_separatrix, near_symmetric, spin
from .scene import Scene
from .stiff_spring import on_spring


@dataclass(frozen=True)
class Family:
    """``scene(value)``, called ``name[value]``, for each of ``values``, to be run at each of ``steps`` [s].

    ``parameter`` says what is swept, with its unit. ``law`` says in a sentence where theory draws the line,
    or why it draws none. A run is cut short after ``most`` steps: at the smallest ones it is then shorter
    than its scene.
    """

    name: str
    summary: str
    parameter: str
    values: tuple[float, ...]
    steps: tuple[float, ...]
    scene: Callable[[float], Scene]
    law: str
    most: int = 4000


def _decades(first: int, last: int, each: int = 1) -> tuple[float, ...]:
    """Powers of ten from 10**first to 10**last, so many a decade."""
    return tuple(float(f"{10 ** (k / each):.3g}") for k in range(first * each, last * each + 1))


def _on_spring(stiffness: float) -> Scene:
    return replace(on_spring(stiffness), variant=f"{stiffness:g}")


_OSCILLATOR = (
    "Semi-implicit Euler holds up to ωdt = 2, Runge-Kutta up to 2√2, an implicit scheme at any step."
)
_TOP = (
    "Taken explicitly, the gyroscopic torque lets the energy grow at any step; taken implicitly, at none; "
    "Runge-Kutta holds up to Ω_b dt = 2√2."
)
FAMILIES = (
    Family(
        "stiff_spring",
        "A mass of 1 kg on ever stiffer springs.",
        "k [N/m]",
        _decades(2, 10),
        _decades(-6, 0, 2),
        _on_spring,
        _OSCILLATOR,
    ),
    Family(
        "stiff_damper",
        "A mass of 1 kg thrown into ever stiffer dampers.",
        "c [N s/m]",
        _decades(1, 8),
        _decades(-8, 1, 2),
        stiff_damper,
        "A damper taken explicitly lets the velocity grow past c dt/m = 2, Runge-Kutta past 2.785; taken "
        "implicitly, at no step.",
    ),
    Family(
        "heavy_outside",
        "Two masses on springs of 1e4 N/m: 1 kg next to the wall, a heavier one beyond it.",
        "ratio of masses",
        _decades(0, 8),
        _decades(-4, 0, 3),
        heavy_outside,
        _OSCILLATOR,
    ),
    Family(
        "heavy_inside",
        "Two masses on springs of 1e4 N/m: the heavier one next to the wall, 1 kg beyond it.",
        "ratio of masses",
        _decades(0, 8),
        _decades(-4, 0, 3),
        heavy_inside,
        _OSCILLATOR,
    ),
    Family(
        "spin",
        "A free plate, I3 = 2 I1, spun faster and faster, as fast across its axis as about it.",
        "ω3 [rad/s]",
        _decades(1, 5, 2),
        _decades(-7, 0, 2),
        spin,
        _TOP,
    ),
    Family(
        "inertia_ratio",
        "Free bodies from a needle to a plate, spun at 10 rad/s as fast across their axis as about it.",
        "I3/I1",
        (1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 1.5, 2.0),
        _decades(-4, 1, 3),
        inertia_ratio,
        _TOP,
    ),
    Family(
        "near_symmetric",
        "Free bodies two of whose moments are ever more nearly equal, spun at 10 rad/s.",
        "(I2 − I1)/I1",
        (1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3),
        _decades(-4, 1, 3),
        near_symmetric,
        _TOP,
    ),
    Family(
        "near_separatrix",
        "A free body spun about its middle axis but for a deviation, until it has flipped.",
        "deviation",
        (1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2),
        _decades(-3, 0, 3),
        near_separatrix,
        "Theory gives no largest step where the motion is not linear.",
        most=20_000,
    ),
    Family(
        "near_gimbal_lock",
        "A body in a gimbal of three hinges whose axis passes gimbal lock at 1 rad/s, ever nearer.",
        "distance [rad]",
        (1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1),
        _decades(-4, -1, 3),
        near_gimbal_lock,
        "Theory gives no largest step; steps of less than the distance, at 1 rad/s, meet what is singular. "
        "Larger ones pass it unseen, but for those of 1e-3 and 1e-4 s: they end in it.",
        most=20_000,
    ),
)


def select(names: list[str]) -> list[Family]:
    """The families of these names, all of them for none; raises ``InputError`` for a name that none has."""
    known = {family.name: family for family in FAMILIES}
    for name in names:
        if name not in known:
            raise InputError(f"family: got {name!r}; {nearest(name, known)}")
    return [known[name] for name in dict.fromkeys(names)] if names else list(FAMILIES)
