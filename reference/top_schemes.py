"""What a scheme must give for the body rates of a free symmetric top, exactly.

ω3 is constant and ω1 + iω2 obeys ẇ = iΩw, Ω = ω3 (I3 − I1)/I1, which is linear: n steps multiply it by
the n-th power of the scheme's factor. Only the rates: no such form is known for the attitude.

Source: Goldstein, *Classical Mechanics*, § 5.6 (Euler's equations of the symmetric body); Hairer &
Wanner, *Solving Ordinary Differential Equations II*, § IV.2 (stability functions).
"""

from typing import Literal

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, positive, principal_moments
from .errors import InputError
from .schemes import whole_steps

#: The gyroscopic torque taken at the old rates, at the new ones (linearised), or by Runge and Kutta.
Gyroscopic = Literal["explicit", "implicit", "rk4"]


def body_rates(
    scheme: Gyroscopic, I1: float, I3: float, omega0: npt.ArrayLike, dt: float, steps: npt.ArrayLike
) -> Array:
    """ω in body axes (m, 3) [rad/s] after n steps (m,) of dt [s] from omega0 (3,) [rad/s].

    Factors of ω1 + iω2 per step, z = Ωdt: 1 + iz explicit, 1/(1 − iz) implicit, Σ (iz)ʲ/j! up to j = 4
    for RK4. The explicit one gains √(1 + z²) a step, the implicit one loses as much. The implicit step
    solves (I + dt ∂(ω×Iω)/∂ω) Δω = −dt ω×Iω, which leaves ω3 alone here.

    Raises InputError for another scheme, moments that no body has, dt not above 0, steps not whole, or
    growth past the largest double. Source: see the module's.
    """
    if scheme not in ("explicit", "implicit", "rk4"):
        raise InputError(f"scheme: got {scheme!r}, expected explicit, implicit or rk4")
    principal_moments("I1, I1, I3", [I1, I1, I3])
    start = finite("omega0", omega0, (3,))
    count = whole_steps(steps).astype(np.longdouble)
    stretch = (np.longdouble(I3) - np.longdouble(I1)) / np.longdouble(I1)
    log_growth, phase = _step_logarithm(scheme, stretch * start[2] * positive("dt", dt))
    with np.errstate(over="ignore"):
        growth = np.exp(count * log_growth)
        cos, sin = growth * np.cos(count * phase), growth * np.sin(count * phase)
        rates = np.column_stack(
            [start[0] * cos - start[1] * sin, start[0] * sin + start[1] * cos, np.full(len(count), start[2])]
        ).astype(np.float64)
    if not np.all(np.isfinite(rates)):
        raise InputError(f"dt: got {dt}, with which the rates grow past the largest double, expected less")
    return rates


def largest_stable_step(scheme: Gyroscopic, I1: float, I3: float, omega3: float) -> float:
    """Step [s] up to which the rates of a free symmetric top do not grow; inf if there is none.

    0 for the explicit scheme, no limit for the implicit one, 2√2/|Ω| for RK4; where Ω is 0 nothing grows.
    Raises InputError for another scheme or moments that no body has. Source: |λ| ≤ 1 in `body_rates`.
    """
    if scheme not in ("explicit", "implicit", "rk4"):
        raise InputError(f"scheme: got {scheme!r}, expected explicit, implicit or rk4")
    principal_moments("I1, I1, I3", [I1, I1, I3])
    rate = abs((I3 - I1) / I1 * omega3)
    if rate == 0 or scheme == "implicit":
        return float("inf")
    return 0.0 if scheme == "explicit" else float(2 * np.sqrt(2) / rate)


def _step_logarithm(scheme: Gyroscopic, z: np.longdouble) -> tuple[np.longdouble, np.longdouble]:
    # log1p and arctan keep the digits that 1 + iz would round away at small z.
    if scheme == "rk4":
        growth = np.log1p(z**6 * (z**2 / 8 - 1) / 72) / 2
        return growth, np.arctan2(z - z**3 / 6, 1 - z**2 / 2 + z**4 / 24)
    growth = np.log1p(z * z) / 2
    return (growth if scheme == "explicit" else -growth), np.arctan(z)
