"""What one step of a scheme does to an oscillation: its growth, its phase, its largest stable step.

Source: Hairer & Wanner, *Solving Ordinary Differential Equations II*, § IV.2 (stability functions) and
§ IV.3 (implicit schemes); for semi-implicit Euler the roots of λ² − (2 − z²)λ + 1 = 0.
"""

import numpy as np

from .checked import not_negative, positive
from .schemes import Scheme, known_scheme


def step_factor(scheme: Scheme, omega_dt: float) -> complex:
    """Factor λ of q̈ = −ω²q at z = ωdt ≥ 0, the truth being exp(iz) [1].

    |λ| is the growth of the amplitude in a step, arg λ the phase: the scheme's own frequency is
    arg λ/dt. Past its limit semi-implicit Euler has two real factors; the growing one is returned.
    Raises InputError for another scheme or a negative z. Source: see the module's.
    """
    known_scheme(scheme)
    z = not_negative("omega_dt", omega_dt)
    if scheme in ("semi_implicit_euler", "implicit_damping"):
        if z > 2:
            return complex(1 - z * z / 2 - z * np.sqrt((z / 2 - 1) * (z / 2 + 1)))
        return complex(1 - z * z / 2, z * np.sqrt((1 - z / 2) * (1 + z / 2)))
    if scheme == "rk4":
        return complex(1 - z**2 / 2 + z**4 / 24, z - z**3 / 6)
    if scheme == "implicit_euler":
        return 1 / complex(1, -z)
    if scheme == "implicit_midpoint":
        return complex(1, z / 2) / complex(1, -z / 2)
    return complex(1, z)


def largest_stable_step(scheme: Scheme, omega: float) -> float:
    """Step [s] up to which an undamped oscillation at ω [rad/s] does not grow; inf if there is none.

    2/ω for semi-implicit Euler, 2√2/ω for RK4, 0 for explicit Euler, no limit for the implicit ones.
    Raises InputError for another scheme or ω not above 0.
    Source: |λ| ≤ 1 in `step_factor`; for RK4 |λ|² = 1 − z⁶/72 + z⁸/576.
    """
    known_scheme(scheme)
    limits: dict[Scheme, float] = {
        "semi_implicit_euler": 2.0,
        "implicit_damping": 2.0,
        "rk4": 2 * np.sqrt(2),
        "implicit_euler": np.inf,
        "implicit_midpoint": np.inf,
        "explicit_euler": 0.0,
    }
    return float(limits[scheme] / positive("omega", omega))
