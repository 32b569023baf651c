"""What one step of a scheme does to an oscillation or a decay: growth, phase, the largest stable step.

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


def decay_factor(scheme: Scheme, rate_dt: float) -> float:
    """Factor of the velocity under v̇ = −cv in a step of z = c dt ≥ 0, the truth being exp(−z) [1].

    Raises InputError for another scheme or a negative z.
    Source: Hairer & Wanner, II, § IV.2 and IV.3: the stability functions at −z.
    """
    known_scheme(scheme)
    z = not_negative("rate_dt", rate_dt)
    if scheme == "rk4":
        return float(1 - z + z**2 / 2 - z**3 / 6 + z**4 / 24)
    if scheme in ("implicit_euler", "implicit_damping"):
        return float(1 / (1 + z))
    if scheme == "implicit_midpoint":
        return float((1 - z / 2) / (1 + z / 2))
    return float(1 - z)


def largest_decaying_step(scheme: Scheme, rate: float) -> float:
    """Step [s] up to which a damped velocity, v̇ = −rate·v with rate in 1/s, does not grow; inf if none is.

    2/rate where damping is explicit, 2.785…/rate for RK4, no limit where it is implicit. Raises InputError
    for another scheme or a rate not above 0.
    Source: |factor| ≤ 1 in `decay_factor`; for RK4 the root of z³ − 4z² + 12z − 24, by Cardano.
    """
    known_scheme(scheme)
    if scheme in ("implicit_euler", "implicit_damping", "implicit_midpoint"):
        return float(np.inf / positive("rate", rate))
    # z = 4/3 + y with y³ + (20/3)y − 344/27 = 0, whose one real root is a difference of cube roots.
    half, third = 172 / 27, 20 / 9
    root = np.sqrt(half**2 + third**3)
    limit = 4 / 3 + np.cbrt(root + half) - np.cbrt(root - half) if scheme == "rk4" else 2.0
    return float(limit / positive("rate", rate))
