"""A mass that falls while a scene runs: what is burnt leaves, its thrust is a force of the scene."""

from collections.abc import Sequence
from dataclasses import dataclass

from ..reference.checked import positive
from ..reference.errors import InputError
from .body import Body


@dataclass(frozen=True)
class Burning:
    """A free body that loses mass at a steady ``rate`` [kg/s], its inertia in proportion, its centre staying.

    Over a step it keeps the mass that it has at the start of it.
    """

    body: str
    rate: float

    def __post_init__(self) -> None:
        positive("burning rate", self.rate)

    def place(self, bodies: Sequence[Body]) -> int:
        """Which of the bodies it is. Raises ``InputError`` if none of them is that body, and free."""
        free = [body.name for body in bodies if any(joint.kind == "free" for joint in body.joints)]
        if self.body not in free:
            raise InputError(
                f"burning: got body {self.body!r}, expected a free one of {', '.join(free) or 'none'}"
            )
        return [body.name for body in bodies].index(self.body)

    def share(self, bodies: Sequence[Body], t: float) -> float:
        """What is left at ``t`` [s], of the mass at the start. Raises ``InputError`` where nothing is."""
        left = 1 - self.rate * t / bodies[self.place(bodies)].mass
        if left <= 0:
            raise InputError(f"burning: body {self.body!r} is used up by {t:g} s; burn less, or run shorter")
        return left
