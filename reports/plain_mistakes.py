"""Plain mistakes that may be in an engine's equations of motion, with no number to find."""

from collections.abc import Callable, Iterator
from itertools import permutations, product

import numpy as np

from ..reference.checked import Array
from .supposed import Model


def alternatives(model: Model) -> Iterator[tuple[str, Callable[[Model], Model]]]:
    """Plain mistakes, with no number to fit: what to say, and what makes it of a model."""
    for place, (body, link) in enumerate(zip(model.scene.bodies, model.links, strict=True)):
        name, tensor, com = body.name, np.asarray(link.inertia), np.asarray(link.com)
        for order in ((0, 2, 1), (2, 1, 0), (1, 0, 2), (1, 2, 0), (2, 0, 1)):
            turned = tensor[np.ix_(order, order)]
            if not np.allclose(turned, tensor, rtol=1e-12, atol=0):
                yield f"inertia axes of body {name!r} are permuted", _with(place, inertia=turned)
        if np.any(tensor - np.diag(np.diag(tensor))):
            for moments in (np.linalg.eigvalsh(tensor), np.linalg.eigvalsh(tensor)[::-1]):
                yield (
                    f"rotation of the inertia of body {name!r} is lost",
                    _with(place, inertia=np.diag(moments)),
                )
            for other in _turned_back(tensor):
                back = f"rotation of the inertia of body {name!r} is the wrong way round"
                yield back, _with(place, inertia=other)
            lost = np.diag(np.diag(tensor))
            yield f"products of inertia of body {name!r} are lost", _with(place, inertia=lost)
            opposite = 2 * lost - tensor
            yield f"products of inertia of body {name!r} have the wrong sign", _with(place, inertia=opposite)
        if np.any(com):
            moved = link.mass * (com @ com * np.eye(3) - np.outer(com, com))
            about = f"inertia of body {name!r} is taken about its frame, not its centre of mass"
            yield about, _with(place, inertia=tensor + moved)
            twice = f"inertia of body {name!r} is shifted to its centre of mass twice"
            yield twice, _with(place, inertia=tensor - moved)
            yield f"centre of mass of body {name!r} is at its frame", _with(place, com=0 * com)


def _turned_back(tensor: Array) -> Iterator[Array]:
    """What a tensor becomes if its principal axes are turned the other way, whichever is called the first."""
    moments, axes = np.linalg.eigh(tensor)
    for order in permutations(range(3)):
        for signs in product((1, -1), repeat=3):
            R = axes[:, order] * signs
            if np.linalg.det(R) > 0:
                yield R.T @ np.diag(moments[list(order)]) @ R


def _with(place: int, **parts: Array) -> Callable[[Model], Model]:
    return lambda model: model.with_link(place, **parts)
