"""Theta functions over a rectangle of quarter periods (K, K′), for phases along the real axis.

With z = πu/(2K) and the nome q = exp(−πK′/K) the four functions are (Whittaker & Watson, *A Course of
Modern Analysis*, § 21.1; DLMF § 20.2)

    θ1 = 2 Σ (−1)ⁿ q^(n+½)² sin (2n+1)z      θ3 = 1 + 2 Σ q^n² cos 2nz
    θ2 = 2 Σ       q^(n+½)² cos (2n+1)z      θ4 = 1 + 2 Σ (−1)ⁿ q^n² cos 2nz

Where K > K′ (a modulus near 1) Jacobi's imaginary transformation (W & W § 21.51, DLMF § 20.7(viii))
writes them in q′ = exp(−πK/K′) and hyperbolic functions of v = πu/(2K′): θ1, θ2, θ3, θ4 become, but for
one Gaussian factor, the functions 1, 4, 3, 2 of iv. The nome in use is at most exp(−π), so five terms do,
and on the separatrix itself (K = ∞) one.

Only ratios and arguments are wanted, so each function is scaled to a first coefficient of 1, and in the
hyperbolic form all four are divided by cosh v, which keeps them finite at any distance.
"""

from functools import lru_cache
from operator import mul
from typing import Any, NamedTuple

import numpy as np

from .checked import Array
from .double_double import Pair, two_sum
from .precise import DIGITS, mp

#: A term this small beside the first is left out of a case's scalars [1].
_BEYOND_DIGITS = 10.0 ** (-DIGITS - 5)

#: A term this small beside the first is left out where times are in double [1].
_NEGLIGIBLE = 1e-19

#: Series kept from one block of times to the next.
_KEPT = 64

#: Beyond this v hyperbolic functions are taken as at it: what is left of them is below 10⁻³⁰⁰.
_FARTHEST = 690.0


class Lattice(NamedTuple):
    """Quarter periods along the real and the imaginary axis, and what the series need of them.

    All are mpmath numbers; K or K′ may be infinite. ``nome`` is the q or q′ in use, ``scale`` z/u or v/u.
    """

    K: Any
    K_prime: Any
    hyperbolic: bool
    nome: Any
    scale: Any


def lattice(K: Any, K_prime: Any) -> Lattice:
    """The lattice with quarter periods ``K`` and ``K_prime``, of which one may be infinite."""
    near, far = min(K, K_prime), max(K, K_prime)
    nome = mp.mpf(0) if mp.isinf(far) else mp.exp(-mp.pi * far / near)
    return Lattice(K, K_prime, bool(K_prime < K), nome, mp.pi / (2 * near))


def doubled(once: Lattice) -> Lattice:
    """The lattice with twice the imaginary period, which is the period of dn."""
    return lattice(once.K, 2 * once.K_prime)


class Waves(NamedTuple):
    """sin z, cos z, cos 2z and 1; or tanh v, 1, cosh 2v and sech v."""

    sine: Array
    cosine: Array
    double: Array
    damping: Array


def waves(lattice: Lattice, remainder: Pair) -> Waves:
    """What the theta functions at u = ``remainder``, within K/2 of 0, are made of."""
    scale = float(lattice.scale), float(lattice.scale - float(lattice.scale))
    high = scale[0] * remainder[0]
    low = scale[0] * remainder[1] + scale[1] * remainder[0]
    x, low = two_sum(high, low)
    if not lattice.hyperbolic:
        sine = np.sin(x)
        return Waves(sine, np.cos(x), 1 - 2 * sine * sine, np.ones_like(x))
    x = np.clip(x, -_FARTHEST, _FARTHEST)
    sine = np.tanh(x)
    # cosh 2v only ever multiplies powers of q′ that make up for it: only its overflow is to be kept off.
    double = np.cosh(np.clip(2 * x, -_FARTHEST, _FARTHEST))
    # The low part matters where v is large: sech v falls by as much, relative to itself, as v grows.
    return Waves(sine, np.ones_like(x), double, (1 - low * sine) / np.cosh(x))


def theta(lattice: Lattice, index: int, w: Waves) -> Array:
    """θ_index(u) (n,), over a positive factor of its own."""
    index = _transformed(lattice, index)
    series = _series(lattice, index)
    if index == 1:
        return w.sine * _clenshaw(series, w.double, 1)
    if index == 2:
        return w.cosine * _clenshaw(series, w.double, -1)
    return w.damping * _clenshaw(series, w.double, 0)


def theta_above(lattice: Lattice, index: int, depth: Any, w: Waves) -> tuple[Array, Array]:
    """Real and imaginary part (n,) of θ_index(u + i·depth), over a factor.

    The factor is positive, but for the hyperbolic form's Gaussian, which turns as exp(−iμu/K) with
    μ = π·depth/(2K′) and is left to the caller.
    """
    index = _transformed(lattice, index)
    real, imaginary = _series_above(lattice, index, depth)
    if index == 1:
        return w.sine * _clenshaw(real, w.double, 1), w.cosine * _clenshaw(imaginary, w.double, -1)
    if index == 2:
        return w.cosine * _clenshaw(real, w.double, -1), w.sine * _clenshaw(imaginary, w.double, 1)
    twice = 2 * w.sine * w.cosine / w.damping
    return w.damping * _clenshaw(real, w.double, 0), twice * _clenshaw(imaginary[1:], w.double, 2)


def slope(lattice: Lattice, index: int, depth: Any) -> Any:
    """d/du of the argument of θ_index(u + i·depth) at u = 0, as an mpmath number [rad per unit of u].

    Without the Gaussian's share in the hyperbolic form.
    """
    index = _transformed(lattice, index)
    real, imaginary = _coefficients(lattice, index, depth)
    if index == 1:
        return -lattice.scale * _dot(_orders(index, real), real) / mp.fsum(imaginary)
    return lattice.scale * _dot(_orders(index, real), imaginary) / mp.fsum(real)


def at_origin(lattice: Lattice, index: int) -> Any:
    """θ_index(0), or for index 1 dθ1/du(0), in the scale of `theta`, as an mpmath number."""
    index = _transformed(lattice, index)
    sizes = _sizes(lattice, index)
    return lattice.scale * _dot(_orders(index, sizes), sizes) if index == 1 else mp.fsum(sizes)


def _transformed(lattice: Lattice, index: int) -> int:
    return {1: 1, 2: 4, 3: 3, 4: 2}[index] if lattice.hyperbolic else index


@lru_cache(_KEPT)
def _series(lattice: Lattice, index: int) -> tuple[float, ...]:
    return _floats(lattice, _sizes(lattice, index))


@lru_cache(_KEPT)
def _series_above(lattice: Lattice, index: int, depth: Any) -> tuple[tuple[float, ...], tuple[float, ...]]:
    real, imaginary = _coefficients(lattice, index, depth)
    return _floats(lattice, real), _floats(lattice, imaginary)


def _sizes(lattice: Lattice, index: int) -> tuple[Any, ...]:
    """Coefficients of the series on the real axis; ``index`` is that of the function in use."""
    p, sign, sizes = lattice.nome, -1 if index in (1, 4) else 1, [mp.mpf(1)]
    for n in range(1, 20):
        size = p ** (n * (n + 1)) if index in (1, 2) else 2 * p ** (n * n)
        # A term may grow by q^(−n) above the real axis, or by q′^(−n/2) along it.
        if size <= _BEYOND_DIGITS * p**n:
            break
        sizes.append(sign**n * size)
    return tuple(sizes)


def _coefficients(lattice: Lattice, index: int, depth: Any) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """Coefficients of the real and the imaginary series at a depth; ``index`` as for `_sizes`."""
    sizes = _sizes(lattice, index)
    angles = [order * lattice.scale * depth for order in _orders(index, sizes)]
    if lattice.hyperbolic:
        even, odd = [mp.cos(a) for a in angles], [mp.sin(a) for a in angles]
    else:
        backwards = 1 if index == 1 else -1
        even, odd = [mp.cosh(a) for a in angles], [backwards * mp.sinh(a) for a in angles]
    return tuple(map(mul, sizes, even)), tuple(map(mul, sizes, odd))


def _orders(index: int, sizes: tuple[Any, ...]) -> list[int]:
    return [2 * n + (index in (1, 2)) for n in range(len(sizes))]


def _floats(lattice: Lattice, coefficients: tuple[Any, ...]) -> tuple[float, ...]:
    """The coefficients worth keeping in double, cosh 2nv ≤ q′^(−n/2) allowed for."""
    root = mp.sqrt(lattice.nome) if lattice.hyperbolic else mp.mpf(1)
    least = _NEGLIGIBLE * abs(coefficients[0])
    kept = [n for n, c in enumerate(coefficients) if abs(c) > least * root**n]
    return tuple(float(c) for c in coefficients[: max(kept, default=0) + 1])


def _clenshaw(coefficients: tuple[float, ...], x: Array, kind: int) -> Array:
    """Σ a_n P_n(x), P_n the Chebyshev polynomials of the kind that starts 1, 2x − (x, 0, 1 or −1).

    Kinds 0, 2, −1, 1: cos nθ; sin (n+1)θ/sin θ; cos (n+½)θ/cos ½θ; sin (n+½)θ/sin ½θ, with x = cos θ
    (DLMF § 18.5(i)). The same holds for hyperbolic functions.
    """
    twice: Array = 2 * x
    after: Array = np.zeros(())
    here: Array = np.zeros(())
    for a in reversed(coefficients):
        after, here = here, a + (twice * here - after)
    if kind == 0:
        return here - x * after
    return here - {2: 0.0, -1: 1.0, 1: -1.0}[kind] * after


def _dot(a: list[int], b: tuple[Any, ...]) -> Any:
    return mp.fsum(map(mul, a, b))
