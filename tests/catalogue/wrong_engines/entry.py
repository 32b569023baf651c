"""What a wrong engine is: its fault in words and in size, the class, and where which checks see it."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any

from poinsot.adapters.engine import Setup
from poinsot.reports import setup
from poinsot.scenarios.scene import Scene

SE, RK, IMPLICIT, DISCRETE = "semi-implicit Euler", "RKMK4", "implicit gyroscopic", "discrete"
TOP, FAST = "heavy_top[moderate]", "heavy_top[fast]"
FREE, TUMBLING = "free_symmetric_top[oblate]", "free_asymmetric_top[general]"
CHAIN, PENDULUM = "co2_chain[mixture]", "large_pendulum[swing]"

#: Fails where an engine's equations are wrong; where only its integration or its telling is, it passes.
EQUATIONS = "acceleration equations of motion"


@dataclass(frozen=True)
class Sight:
    """A scene and a scheme (by its twin name) in which a wrong engine is seen, and what fails there.

    ``red`` are the checks that fail, each as ``"kind observable"``; those ``near`` their limit may fail
    or pass, and all others pass; ``None`` for ``near`` asks nothing of the others. The message of
    ``check`` matches ``says``. ``beside``: judged with the right engines that have the scheme.
    """

    scene: str
    twin: str
    red: Collection[str]
    check: str = ""
    says: str = ""
    near: Collection[str] | None = ()
    beside: bool = True


@dataclass(frozen=True)
class Wrong:
    """An engine that is wrong in one known way.

    ``name`` says the fault in words, ``kind`` what it is a fault of, ``size`` how large it is if it has a
    size (a part of the right value, unless the name gives a unit); ``of_size`` makes the same fault of
    another size.
    ``located`` is a pattern that the sentence of `poinsot.reports.localisation` should match; empty if
    none is expected. An engine that ``lies`` repeats as its setup what the scene asks for.
    """

    name: str
    kind: str
    engine: type[Any]
    sights: tuple[Sight, ...]
    size: float | None = None
    located: str = ""
    of_size: Callable[[float], type[Any]] | None = None

    @property
    def lies(self) -> bool:
        """Whether its setup reads as if nothing were wrong."""
        return issubclass(self.engine, Lying)


class Lying:
    """Builds something else than it was asked for, and says that it did not."""

    def build(self, scene, scheme, dt):
        self._asked = scene, dt
        super().build(self.mistaken(scene), scheme, dt)

    def mistaken(self, scene: Scene) -> Scene:
        """The scene that is built in place of the one asked for."""
        return scene

    def readback(self):
        return Setup(setup.expected(*self._asked))


def sized(
    kind: str,
    names: Mapping[float, str],
    of_size: Callable[[float], type[Any]],
    sights: tuple[Sight, ...],
    located: str = "",
) -> tuple[Wrong, ...]:
    """One fault in several sizes, each with its name."""
    return tuple(
        Wrong(name, kind, of_size(size), sights, size, located, of_size) for size, name in names.items()
    )


def state(*names: str) -> set[str]:
    """All checks that look at these parts of the state."""
    return {kind.format(name) for name in names for kind in ("truth {}", "order {}", "truth {}, limit")}


LIMITS = {"truth orientation, limit", "truth omega, limit"}
TURNING, RATES = state("orientation", "omega"), {"truth precession", "truth nutation"}
ENERGY, MOMENTUM, TWIN = {"invariant energy"}, {"invariant angular momentum"}, {"twin state"}
P_ALPHA, P_GAMMA, SPIN = {"invariant p_alpha"}, {"invariant p_gamma"}, {"truth Omega_b"}
MODES = {f"truth frequency of the {mode} mode" for mode in ("symmetric", "antisymmetric")}
OWN = {"truth position, scheme's own", "truth velocity, scheme's own"}
