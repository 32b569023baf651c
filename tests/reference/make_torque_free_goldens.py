"""Free motions to thirty digits, by Taylor series of Euler's equations and of the quaternion's rate.

Owes nothing to elliptic functions: dω1/dt = (I2 − I3)ω2ω3/I1 and its two sisters, dq/dt = ½ q ω, expanded to
order 40 at each step in fixed-point integers of 200 bits, so that truncation and rounding stay below 10⁻⁴⁰ a
step. Late times are reached by the return of ω to its start: over each such period the body turns by the same
angle about the fixed L, which is measured over the first one.

    python make_torque_free_goldens.py           writes torque_free_goldens.json beside it (minutes)
    python make_torque_free_goldens.py --check   recomputes the cases at every 20th place and compares
"""

import argparse
import json
import math
import random
import sys
from operator import mul
from pathlib import Path

import mpmath

BITS = 200
ORDER = 40
ONE = 1 << BITS
TRUNCATION_BITS = 140
DIGITS = 30
FILE = Path(__file__).with_name("torque_free_goldens.json")

mpmath.mp.dps = 60


def convolution(a, b):
    return sum(map(mul, a, reversed(b))) >> BITS


def expansion(g, omega, q):
    """Taylor coefficients of ω (3 lists) and q (4 lists) at a state."""
    w = [[component] for component in omega]
    p = [[component] for component in q]
    for n in range(ORDER):
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            w[i].append((g[i] * convolution(w[j][: n + 1], w[k][: n + 1]) >> BITS) // (n + 1))
        c = [[convolution(p[a][: n + 1], w[b][: n + 1]) for b in range(3)] for a in range(4)]
        rates = (
            c[3][0] + c[1][2] - c[2][1],
            c[3][1] + c[2][0] - c[0][2],
            c[3][2] + c[0][1] - c[1][0],
            -c[0][0] - c[1][1] - c[2][2],
        )
        for a in range(4):
            p[a].append(rates[a] // (2 * (n + 1)))
    return w, p


def longest_step(series):
    """The step [fixed point] whose first neglected terms are about 2^−TRUNCATION_BITS."""
    logs = []
    for n in (ORDER - 1, ORDER):
        largest = max(abs(s[n]) for s in series)
        if largest:
            logs.append((-TRUNCATION_BITS - (largest.bit_length() - BITS)) / n)
    return int(ONE * 2.0 ** min([*logs, 3.0]))


def at(series, h):
    values = []
    for s in series:
        total = 0
        for coefficient in reversed(s):
            total = (total * h >> BITS) + coefficient
        values.append(total)
    return values


def fixed(x):
    return int(mpmath.nint(mpmath.mpf(x) * ONE))


class Motion:
    """A case in units of time in which |ω0| is near 1."""

    def __init__(self, moments, q0, omega0):
        inertia = [mpmath.mpf(x) for x in moments]
        self.unit = mpmath.mpf(2) ** math.ceil(math.log2(max(map(abs, omega0)) or 1))
        self.g = [fixed((inertia[i - 2] - inertia[i - 1]) / inertia[i]) for i in range(3)]
        self.omega0 = [fixed(mpmath.mpf(w) / self.unit) for w in omega0]
        norm = mpmath.sqrt(sum(mpmath.mpf(x) ** 2 for x in q0))
        self.q0 = [fixed(mpmath.mpf(x) / norm) for x in q0]
        q = [mpmath.mpf(x) / norm for x in q0]
        self.L_axis = turned(q, unit([i * mpmath.mpf(w) for i, w in zip(inertia, omega0, strict=True)]))

    def after(self, duration):
        """ω and q (mpmath) at a time ``duration`` [s, mpmath]."""
        left = fixed(duration * self.unit)
        sign, left = (1, left) if left >= 0 else (-1, -left)
        w, q = self.omega0, self.q0
        while left:
            W, Q = expansion(self.g, w, q)
            h = min(longest_step(W + Q), left)
            w, q, left = at(W, sign * h), at(Q, sign * h), left - h
        return self.plain(w, q)

    def plain(self, w, q):
        return [mpmath.mpf(x) / ONE * self.unit for x in w], [mpmath.mpf(x) / ONE for x in q]

    def period(self):
        """Time [s] after which ω is as at the start, and the angle by which the body has turned about L."""
        w, q, now = self.omega0, self.q0, 0
        ahead = [c[1] for c in expansion(self.g, w, q)[0]]
        size = mpmath.mpf(max(map(abs, ahead)))
        ahead = [fixed(x / size) for x in ahead]

        def beyond(values):
            return sum(map(mul, [a - b for a, b in zip(values, self.omega0, strict=True)], ahead)) >> BITS

        before = 0
        while True:
            W, Q = expansion(self.g, w, q)
            h = longest_step(W + Q)
            after = beyond(at(W, h))
            if before < 0 <= after:
                low, high = 0, h
                while high - low > 1:
                    middle = (low + high) // 2
                    low, high = (middle, high) if beyond(at(W, middle)) < 0 else (low, middle)
                end_w, end_q = at(W, high), at(Q, high)
                if max(abs(a - b) for a, b in zip(end_w, self.omega0, strict=True)) < ONE >> 100:
                    return mpmath.mpf(now + high) / ONE / self.unit, self.angle(end_q)
            w, q, now, before = at(W, h), at(Q, h), now + h, after

    def angle(self, q):
        turn = product([mpmath.mpf(x) / ONE for x in q], conjugate([mpmath.mpf(x) / ONE for x in self.q0]))
        return 2 * mpmath.atan2(sum(map(mul, turn[:3], self.L_axis)), turn[3])

    def late(self, duration):
        period, angle = self.period()
        whole = mpmath.nint(duration / period)
        w, q = self.after(duration - whole * period)
        half = whole * angle / 2
        turn = [*(mpmath.sin(half) * x for x in self.L_axis), mpmath.cos(half)]
        return w, product(turn, q)


def product(p, q):
    (a, b, c, d), (e, f, g, h) = p, q
    return [
        d * e + a * h + b * g - c * f,
        d * f + b * h + c * e - a * g,
        d * g + c * h + a * f - b * e,
        d * h - a * e - b * f - c * g,
    ]


def conjugate(q):
    return [-q[0], -q[1], -q[2], q[3]]


def turned(q, vector):
    return product(product(q, [*vector, mpmath.mpf(0)]), conjugate(q))[:3]


def unit(vector):
    norm = mpmath.sqrt(sum(x * x for x in vector))
    return [x / norm for x in vector] if norm else vector


def bodies(random_number):
    """Moments of random bodies, the squares of their extents over six decades."""
    a, b, c = (10 ** random_number.uniform(-6, 0) for _ in range(3))
    size = 10 ** random_number.uniform(-3, 3)
    return [size * (b + c), size * (a + c), size * (a + b)]


def on_separatrix(moments, omega1):
    """The ω3 of the separatrix through (ω1, 0, ω3), moments ascending."""
    I1, I2, I3 = (mpmath.mpf(x) for x in moments)
    return mpmath.mpf(omega1) * mpmath.sqrt(I1 * (I2 - I1) / (I3 * (I3 - I2)))


def cases(rng):
    """(name, moments, ω0, t, late): every kind of free top there is, from exact doubles."""

    def direction():
        return [rng.gauss(0, 1) for _ in range(3)]

    def shuffled(moments, omega):
        order = rng.sample(range(3), 3)
        return [moments[i] for i in order], [omega[i] for i in order]

    for _ in range(128):
        speed = 10 ** rng.uniform(-2, 3.6)
        omega = [speed * x for x in direction()]
        t = rng.choice([-1, 1]) * rng.uniform(1, 80) / math.hypot(*omega)
        yield "random", *shuffled(bodies(rng), omega), t, False
    for distance in (1e-4, 1e-8, 1e-12, 1e-15):
        for side in (-1, 1):
            for _ in range(4):
                moments = sorted(rng.uniform(0.6, 1.1) for _ in range(3))
                omega1 = rng.uniform(0.5, 2) * rng.choice([-1, 1])
                omega3 = float(on_separatrix(moments, omega1) * (1 + side * mpmath.mpf(distance)))
                t = rng.choice([-1, 1]) * rng.uniform(10, 60)
                yield (
                    f"separatrix {side * distance:+.0e}",
                    *shuffled(moments, [omega1, 0.0, omega3]),
                    t,
                    False,
                )
    # I1(I2 − I1)ω1² = I3(I3 − I2)ω3² holds in exact arithmetic for 1, 2, 2.25 and ω1 : ω3 = 3 : 4.
    kick = 2.0**-10
    for omega in (
        *([3.0, 0.0, 4.0], [-3.0, 0.0, 4.0], [3.0, 0.5, -4.0], [-0.75, 0.25, -1.0]),
        *([1.5, -2.0, 2.0], [3 * kick, 1.0, 4 * kick]),
    ):
        yield "on the separatrix", *shuffled([1.0, 2.0, 2.25], omega), 17.0, False
    for _ in range(14):
        moments = [1.0, 1.0 - rng.choice([0.0, 1e-7, 5e-7]), 1e-6]
        omega = [rng.gauss(0, 1), rng.gauss(0, 1), rng.choice([1.0, 100.0, 4000.0])]
        yield "needle", *shuffled(moments, omega), rng.uniform(5, 40) / math.hypot(*omega), False
    for _ in range(14):
        a, b = (round(rng.uniform(0.1, 1), 3) * 1024 // 1 / 1024 for _ in range(2))
        omega = [rng.choice([1, 4000]) * x for x in direction()]
        yield "plate", *shuffled([a, b, a + b], omega), -rng.uniform(5, 40) / math.hypot(*omega), False
    for pair in ((0, 1), (1, 2), (2, 0)):
        for other in (0.02, 0.004, 0.010000000000001):
            moments = [other] * 3
            moments[pair[0]] = moments[pair[1]] = 0.01
            for _ in range(2):
                omega = [3 * x for x in direction()]
                yield "symmetric", moments, omega, rng.uniform(-15, 15), False
    for _ in range(8):
        moments = [1.0, 1 + rng.uniform(-1, 1) * 1e-13, 1 + rng.uniform(-1, 1) * 10 ** rng.uniform(-14, -2)]
        yield "nearly spherical", moments, direction(), rng.uniform(5, 40), False
    yield "spherical", [0.3, 0.3, 0.3], [1.0, -2.0, 0.5], 11.0, False
    for axis in range(3):
        for kick in (0.0, 1e-2, 1e-8):
            omega = [kick * x for x in direction()]
            omega[axis] = rng.choice([-2.0, 2.0])
            yield f"about axis {axis}, kick {kick:.0e}", [1.0, 2.0, 2.5], omega, rng.uniform(20, 40), False
    for speed in (1.0, 4000.0):
        for _ in range(8):
            omega = [speed * x for x in direction()]
            yield "t = 1000 s", *shuffled(bodies(rng), omega), rng.choice([-1000.0, 1000.0]), True
        for distance in (1e-8, 1e-12):
            for side in (-1, 1):
                moments = sorted(rng.uniform(0.6, 1.1) for _ in range(3))
                omega3 = float(on_separatrix(moments, speed) * (1 + side * mpmath.mpf(distance)))
                name = f"separatrix {side * distance:+.0e}, t = 1000 s"
                yield name, *shuffled(moments, [speed, 0.0, omega3]), 1000.0, True
    yield "needle, t = 1000 s", [1.0, 0.9999995, 1e-6], [1.0, -0.5, 4000.0], 1000.0, True


def golden(name, moments, q0, omega0, t, late):
    motion = Motion(moments, q0, omega0)
    omega, q = motion.late(mpmath.mpf(t)) if late else motion.after(mpmath.mpf(t))
    text = {"omega": [mpmath.nstr(x, DIGITS) for x in omega], "q": [mpmath.nstr(x, DIGITS) for x in q]}
    return {"name": name, "moments": moments, "q0": q0, "omega0": omega0, "t": t, **text}


def inputs():
    rng = random.Random(1834)
    for name, moments, omega0, t, late in cases(rng):
        q0 = [rng.gauss(0, 1) for _ in range(4)]
        norm = math.hypot(*q0)
        yield name, moments, [x / norm for x in q0], omega0, t, late


def check(goldens, every):
    """The worst relative difference in a few cases; late ones are integrated all the way if that is short."""
    worst = 0.0
    for place, (case, kept) in enumerate(zip(inputs(), goldens, strict=True)):
        name, moments, q0, omega0, t, late = case
        if place % every or (late and math.hypot(*omega0) * abs(t) > 3000):
            continue
        found = golden(name, moments, q0, omega0, t, False)
        for key in ("omega", "q"):
            a, b = ([mpmath.mpf(x) for x in side[key]] for side in (found, kept))
            gap = mpmath.sqrt(sum((x - y) ** 2 for x, y in zip(a, b, strict=True)) / sum(x * x for x in b))
            worst = max(worst, float(gap))
    return worst


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--check", action="store_true", help="recompute a few cases and compare")
    parser.add_argument("--every", type=int, default=20, help="with --check: every how many cases")
    arguments = parser.parse_args()
    if arguments.check:
        worst = check(json.loads(FILE.read_text()), arguments.every)
        sys.stdout.write(f"worst relative difference {worst:.1e}\n")
        return 0 if worst < 1e-28 else 1
    lines = [json.dumps(golden(*case)) for case in inputs()]
    FILE.write_text("[\n" + ",\n".join(lines) + "\n]\n")
    sys.stdout.write(f"{len(lines)} cases\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
