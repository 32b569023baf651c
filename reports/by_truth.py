"""What is wrong where our equations of motion do not reach, as with contacts: by the scene's exact motion."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..reference.errors import InputError
from ..scenarios.body import Matrix
from ..scenarios.scene import Scene
from . import truth
from .evidence import Evidence
from .order import extrapolated
from .wording import share

#: A change of a scene that leaves this part of what was to be explained explains it.
ENOUGH = 0.02
#: Rounds of a secant's iteration on one number.
ROUNDS = 6


def in_truth(evidence: Evidence) -> tuple[str, ...]:
    """Causes that turn the exact motion into the one told; those that do so equally well."""
    found = _limit(evidence)
    if found is None:
        return ()
    apart, noise = found
    if np.sqrt(np.mean((apart / noise) ** 2)) < 3:
        return ()
    fits = sorted((fit for fit in _fits(evidence, apart, noise) if fit), key=lambda fit: fit[0])
    if not fits or fits[0][0] > ENOUGH:
        return ()
    return tuple(words for left, words in fits if left <= max(ENOUGH / 10, 3 * fits[0][0]))


def _limit(evidence: Evidence) -> tuple[Array, Array] | None:
    """Differences from the truth as the step goes to 0, all states in a row, and how well they are known."""
    cells, rows, noises = evidence.cells, [], []
    for observable in evidence.scene.observables:
        if observable.kind != "state":
            continue
        every = [observable.difference(c.scene, c.trajectory, c.truth) for c in cells]
        floor = max(cell.floor(observable) for cell in cells)
        if len(cells) >= 3:
            limit, before = extrapolated([c.provenance.dt for c in cells], every, cells[0].provenance.order)
            noise = floor + float(np.abs(limit - before).max())
        else:
            limit, own = every[-1], truth.own_error(cells[-1], observable)
            if own is None:
                return None
            noise = floor + own
        rows.append(limit.ravel())
        noises.append(np.full(limit.size, noise + 1e-300))
    return (np.concatenate(rows), np.concatenate(noises)) if rows else None


def _fits(evidence: Evidence, apart: Array, noise: Array) -> Iterator[tuple[float, str] | None]:
    """What each change leaves unexplained, as a part, and what it says."""
    cell = evidence.cells[-1]
    states = [o for o in evidence.scene.observables if o.kind == "state"]

    def effect(change: "_Change", x: float) -> Array | None:
        evidence.in_time()
        try:
            other = change.made(evidence.scene, x)
            motion = other.truth(other, cell.trajectory.t)
        except (InputError, ValueError, ZeroDivisionError, FloatingPointError):
            return None
        rows = [o.difference(cell.scene, motion, cell.truth).ravel() for o in states]
        found = np.concatenate(rows) / noise
        return found if np.isfinite(found).all() else None

    for change in _changes(evidence.scene):
        yield _fitted(change, effect, apart / noise)


class _Change:
    """One number of a scene multiplied by 1 + x."""

    def __init__(self, words: str, owner: str, place: int, field: str, element: int | None = None) -> None:
        self.words, self._owner, self._place, self._field, self._element = words, owner, place, field, element

    def made(self, scene: Scene, x: float) -> Scene:
        if self._owner == "scene":
            return replace(scene, gravity=_tuple(np.array(scene.gravity) * (1 + x)))
        parts = list(getattr(scene, self._owner))
        mine = parts[self._place]
        parts[self._place] = replace(mine, **{self._field: self._scaled(getattr(mine, self._field), x)})
        changed: dict[str, Any] = {self._owner: tuple(parts)}
        return replace(scene, **changed)

    def _scaled(self, value: "float | Matrix", x: float) -> "float | Matrix":
        if isinstance(value, float | int):
            return value * (1 + x)
        tensor = np.array(value)
        if self._element is None:
            tensor *= 1 + x
        else:
            tensor[self._element, self._element] *= 1 + x
        first, second, third = (_tuple(row) for row in tensor)
        return first, second, third


def _changes(scene: Scene) -> Iterator[_Change]:
    for at, contact in enumerate(scene.contacts):
        for field in ("friction", "restitution"):
            if getattr(contact, field):
                yield _Change(f"{field} of contact {contact.name!r} is", "contacts", at, field)
    if any(scene.gravity):
        yield _Change("gravity is", "scene", 0, "gravity")
    for at, burning in enumerate(scene.burning):
        yield _Change(f"burning rate of body {burning.body!r} is", "burning", at, "rate")
    for at, body in enumerate(scene.bodies):
        yield _Change(f"mass of body {body.name!r} is", "bodies", at, "mass")
        yield _Change(f"inertia of body {body.name!r} is", "bodies", at, "inertia")
        for k in range(3):
            yield _Change(f"moment I{k + 1} of body {body.name!r} is", "bodies", at, "inertia", k)


def _fitted(
    change: _Change, effect: Callable[[_Change, float], Array | None], apart: Array
) -> tuple[float, str] | None:
    """By secants from 0: the part of ``apart`` that the best number leaves."""
    whole, x, best = float(np.linalg.norm(apart)), 0.0, (1.0, 0.0)
    for _ in range(ROUNDS):
        width = 1e-4 * max(abs(x), 0.1)
        here, there = effect(change, x), effect(change, x + width)
        if here is None or there is None:
            break
        left = float(np.linalg.norm(apart - here)) / whole
        slope = (there - here) / width
        if left < best[0]:
            best = (left, x)
        elif x:
            break
        if not slope @ slope > 0:
            break
        x += float(slope @ (apart - here)) / float(slope @ slope)
    return None if best[1] == 0 else (best[0], f"{change.words} {share(best[1])}")


def _tuple(values: Array) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return x, y, z
