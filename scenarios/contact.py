"""What of the bodies touches what: shapes for contact alone, which weigh nothing."""

from dataclasses import dataclass

import numpy as np

from ..reference.checked import finite, not_negative, positive, within
from ..reference.errors import InputError
from .body import Vector


@dataclass(frozen=True)
class Sphere:
    """A sphere of this ``radius`` [m] about the origin of its body's frame."""

    radius: float

    def __post_init__(self) -> None:
        positive("sphere radius", self.radius)


@dataclass(frozen=True)
class Rim:
    """A circle of this ``radius`` [m] about the third axis of its body's frame: the edge of a disc."""

    radius: float

    def __post_init__(self) -> None:
        positive("rim radius", self.radius)


@dataclass(frozen=True)
class Plane:
    """All x with normal·x = ``offset`` [m], in its body's frame or the world's; solid behind the normal."""

    normal: Vector = (0.0, 0.0, 1.0)
    offset: float = 0.0

    def __post_init__(self) -> None:
        finite("plane offset", self.offset, ())
        if abs(float(np.linalg.norm(finite("plane normal", self.normal, (3,)))) - 1) > 1e-12:
            raise InputError(f"plane normal: got {self.normal}, expected a unit vector")


@dataclass(frozen=True)
class Contact:
    """A pair that may touch: a body with a round ``shape``, and what it is ``against``.

    ``second`` is the body that ``against`` belongs to, ``None`` for the world. ``friction`` is
    Coulomb's μ, the same at rest and in motion; ``restitution`` e is Newton's, the speed of parting
    over the speed of meeting. A contact has one or the other: it is smooth, or it does not bounce.
    ``slides`` says which of the two friction is there for, as some engines need to be told.
    """

    first: str
    shape: Sphere | Rim
    second: str | None
    against: Sphere | Plane
    friction: float = 0.0
    restitution: float = 0.0
    slides: bool = False

    def __post_init__(self) -> None:
        not_negative(f"contact {self.name!r} friction", self.friction)
        within(f"contact {self.name!r} restitution", self.restitution, 0.0, 1.0)
        if self.friction and self.restitution:
            raise InputError(
                f"contact {self.name!r}: got friction {self.friction} and restitution {self.restitution}, "
                "expected one of them 0: what engines make of both together is measured nowhere"
            )
        if self.first == self.second:
            raise InputError(f"contact {self.name!r}: got the same body twice, expected two")

    @property
    def name(self) -> str:
        """The two that touch."""
        return f"{self.first} on {self.second or 'world'}"
