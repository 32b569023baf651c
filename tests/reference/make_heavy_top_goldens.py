"""Motions of heavy symmetric tops to thirty digits, by Taylor series of the equations of motion.

Owes nothing to elliptic or theta functions, nor to Euler's angles: with the vertical γ = R(q)ᵀẑ in body axes,

    I1 ω̇1 = (I1 − I3) ω2ω3 + Mgl γ2,    I1 ω̇2 = (I3 − I1) ω3ω1 − Mgl γ1,    ω̇3 = 0,    q̇ = ½ q ω

expanded to order 50 at each step in fixed-point integers of 256 bits, from doubles taken exactly. A step's
truncation is below 2⁻¹⁶⁰, so that thirty digits are left at the end even of motions that pass 10⁻¹² from
the separatrix.

    python make_heavy_top_goldens.py           writes heavy_top_goldens.json beside it (some 20 minutes)
    python make_heavy_top_goldens.py --check   recomputes a few, at another order and step, and compares
"""

import argparse
import json
import math
import random
import sys
from fractions import Fraction
from operator import mul
from pathlib import Path

FILE = Path(__file__).with_name("heavy_top_goldens.json")
DIGITS = 32
G = 9.81


class Series:
    """Fixed-point Taylor series of one motion, time counted in units of 1/``rate``."""

    def __init__(self, top, bits, order, truncation):
        self.bits, self.order, self.truncation = bits, order, truncation
        I1, I3 = (Fraction(m) for m in top["moments"])
        weight = Fraction(top["mass"]) * Fraction(top["length"]) * Fraction(top["gravity"]) / I1
        q, omega = [Fraction(v) for v in top["q0"]], [Fraction(v) for v in top["omega0"]]
        fastest = max(*(abs(float(w)) for w in omega), math.sqrt(weight), 1e-300)
        self.rate = Fraction(2) ** (math.frexp(fastest)[1])
        norm = math.isqrt(int(sum(v * v for v in q) * (1 << 2 * bits)))
        self.q = [int(v * (1 << 2 * bits)) // norm for v in q]
        self.omega = [self.fixed(w / self.rate) for w in omega]
        self.weight = self.fixed(weight / self.rate**2)
        self.spin = self.fixed((I1 - I3) / I1 * omega[2] / self.rate)

    def fixed(self, value):
        return (value.numerator << self.bits) // value.denominator

    def expansion(self):
        """Taylor coefficients of q (4 lists) and of ω1, ω2."""
        bits, w3 = self.bits, self.omega[2]
        x, y, z, w = ([v] for v in self.q)
        a, b = [self.omega[0]], [self.omega[1]]
        for n in range(self.order):
            back = [v[::-1] for v in (x, y, z, w)]

            def product(one, other):
                return sum(map(mul, one, other))

            g1 = 2 * (product(x, back[2]) - product(w, back[1])) >> bits
            g2 = 2 * (product(y, back[2]) + product(w, back[0])) >> bits
            over = (n + 1) << bits
            rates = (
                product(a, back[3]) - product(b, back[2]) + y[n] * w3,
                product(b, back[3]) + product(a, back[2]) - x[n] * w3,
                product(b, back[0]) - product(a, back[1]) + w[n] * w3,
                -product(a, back[0]) - product(b, back[1]) - z[n] * w3,
            )
            faster = (self.spin * b[n] + self.weight * g2, -self.spin * a[n] - self.weight * g1)
            for series, rate in zip((x, y, z, w), rates, strict=True):
                series.append(rate // (2 * over))
            a.append(faster[0] // over)
            b.append(faster[1] // over)
        return x, y, z, w, a, b

    def advance(self, duration):
        """Move the state by ``duration`` [s, exact], of either sign."""
        left = self.fixed(duration * self.rate)
        while left:
            series = self.expansion()
            step = max(-self.longest(series), min(left, self.longest(series)))
            values = []
            for coefficients in series:
                total = 0
                for c in reversed(coefficients):
                    total = (total * step >> self.bits) + c
                values.append(total)
            self.q, self.omega[:2] = values[:4], values[4:]
            left -= step

    def longest(self, series):
        """The step whose first neglected terms are about 2^−truncation, at most 2 of the units of time."""
        logs = [0.7]
        for n in (self.order - 1, self.order):
            largest = max(abs(c[n]) for c in series)
            if largest:
                logs.append((self.bits - self.truncation - largest.bit_length()) / n * math.log(2))
        return int(math.exp(min(logs)) * 2**40) << (self.bits - 40)

    def state(self):
        """The state as decimal text: q to 32 decimals, ω to 32 significant digits of the largest."""
        q = [decimal(v, self.bits, DIGITS) for v in self.q]
        scale = max(abs(v) for v in self.omega)
        places = DIGITS
        if scale:
            places -= math.floor(math.log10(scale / 2**self.bits * float(self.rate)))
        omega = [decimal(v * self.rate, self.bits, places) for v in self.omega]
        return q, omega


def decimal(value, bits, places):
    """value·2^−bits rounded to so many decimal places."""
    whole = round(Fraction(value) / (1 << bits) * Fraction(10) ** places)
    return f"{whole}e{-places}"


def golden(top, bits=256, order=50, truncation=160):
    """The states of ``top`` at its times, each reached from the one before in the order of size."""
    found = {}
    for sign in (1, -1):
        series, now = Series(top, bits, order, truncation), Fraction(0)
        for t in sorted((t for t in top["t"] if t * sign > 0 or (t == 0 and sign > 0)), key=abs):
            series.advance(Fraction(t) - now)
            now = Fraction(t)
            found[t] = series.state()
    return {**top, "q": [found[t][0] for t in top["t"]], "omega": [found[t][1] for t in top["t"]]}


def about(axis, angle):
    """A quaternion from doubles: not quite of unit length, as every such one."""
    length = math.sqrt(sum(c * c for c in axis))
    return [c / length * math.sin(angle / 2) for c in axis] + [math.cos(angle / 2)]


def tilted(theta):
    return about((1, 0, 0), theta)


def any_attitude(r):
    q = [r.gauss(0, 1) for _ in range(4)]
    length = math.sqrt(sum(c * c for c in q))
    return [c / length for c in q]


def decades(r, low, high):
    return 10 ** r.uniform(low, high)


def top(name, q0, omega0, t, mass=1.0, length=0.1, moments=(0.02, 0.01), gravity=G):
    return {
        "name": name,
        "mass": mass,
        "length": length,
        "moments": list(moments),
        "gravity": gravity,
        "q0": list(q0),
        "omega0": list(omega0),
        "t": list(t),
    }


def random_top(r, i):
    """Any top at all: mass, size, shape and spin over several decades, a few to a hundred swings."""
    mass, length, gravity = decades(r, -3, 3), decades(r, -2, 1), decades(r, -1, 2)
    I1 = mass * length**2 * decades(r, 0.05, 1)
    I3 = I1 * r.choice([decades(r, -3, 0), r.uniform(0.5, 2)])
    swing = math.sqrt(mass * gravity * length / I1)
    across = swing * decades(r, -2, 1)
    direction = r.uniform(0, 2 * math.pi)
    spin = r.choice([-1, 1]) * swing * I1 / I3 * decades(r, -1.5, 1.2)
    omega = [across * math.cos(direction), across * math.sin(direction), spin]
    fastest = max(swing, across, abs(spin) * max(I3 / I1, 0.05))
    t = [r.uniform(0.2, 3) / fastest, r.choice([-1, 1]) * decades(r, 0.7, 1.9) / fastest]
    return top(f"random {i}", any_attitude(r), omega, t, mass, length, (I1, I3), gravity)


def near_separatrix(r):
    """E′ = Mgl(1 + ε/2) and p_α = p_γ: ε apart from creeping up to the vertical for ever."""
    for epsilon in (1e-8, -1e-8, 1e-12, -1e-12, 1e-4, -1e-4):
        for slack in (0.0, 0.3, 0.9):
            I1, I3 = 0.02, r.uniform(0.002, 0.03)
            k = 2 * 0.1 * G / I1
            a = slack * math.sqrt(2 * k) * r.choice([-1, 1])
            low = 2 - a * a / k
            d = low * r.uniform(0.2, 0.8)
            squared = d * (2 - d)
            theta = math.acos(1 - d)
            # ω1 along β̇, ω2 sin β from p_α = p_γ: b − au = ad.
            omega2 = a * d / math.sqrt(squared)
            omega1 = math.sqrt(k * (d + epsilon) - omega2 * omega2)
            omega = [omega1 * r.choice([-1, 1]), omega2, a * I1 / I3]
            yield top(
                f"separatrix {epsilon:g}, spin {slack}", tilted(theta), omega, [2.0, -7.5], moments=(I1, I3)
            )
        speed = 2 * math.sqrt(0.1 * G / 0.02) * (1 + epsilon)
        yield top(f"pendulum's separatrix {epsilon:g}", [1, 0, 0, 0], [speed, 0, 0], [3.0, -1.0])
        yield top(f"pendulum's separatrix {epsilon:g}, 100 s", [1, 0, 0, 0], [0, speed, 0], [100.0])
    for kick in (1e-3, 1e-8, 1e-12):
        yield top(f"asleep too slowly, kicked by {kick:g}", [0, 0, 0, 1], [kick, 0, 20.0], [2.0, 9.0])
        yield top(f"asleep too slowly, tilted by {kick:g}", tilted(kick), [0, 0, 20.0], [2.0, 9.0])
    yield top("the separatrix itself", [1, 0, 0, 0], [2, 0, 0], [0.5, -3, 20], 1.0, 1.0, (1.0, 0.5), 1.0)
    yield top("upright, not moving, not asleep", [0, 0, 0, 1], [0, 0, 1], [30.0], 1.0, 1.0, (1.0, 0.5), 1.0)


def textbook(r):
    """The motions that books draw, and those through which angles cannot be followed."""
    for theta in (0.1, 0.6, 1.5, 2.5, 3.1):
        for spin in (2.0, 40.0, -300.0):
            yield top(f"cusps from {theta}, spin {spin}", tilted(theta), [0, 0, spin], [0.3, 4.0])
    for theta in (0.3, 1.2, 2.0, 3.0):
        for push in (-6.0, -1.0, 0.3, 5.0):
            omega = [0.0, push * math.sin(theta), 60.0]
            yield top(f"pushed by {push} at {theta}", tilted(theta), omega, [0.2, -5.0])
    for theta in (0.2, 1.0, 1.6, 2.6):
        a = 60.0 * 0.01 / 0.02
        c = math.cos(theta)
        rate = 0.1 * G / 0.02 * 2 / (a + math.sqrt(a * a - 4 * c * 0.1 * G / 0.02))
        for off in (0.0, 1e-8, 1e-3):
            omega = [off, rate * math.sin(theta), 60.0]
            yield top(f"regular at {theta}, off by {off:g}", tilted(theta), omega, [0.7, 12.0])
    yield top("exactly regular", [0.5, 0.5, 0.5, 0.5], [0, 1, 2], [3.0, 77.0], 1.0, 1.0, (1.0, 0.5), 1.0)
    for spin in (29.0, 28.1, 28.0, 27.9, 25.0):
        for kick in (0.0, 1e-8, 0.5):
            yield top(f"upright at {spin}, kicked by {kick:g}", [0, 0, 0, 1], [0, kick, spin], [1.0, -6.0])
    for spin in (0.0, 5.0, 90.0):
        for kick in (0.0, 1e-8, 2.0, 30.0):
            yield top(
                f"hanging at {spin}, kicked by {kick:g}", [0.6, 0.8, 0, 0], [kick, 0, spin], [1.0, -6.0]
            )
    for theta in (0.5, 1.3, 2.9, 1e-7):
        yield top(f"plane pendulum from {theta}", tilted(theta), [0, 0, 0], [0.4, 6.0])
        yield top(f"plane pendulum at {theta}, swung", tilted(theta), [3.0, 0, 0], [0.4, -6.0])
        yield top(f"spherical pendulum at {theta}", tilted(theta), [0.5, 4.0, 0], [0.4, 6.0])
        yield top(f"near the vertical {theta}", any_attitude(r), [1.0, 4.0, 1e-9], [0.4, 6.0])


def extreme(r):
    """Shapes, speeds and times at the ends of what the tests ask for."""
    for ratio in (1e-6, 1e-4):
        for spin in (4000.0, 100.0, 1.0):
            omega = [r.uniform(-3, 3), r.uniform(-3, 3), spin]
            yield top(f"needle {ratio:g} at {spin}", any_attitude(r), omega, [0.1, -1.5], moments=(1, ratio))
    for spin in (4000.0, 30.0, 1.0):
        omega = [r.uniform(-3, 3), r.uniform(-3, 3), spin]
        yield top(f"plate at {spin}", any_attitude(r), omega, [0.1, -1.5], moments=(0.02, 0.04))
        yield top(f"sphere at {spin}", any_attitude(r), omega, [0.1, -1.5], moments=(0.02, 0.02))
    for gravity in (1e-8, 1e-3, 1e5):
        omega = [r.uniform(-3, 3), r.uniform(-3, 3), r.uniform(-9, 9)]
        yield top(f"gravity {gravity:g}", any_attitude(r), omega, [0.5, 2.0], gravity=gravity)
    slow = {"mass": 2.0, "length": 0.3, "moments": (0.4, 0.1), "gravity": 1.0}
    for i in range(8):
        omega = [r.uniform(-1, 1), r.uniform(-1, 1), [0.0, 2.0, -6.0, 9.0][i % 4]]
        yield top(f"a thousand seconds {i}", any_attitude(r), omega, [1000.0], **slow)
    speed = 2 * math.sqrt(0.6 / 0.4)
    for epsilon in (1e-8, -1e-8, 1e-12, -1e-12):
        omega = [speed * (1 + epsilon), 0, 0]
        yield top(f"a thousand seconds, {epsilon:g} off", [1, 0, 0, 0], omega, [1000.0], **slow)


def tops():
    r = random.Random(20240607)
    yield from (random_top(r, i) for i in range(220))
    yield from near_separatrix(r)
    yield from textbook(r)
    yield from extreme(r)


def write():
    lines = [json.dumps(golden(each), ensure_ascii=False) for each in tops()]
    FILE.write_text("[\n" + ",\n".join(lines) + "\n]\n", encoding="utf-8")


def check(places):
    """Whether a few of the stored states come out again at another order, step and precision."""
    stored = json.loads(FILE.read_text(encoding="utf-8"))
    wanted = list(tops())
    for place in places:
        again = golden(wanted[place], bits=300, order=60, truncation=190)
        for key in ("q", "omega"):
            for old, new in zip(stored[place][key], again[key], strict=True):
                worst = max(abs(Fraction(a) - Fraction(b)) for a, b in zip(old, new, strict=True))
                size = max(abs(Fraction(b)) for b in new)
                if worst > Fraction(1, 10**30) * size:
                    return f"{wanted[place]['name']}: {key} differs by {float(worst):.3g}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="recompute a few and compare")
    if not parser.parse_args().check:
        write()
        return 0
    fault = check([0, 119, 226, 270, 310, 358])
    sys.stdout.write(f"{fault}\n" if fault else "the same to 30 digits\n")
    return 1 if fault else 0


if __name__ == "__main__":
    sys.exit(main())
