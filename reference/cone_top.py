"""A uniform solid cone that spins on its tip: what makes it a heavy symmetric top.

Source: Taylor, *Classical Mechanics*, § 10.3, example 10.3; Landau & Lifshitz, *Mechanics*, § 32, problem 2
(circular cone). ``mass`` [kg], ``radius`` R of the base [m], ``height`` h [m]; each must be above 0, or
InputError is raised.
"""

from .checked import positive


def moments(mass: float, radius: float, height: float) -> tuple[float, float]:
    """(I1, I3) [kg m²] about the tip: 3M/20 (R² + 4h²) across the axis, 3M/10 R² about it."""
    M, R, h = positive("mass", mass), positive("radius", radius), positive("height", height)
    return 3 * M / 20 * (R**2 + 4 * h**2), 3 * M / 10 * R**2


def length(height: float) -> float:
    """Distance l = 3h/4 [m] from the tip to the centre of mass."""
    return 3 * positive("height", height) / 4
