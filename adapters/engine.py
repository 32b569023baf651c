"""What an engine must offer: build a scene, step, say where it is, and say how it was set up."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple, Protocol, runtime_checkable

from ..reference.checked import Array
from ..reference.errors import PoinsotError
from ..scenarios.scene import Scene

#: The settings of an engine in a scene that leaves it to its defaults.
AS_IT_COMES = {"in scenes [defaults]": "damping, limits, motors and contacts as the engine comes"}


class EngineError(PoinsotError):
    """The engine broke down while it ran: reset itself, warned, or left the finite numbers.

    ``state`` is where everything was found all the same, for who wants to see what it does then.
    """

    def __init__(self, message: str, state: "State | None" = None) -> None:
        super().__init__(message)
        self.state = state


@dataclass(frozen=True)
class Scheme:
    """An integrator of an engine.

    ``order`` is the declared order of accuracy in attitude; ``twin`` the common name of schemes
    that are the same algorithm, in whatever engine; ``lacks`` the features of its engine that this
    scheme does not support, each with the reason; ``"acceleration"`` where `Engine.acceleration` takes
    so much longer or is so much coarser than rounding that it is not checked.
    """

    name: str
    order: int
    twin: str
    lacks: Mapping[str, str]


class State(NamedTuple):
    """Where ``b`` bodies and ``j`` scalar joints are now; shapes and frames as in ``Trajectory``.

    ``position`` (b, 3), ``quaternion`` (b, 4) scalar last, ``velocity`` (b, 3), ``omega`` (b, 3) in
    body axes, ``joint_position`` (j,), ``joint_velocity`` (j,).
    """

    position: Array
    quaternion: Array
    velocity: Array
    omega: Array
    joint_position: Array
    joint_velocity: Array


class Setup(NamedTuple):
    """What the engine says of its own model after building it.

    ``values`` maps a setting to its value. Of every body: ``body/NAME/mass`` [kg],
    ``body/NAME/center_of_mass`` (3,) [m] and ``body/NAME/inertia`` (3, 3) [kg m²] about it, both in
    the scene's body axes; of every hinge and slide ``joint/NAME/stiffness`` and
    ``joint/NAME/damping``; of every contact ``contact/NAME/friction`` and
    ``contact/NAME/restitution``; of the world ``gravity`` (3,) [m/s²], ``dt`` [s], ``velocity_limit``
    (inf: none), ``linear_damping`` and ``angular_damping`` [1/s]. Where an engine counts what its
    model holds, ``built/PART`` for the parts of ``scenarios.parts``.
    ``probed`` names the settings that cannot be read back and were inferred from a probe run.
    """

    values: Mapping[str, Any]
    probed: tuple[str, ...] = ()


class Engine(Protocol):
    """A physics engine, behind the few calls that Poinsot needs; no loop, clock or log of its own.

    Made without arguments; ``build`` may be called again and then starts afresh.
    """

    name: ClassVar[str]
    schemes: ClassVar[tuple[Scheme, ...]]
    features: ClassVar[frozenset[str]]
    #: The engine's own settings that a reader should know, in words; one line each.
    settings: ClassVar[Mapping[str, str]]

    @staticmethod
    def version() -> str:
        """Version of the installed engine."""
        ...

    def build(self, scene: Scene, scheme: Scheme, dt: float) -> None:
        """Build ``scene`` at its initial state, to be stepped by ``scheme`` at ``dt`` [s]."""
        ...

    def step(self, n: int) -> None:
        """Advance by ``n`` steps, in the engine's own loop where it has one."""
        ...

    def state(self) -> State:
        """Where everything is now.

        Raises ``EngineError``, if it can with the state, if the engine reset itself, warned or broke down.
        """
        ...

    def readback(self) -> Setup:
        """How the engine is set up, by its own account."""
        ...

    def acceleration(self, q: Array, v: Array) -> Array:
        """Generalised accelerations (nv,) at coordinates ``q`` and velocities ``v``.

        Laid out as ``Scene.q0`` and ``v0``; the result is the time derivative of ``v``, each
        component in its axes (world for the velocity of a free joint, body for ω). Contacts take no part.
        """
        ...

    def model_text(self) -> tuple[str, str]:
        """File name and text of the exact model that the engine was given, for the log."""
        ...

    def close(self) -> None:
        """Let go of what ``build`` made."""
        ...


def settings_in(engine: type[Engine], scene: Scene) -> dict[str, str]:
    """The settings of ``engine``, in words, with which it runs ``scene``."""
    return dict(AS_IT_COMES if scene.defaults else engine.settings)


@runtime_checkable
class Reacting(Protocol):
    """What an engine with the feature ``reaction`` offers beside the calls of ``Engine``."""

    def reactions(self) -> Array:
        """Reactions (k, 6) now, of the bodies that the scene names, as ``Trajectory.reaction`` has them.

        The motion goes on as if nobody had asked.
        """
        ...
