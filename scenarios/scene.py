"""A scene: what is simulated, what is true of it, and what is measured on it."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any

import numpy as np

from ..reference.checked import Array, finite, positive
from ..reference.errors import InputError
from .blows import Blow
from .body import WIDTHS, Body, Joint, Vector
from .burning import Burning
from .contact import Contact
from .features import left_out, needed
from .forces import Constant, Force, Spring
from .observables import Observable
from .pictures import Picture
from .trajectory import Trajectory

Truth = Callable[["Scene", Array], Trajectory]
SchemeMotion = Callable[["Scene", str, float, Array], Trajectory | None]
StableStep = Callable[["Scene", str], float | None]
#: No step comes nearer to a singular time than this, as a part of itself: what rounding is divided by there
#: stays so large that schemes of fourth order keep their order at the steps of ladders.
NEAR = 0.1
#: Most steps of a run: engines count them in 32 bits.
MOST = 2**31 - 1


@dataclass(frozen=True)
class Softness:
    """How far an engine's model of contact may take it from the motion asked for, and why.

    ``share`` is of the size of each observable, at a step of ``dt`` [s], and falls as the step does to the
    power ``order``; ``reason`` says what gives way, and what was measured.
    """

    share: float
    reason: str
    dt: float = 1.0
    order: int = 0

    def __post_init__(self) -> None:
        positive("softness share", self.share)
        positive("softness dt", self.dt)
        if self.order < 0:
            raise InputError(
                f"softness order: got {self.order}, expected 0 or more: none grows as steps shrink"
            )
        if not self.reason:
            raise InputError("softness: got no reason, expected what gives way and what was measured")

    def at(self, dt: float) -> float:
        """The share at a step of ``dt`` [s]."""
        return self.share * (dt / self.dt) ** self.order


@dataclass(frozen=True, eq=False)
class Scene:
    """One system, one set of parameters, one initial state: immutable and known to no engine.

    ``q0`` and ``v0`` hold every joint's coordinates, body by body, in the widths of ``WIDTHS``.
    The run lasts ``duration`` [s] and is looked at ``samples`` times after the start, evenly.
    ``dt`` [s] is the step to run at when none is asked for; ``ladders`` maps a scheme's order, or
    its twin name where that needs others, to the steps over which its order is measured.

    ``contacts`` are the only pairs that touch each other; in a scene without any, nothing does.
    ``soft`` says of engines, by name, how far their contacts give way: granted beside round-off.
    ``forces`` act at the centres of mass, beside gravity and what joints do, blows among them for a while;
    ``burning`` bodies lose mass.
    ``defaults`` asks engines to leave what they add by themselves, motors too, and contacts as they come.
    ``reactions`` names the bodies whose joints' reactions are measured, as ``Trajectory.reaction`` has them.
    At ``singular_times`` [s] the equations of the joints have no solution: no step may come to one of them.

    ``truth(scene, t)`` is the exact motion; ``scheme_motion(scene, twin, dt, t)`` the exact motion
    *of a scheme*, where it is known in closed form (``None`` from it: not for this scheme).
    ``errors[twin]`` are the recorded constants C of the scheme's error C·dt^order, one for each of
    ``observables``; 0 where only round-off was seen. ``stable_step(scene, twin)`` is the largest step [s]
    at which a scheme's energy stays bounded, by theory: 0 for none, infinite for any, ``None`` where theory
    does not tell.

    Raises ``InputError`` on loading when something cannot be: the message names scene and field.
    """

    name: str
    summary: str
    source: str
    bodies: tuple[Body, ...]
    q0: tuple[float, ...]
    v0: tuple[float, ...]
    duration: float
    samples: int
    truth: Truth
    observables: tuple[Observable, ...]
    pictures: tuple[Picture, ...] = ()
    variant: str = ""
    gravity: Vector = (0.0, 0.0, 0.0)
    dt: float = 1e-3
    ladders: Mapping[int | str, tuple[float, ...]] = field(default_factory=dict)
    errors: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    scheme_motion: SchemeMotion | None = None
    stable_step: StableStep | None = None
    contacts: tuple[Contact, ...] = ()
    soft: Mapping[str, Softness] = field(default_factory=dict)
    forces: tuple[Force, ...] = ()
    burning: tuple[Burning, ...] = ()
    reactions: tuple[str, ...] = ()
    defaults: bool = False
    singular_times: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        try:
            self._check()
        except InputError as error:
            raise InputError(f"scene {self.full_name}: {error}") from error

    @property
    def full_name(self) -> str:
        """``scene[variant]``, or ``scene`` where there is only one."""
        return f"{self.name}[{self.variant}]" if self.variant else self.name

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        """Every joint, body by body."""
        return tuple(joint for body in self.bodies for joint in body.joints)

    @cached_property
    def scalar_joints(self) -> tuple[Joint, ...]:
        """The hinges and slides: the joints that a trajectory's ``joint_position`` speaks of."""
        return tuple(joint for joint in self.joints if joint.kind in ("hinge", "slide"))

    @cached_property
    def features(self) -> frozenset[str]:
        """What an engine must have to build this scene: keys of ``FEATURES``."""
        return needed(self)

    @cached_property
    def left_out(self) -> tuple[str, ...]:
        """What an engine's model of this scene does not hold, in words."""
        return left_out(self)

    def sample_times(self) -> Array:
        """Times of the samples, (samples + 1,) [s], the start included."""
        return np.asarray(np.arange(self.samples + 1) * (self.duration / self.samples))

    def steps_per_sample(self, dt: float) -> int:
        """Whole steps between two samples, for a step of ``dt`` [s] or the nearest that divides it."""
        positive("dt", dt)
        if dt > self.duration * (1 + 1e-12):
            raise InputError(
                f"dt: got {dt:g} s, expected at most {self.duration:g} s, the whole run of {self.full_name}"
            )
        return max(1, round(self.duration / self.samples / dt))

    def whole_step(self, dt: float) -> float:
        """The step [s] nearest to ``dt`` that divides the time between two samples."""
        exact = self.duration / self.samples / self.steps_per_sample(dt)
        return dt if abs(dt / exact - 1) < 1e-12 else exact

    def unfit(self, dt: float) -> str:
        """Why no scheme can take steps of ``dt`` [s], or an empty text if one can."""
        if dt > self.duration * (1 + 1e-12):
            return f"a step of {dt:.6g} s is longer than the whole run, {self.duration:g} s"
        if self.duration / dt > MOST:
            return f"a run in steps of {dt:.6g} s takes {self.duration / dt:.2g} of them, at most {MOST} fit"
        for time in self.singular_times:
            halves = 2 * time / dt  # schemes look at the middle of a step as well
            if abs(halves - round(halves)) / 2 < NEAR:
                return (
                    f"a step of {dt:.6g} s comes to {time:.6g} s, where the equations of the joints have no "
                    "solution"
                )
        return ""

    def error_constant(self, twin: str, observable: Observable) -> float | None:
        """The recorded C of C·dt^order for a scheme, or ``None`` where none is recorded."""
        row = self.errors.get(twin)
        return None if row is None else row[self.observables.index(observable)]

    def errs_in(self, observable: Observable) -> bool:
        """Whether any scheme that is recorded has an error of its own in that observable."""
        place = self.observables.index(observable)
        return any(row[place] for row in self.errors.values())

    def ladder(self, order: int, twin: str = "") -> tuple[float, ...]:
        """Steps [s] over which to measure a scheme: its own, or those of the nearest order there is."""
        if twin in self.ladders:
            return self.ladders[twin]
        orders = [known for known in self.ladders if isinstance(known, int)]
        if not orders:
            return (self.dt,)
        return self.ladders[min(orders, key=lambda known: abs(known - order))]

    def slices(self) -> list[tuple[Body, Joint, slice, slice]]:
        """Each joint with its body and its places in ``q0`` and ``v0``."""
        result, q, v = [], 0, 0
        for body in self.bodies:
            for joint in body.joints:
                nq, nv = WIDTHS[joint.kind]
                result.append((body, joint, slice(q, q + nq), slice(v, v + nv)))
                q, v = q + nq, v + nv
        return result

    def as_json(self) -> str:
        """The scene as JSON, stable from run to run: what the log keeps and a reader compares."""
        judged = {"truth", "observables", "scheme_motion", "stable_step", "errors", "ladders", "soft"}
        skipped = judged | {"pictures", "singular_times"}
        plain: dict[str, Any] = {f.name: getattr(self, f.name) for f in fields(self) if f.name not in skipped}
        plain["observables"] = [observable.name for observable in self.observables]
        for later in (
            "reactions",
            "defaults",
        ):  # unknown to the logs of before, which still say what they are of
            if not plain[later]:
                del plain[later]
        return json.dumps(plain, default=_plain, sort_keys=True)

    def _check(self) -> None:
        positive("duration", self.duration)
        positive("dt", self.dt)
        finite("gravity", self.gravity, (3,))
        if not isinstance(self.samples, int) or self.samples < 1:
            raise InputError(f"samples: got {self.samples}, expected a whole number, at least 1")
        for twin, row in self.errors.items():
            if len(row) != len(self.observables):
                raise InputError(
                    f"errors of {twin!r}: got {len(row)} constants, expected one for each of "
                    f"{len(self.observables)} observables"
                )
        names = [body.name for body in self.bodies]
        if len(set(names)) != len(names) or not names:
            raise InputError(f"bodies: got the names {names}, expected at least one, each different")
        joints = [joint.name for joint in self.joints]
        if len(set(joints)) != len(joints):
            raise InputError(f"joints: got the names {joints}, expected each different")
        for place, body in enumerate(self.bodies):
            if body.parent is not None and body.parent not in names[:place]:
                raise InputError(
                    f"body {body.name!r} parent: got {body.parent!r}, expected a body listed before it"
                )
        self._check_contacts()
        self._check_reactions()
        for force in self.forces:
            force.acting(self.bodies)  # raises for a body that is not there
            if isinstance(force, Blow):
                force.refuse_between(self.duration / self.samples, self.duration)
        for burning in self.burning:
            burning.share(self.bodies, self.duration)  # raises where nothing is left
            for force in self.forces:
                if not isinstance(force, (Constant, Spring)):
                    raise InputError(
                        f"forces: got {type(force).__name__} beside a burning body, expected only forces "
                        "that do not depend on its mass: Constant, Spring"
                    )
        nq, nv = (sum(WIDTHS[joint.kind][side] for joint in self.joints) for side in (0, 1))
        q0 = finite("q0", self.q0, (nq,))
        finite("v0", self.v0, (nv,))
        for _, joint, where, _ in self.slices():
            if joint.kind in ("free", "ball") and abs(float(np.linalg.norm(q0[where][-4:])) - 1) > 1e-9:
                raise InputError(
                    f"q0 of joint {joint.name!r}: got {q0[where].tolist()}, expected a unit quaternion"
                )

    def _check_contacts(self) -> None:
        bodies = {body.name: body for body in self.bodies}
        for contact in self.contacts:
            for name in filter(None, (contact.first, contact.second)):
                if name not in bodies:
                    raise InputError(
                        f"contact {contact.name!r}: got body {name!r}, expected one of {', '.join(bodies)}"
                    )
                if bodies[name].solids:
                    raise InputError(
                        f"contact {contact.name!r}: got body {name!r}, whose solids touch nothing"
                    )
        pairs = [contact.name for contact in self.contacts]
        if len(set(pairs)) != len(pairs):
            raise InputError(f"contacts: got {pairs}, expected each pair once")

    def _check_reactions(self) -> None:
        held = [body.name for body in self.bodies if body.joints and body.joints[0].kind != "free"]
        wrong = [name for name in self.reactions if name not in held]
        if wrong or len(set(self.reactions)) != len(self.reactions):
            raise InputError(
                f"reactions: got {list(self.reactions)}, expected each once, of bodies that a ball, hinge or "
                f"slide holds: {', '.join(held) or 'there are none'}"
            )
        if self.reactions and (self.contacts or self.burning):
            raise InputError("reactions: got some beside contacts or burning bodies; expected none of those")


def _plain(part: Any) -> dict[str, Any]:
    """A part's fields; of a body without solids, as most are, none are named."""
    return {name: value for name, value in part.__dict__.items() if name != "solids" or value}


def every_scheme(
    rows: Mapping[str, tuple[float, ...]], like: str, *more: str
) -> dict[str, tuple[float, ...]]:
    """Error constants ``rows`` with those of MuJoCo's own twins added.

    On the scene at hand its ``implicitfast`` and its ``discrete`` are the scheme ``like``, bit for bit; those
    of ``more`` schemes were measured to be alike in all digits kept.
    """
    return {**rows, **dict.fromkeys(("implicitfast", "discrete", *more), rows[like])}
