"""What may be wrong in an engine's equations of motion: one number each, and the sentence that names it."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial

import numpy as np

from ..reference.checked import Array
from .added_terms import added, bias, drag, forced, gyroscopic, linear_weight
from .supposed import Change, Model
from .wording import share


@dataclass(frozen=True)
class Suspect:
    """``change(model, x)`` puts it in; x = 0 is right. ``words(x)`` say what x means.

    Of several suspects of one ``part`` that explain a motion equally well, the first to be listed speaks.
    ``value(x)`` is the number that somebody may have got wrong: it is likely to be a round one.
    """

    change: Change
    words: Callable[[float], str]
    part: str = ""
    value: Callable[[float], float] = lambda x: x


@dataclass(frozen=True)
class Several:
    """Suspects that may be wrong together, and what to say of all their numbers."""

    members: tuple[Suspect, ...]
    words: Callable[[Sequence[float]], str]


def suspects(model: Model) -> Iterator[Suspect]:
    """Everything of one number that can be wrong with a scene's equations, the likelier first."""
    if np.any(model.gravity):
        yield from _gravity(model)
    yield from _terms(model)
    yield from _joints(model)
    for body in range(len(model.links)):
        yield from _body(model, body)
    for place in range(len(model.forces)):
        yield from _force(model, place)
    if len(model.links) > 1:
        yield from _together(model)


def several(model: Model) -> Iterator[Several]:
    """What may be wrong in more numbers than one, for when no single one explains a motion."""
    if np.any(model.gravity):
        members = tuple(_along_axes(model))
        size = float(np.linalg.norm(model.gravity))
        yield Several(members, lambda x: f"gravity is {_vector(model.gravity + size * np.array(x))} m/s²")
    for at, body in enumerate(model.scene.bodies):
        mine = tuple(_body(model, at))
        for part in ("centre", "inertia"):
            members = tuple(s for s in mine if s.part.startswith(f"{part} {body.name} "))
            yield Several(members, _said(body.name, part, members))


def _along_axes(model: Model) -> Iterator[Suspect]:
    size = float(np.linalg.norm(model.gravity))
    for axis in np.eye(3):
        yield Suspect(lambda m, x, axis=axis: replace(m, gravity=m.gravity + x * size * axis), str)  # type: ignore[misc]


def _said(name: str, part: str, members: Sequence[Suspect]) -> Callable[[Sequence[float]], str]:
    """The members' own words, of those numbers that matter."""

    def words(numbers: Sequence[float]) -> str:
        least = 1e-6 * max(map(abs, numbers))
        told = [s.words(x) for s, x in zip(members, numbers, strict=True) if abs(x) > least]
        if part == "inertia":
            return (
                told[0]
                if len(told) == 1
                else f"it is as if of the inertia of body {name!r} {', '.join(told)}"
            )
        return " and ".join([told[0], *(words.partition("displaced ")[2] for words in told[1:])])

    return words


def _vector(values: Array) -> str:
    return f"({', '.join(f'{value:.6g}' for value in values)})"


def _gravity(model: Model) -> Iterator[Suspect]:
    size = float(np.linalg.norm(model.gravity))

    def words(x: float) -> str:
        if abs(x + 2) < 1e-6:
            return "gravity has the wrong sign"
        if abs(x + 1) < 1e-6:
            return "gravity is missing"
        return f"gravity is {size * (1 + x):.9g} m/s², not {size:.9g}"

    yield Suspect(
        lambda m, x: replace(m, gravity=m.gravity * (1 + x)), words, "gravity", lambda x: size * (1 + x)
    )
    for side in np.eye(3)[[abs(axis @ model.gravity) < 0.5 * size for axis in np.eye(3)]]:
        yield Suspect(
            lambda m, x, side=side: replace(m, gravity=m.gravity + x * size * side),  # type: ignore[misc]
            lambda x, side=side: f"gravity leans by {x:.3g} rad along {_axis(side)}",  # type: ignore[misc]
            f"gravity {_axis(side)}",
        )


def _body(model: Model, at: int) -> Iterator[Suspect]:
    link, name = model.links[at], model.scene.bodies[at].name
    tensor, com = np.asarray(link.inertia), np.asarray(link.com)
    size = float(np.trace(tensor)) / 3

    def mass(m: Model, x: float) -> Model:
        return m.with_link(at, mass=m.links[at].mass * (1 + x))

    def dense(m: Model, x: float) -> Model:
        return mass(m.with_link(at, inertia=np.asarray(m.links[at].inertia) * (1 + x)), x)

    yield Suspect(mass, lambda x: f"mass of body {name!r} is {share(x)}", f"mass {name}")
    if size:
        yield Suspect(dense, lambda x: f"mass and inertia of body {name!r} are {share(x)}", f"mass {name}")
        yield Suspect(
            lambda m, x: m.with_link(at, inertia=np.asarray(m.links[at].inertia) * (1 + x)),
            lambda x: f"inertia of body {name!r} is {share(x)}",
            f"inertia {name}",
        )
    reach = float(np.linalg.norm(com)) or (size / link.mass) ** 0.5 or 1.0
    for k in range(3):
        yield Suspect(
            lambda m, x, k=k: m.displaced(at, x * reach * np.eye(3)[k]),  # type: ignore[misc]
            lambda x, k=k: (  # type: ignore[misc]
                f"centre of mass of body {name!r} is displaced by {x * reach:.3g} m along its axis {k + 1}"
            ),
            f"centre {name} {k}",
        )
    for i in range(3 if size else 0):
        for j in range(i, 3):
            yield _element(at, name, tensor, i, j, size)


def _element(at: int, name: str, tensor: Array, i: int, j: int, size: float) -> Suspect:
    unit = np.zeros((3, 3))
    unit[i, j] = unit[j, i] = tensor[i, i] if i == j and tensor[i, i] else size

    def words(x: float) -> str:
        if i == j:
            return f"moment I{i + 1} of body {name!r} is {share(x)}"
        return f"product of inertia I{i + 1}{j + 1} of body {name!r} is off by {x * size:.3g} kg m²"

    def change(m: Model, x: float) -> Model:
        return m.with_link(at, inertia=np.asarray(m.links[at].inertia) + x * unit)

    return Suspect(change, words, f"inertia {name} {i} {j}")


def _together(model: Model) -> Iterator[Suspect]:
    """The same mistake in every body or joint."""

    def masses(m: Model, x: float) -> Model:
        for at, link in enumerate(model.links):
            m = m.with_link(at, mass=link.mass * (1 + x))
        return m

    def tensors(m: Model, x: float) -> Model:
        for at, link in enumerate(model.links):
            m = m.with_link(at, inertia=np.asarray(link.inertia) * (1 + x))
        return m

    def springs(m: Model, q: Array, v: Array) -> Array:
        result = np.zeros_like(v)
        for _, joint, at_q, at_v in m.scene.slices():
            if joint.kind in ("hinge", "slide"):
                result[..., at_v] = joint.stiffness * q[..., at_q]
        return result

    def slack(m: Model, q: Array, v: Array) -> Array:
        result = np.zeros_like(v)
        for _, joint, _, at_v in m.scene.slices():
            if joint.kind in ("hinge", "slide"):
                result[..., at_v] = -joint.stiffness
        return result

    if sum(bool(joint.stiffness) for joint in model.scene.joints) > 1:
        rest = "rest positions of the springs of all joints are off by"
        yield Suspect(added(slack), lambda x: f"{rest} {x:.3g}", "all rests")
        yield Suspect(
            added(springs), lambda x: f"spring stiffness of all joints is {share(x)}", "all springs"
        )
    yield Suspect(masses, lambda x: f"masses of all bodies are {share(x)}", "all masses")
    yield Suspect(tensors, lambda x: f"inertias of all bodies are {share(x)}", "all inertias")


def _joints(model: Model) -> Iterator[Suspect]:
    for _, joint, at_q, at_v in model.scene.slices():
        if joint.kind not in ("hinge", "slide"):
            continue
        q, v, name, unit = at_q.start, at_v.start, joint.name, "N m" if joint.kind == "hinge" else "N"
        k = joint.stiffness
        if k:
            yield Suspect(
                forced(v, lambda at, going, q=q, k=k: -k * at[..., q]),  # type: ignore[misc]
                lambda x, name=name: f"spring stiffness of joint {name!r} is {share(x)}",  # type: ignore[misc]
            )
            yield Suspect(
                forced(v, lambda at, going, k=k: k + 0 * at[..., 0]),  # type: ignore[misc]
                lambda x, name=name: f"rest position of the spring of joint {name!r} is off by {x:.3g}",  # type: ignore[misc]
            )
        if joint.damping:
            yield Suspect(
                forced(v, lambda at, going, v=v, c=joint.damping: -c * going[..., v]),  # type: ignore[misc]
                lambda x, name=name: f"damping of joint {name!r} is {share(x)}",  # type: ignore[misc]
            )
        else:
            yield Suspect(
                forced(v, lambda at, going, v=v: -going[..., v]),  # type: ignore[misc]
                lambda x, name=name, u=unit: (
                    f"joint {name!r} is damped by {x:.3g} {u} s, with none asked for"
                ),  # type: ignore[misc]
            )
        yield Suspect(
            forced(v, lambda at, going, v=v: -np.sign(going[..., v])),  # type: ignore[misc]
            lambda x, name=name, u=unit: f"joint {name!r} has a dry friction of {x:.3g} {u}",  # type: ignore[misc]
        )
        yield Suspect(
            forced(v, lambda at, going: 1 + 0 * at[..., 0]),
            lambda x, name=name, u=unit: f"a steady {x:.3g} {u} acts on joint {name!r}, as of a motor",  # type: ignore[misc]
        )
        if np.any(model.gravity):
            yield Suspect(
                forced(v, linear_weight(model, q, v)),
                lambda x, name=name: f"weight on joint {name!r} is linear in its angle, in place of the sine",  # type: ignore[misc]
            )


def _terms(model: Model) -> Iterator[Suspect]:
    every = "gyroscopic and Coriolis terms"
    yield Suspect(added(gyroscopic), lambda x: f"gyroscopic term {_times(1 + x)}", "turning")
    yield Suspect(added(bias), lambda x: f"{every} {_times(1 + x, plural=True)}", "turning")
    names = [joint.name for _, joint, _, at in model.scene.slices() for _ in range(at.stop - at.start)]
    for k, name in enumerate(names if len(names) <= 12 else []):

        def along(m: Model, q: Array, v: Array, k: int = k) -> Array:
            return np.asarray(bias(m, q, v) * np.eye(v.shape[-1])[k])

        yield Suspect(
            added(along),
            lambda x, name=name: f"Coriolis term along joint {name!r} {_times(1 + x)}",  # type: ignore[misc]
            "turning",
        )
    for growing in (False, True):
        for turning in (True, False):
            yield _damping(turning, growing)


def _times(factor: float, plural: bool = False) -> str:
    """What became of a term that is multiplied by ``factor``."""
    be = "are" if plural else "is"
    known = {0: "missing", 2: "doubled", -1: "of the wrong sign"}
    near = round(factor)
    return f"{be} {known[near] if near in known and abs(factor - near) < 1e-3 else share(factor - 1)}"


def _damping(turning: bool, growing: bool) -> Suspect:
    """Drag on every body, as a part of its momentum; ``growing`` by as much again with each unit of speed."""
    name = "angular" if turning else "linear"
    term = partial(drag, turning=turning, growing=growing)
    return Suspect(added(term), lambda x: f"{name} damping ≈ {x:.3g} /s", f"{name} damping")


def _force(model: Model, place: int) -> Iterator[Suspect]:
    force = model.forces[place]
    name = type(force).__name__
    for part in fields(force):  # type: ignore[arg-type]
        value = getattr(force, part.name)
        if (
            part.name.lower() in ("center", "start", "end")
            or isinstance(value, str)
            or not np.any(np.asarray(value))
        ):
            continue

        def scaled(m: Model, x: float, part: str = part.name, value: object = value) -> Model:
            times = np.asarray(value) * (1 + x)
            other = replace(force, **{part: tuple(times.tolist()) if times.ndim else float(times)})  # type: ignore[type-var]
            return replace(m, forces=(*m.forces[:place], other, *m.forces[place + 1 :]))

        yield Suspect(
            scaled,
            lambda x, part=part.name: f"{part} of the {name} force {_times(1 + x)}",  # type: ignore[misc]
        )


def _axis(side: Array) -> str:
    return "xyz"[int(np.argmax(side))]
