"""What a wrong engine is: its fault in words and in size, the class, and where which checks see it."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
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


class Feigning(Lying):
    """Tells of accelerations, too, those of what it was asked for: only its motion gives it away."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._feigned = self.right()
        self._feigned.build(scene, scheme, dt)

    def right(self):
        """The engine that this is a wrong one of."""
        return next(kind for kind in type(self).__mro__ if kind.__module__.startswith("poinsot."))()

    def acceleration(self, q, v):
        return self._feigned.acceleration(q, v)

    def close(self):
        if "_feigned" in vars(self):
            self._feigned.close()
        super().close()


def building(mistake: Callable[[Scene], Scene], base: type[Any], lie: type[Any] = Lying) -> type[Any]:
    """An engine that builds what ``mistake`` makes of a scene."""
    return type("Building", (lie, base), {"mistaken": lambda self, scene: mistake(scene)})


def first_body(scene: Scene, **changed: Any) -> Scene:
    """The scene with its first body changed."""
    return replace(scene, bodies=(replace(scene.bodies[0], **changed), *scene.bodies[1:]))


@dataclass(frozen=True)
class Family:
    """One fault that may have any size: ``of_size`` makes the engine that has it.

    ``what`` the size is of, with its unit unless it is a part of the right value. ``sight`` is where it is
    cheapest to see; ``largest`` a size that the engine still builds.
    """

    what: str
    of_size: Callable[[float], type[Any]]
    sight: Sight
    largest: float = 1e-2

    def sizes(self, kind: str, names: Mapping[float, tuple[str, str]]) -> tuple["Wrong", ...]:
        """The fault in several sizes, each by its name and the pattern of what should be said of it."""
        return tuple(
            Wrong(name, kind, self.of_size(size), (self.sight,), size, located, self)
            for size, (name, located) in names.items()
        )


@dataclass(frozen=True)
class Wrong:
    """An engine that is wrong in one known way.

    ``name`` says the fault in words, ``kind`` what it is a fault of, ``size`` how large it is if it has a
    size: a part of the right value, unless its ``family`` names a unit.
    ``located`` is a pattern that the sentence of `poinsot.reports.localisation` should match; empty if
    none is expected. An engine that ``lies`` repeats as its setup what the scene asks for.
    """

    name: str
    kind: str
    engine: type[Any]
    sights: tuple[Sight, ...]
    size: float | None = None
    located: str = ""
    family: Family | None = None

    @property
    def lies(self) -> bool:
        """Whether its setup reads as if nothing were wrong."""
        return issubclass(self.engine, Lying)


def alone(scene: str, twin: str, *red: str, says: str = "") -> Sight:
    """Where an engine is seen with no other beside it, by these checks at least."""
    return Sight(scene, twin, red, red[0] if says else "", says, near=None, beside=False)


def state(*names: str) -> set[str]:
    """All checks that look at these parts of the state."""
    return {kind.format(name) for name in names for kind in ("truth {}", "order {}", "truth {}, limit")}


LIMITS = {"truth orientation, limit", "truth omega, limit"}
TURNING, RATES = state("orientation", "omega"), {"truth precession", "truth nutation"}
ENERGY, MOMENTUM, TWIN = {"invariant energy"}, {"invariant angular momentum"}, {"twin state"}
ON_JOINTS = {"invariant bodies on their joints"}
P_ALPHA, P_GAMMA, SPIN = {"invariant p_alpha"}, {"invariant p_gamma"}, {"truth Omega_b"}
MODES = {f"truth frequency of the {mode} mode" for mode in ("symmetric", "antisymmetric")}
OWN = {"truth position, scheme's own", "truth velocity, scheme's own"}
