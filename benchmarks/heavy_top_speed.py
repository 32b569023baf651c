"""What the exact motion of a heavy top costs: ``python benchmarks/heavy_top_speed.py [repeats]``.

First the time of a case (its scalars, once) and of a time point among 100 000. Then one point at t = 1000 s
beside `scipy.integrate.solve_ivp` (DOP853, rtol 1e-13): times, and errors against the thirty-digit motions
in tests/reference/heavy_top_goldens.json, which come from Taylor series; at last the worst error over all of
them. Times are this process's own, so that a busy machine does not show in them.
"""

import json
import sys
import time
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from poinsot.reference import quaternions
from poinsot.reference.heavy_top import motion
from scipy.integrate import solve_ivp

GOLDENS = Path(__file__).parents[1] / "tests" / "reference" / "heavy_top_goldens.json"
ARGUMENTS = ("mass", "length", "moments", "gravity", "q0", "omega0", "t")
TIMES = 100_000
TOP = (1.0, 1.0, (1.0, 0.5), 1.0)
STARTS = {
    "cusps": ([0.6, 0.0, 0.0, 0.8], [0.0, 0.0, 7.0]),
    "any": ([0.1, -0.5, 0.7, 0.5], [0.4, 0.9, 3.0]),
    "on the separatrix": ([1.0, 0.0, 0.0, 0.0], [2.0, 0.0, 0.0]),
    "1e-8 beside it": ([1.0, 0.0, 0.0, 0.0], [2.0 + 2e-8, 0.0, 0.0]),
    "kicked from sleep": ([0.0, 0.0, 0.0, 1.0], [1e-3, 0.0, 2.0]),
    "regular": ([0.5, 0.5, 0.5, 0.5], [0.0, 1.0, 2.0]),
    "asleep": ([0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 9.0]),
}


def fastest(action: Callable[[], object], repeats: int) -> float:
    """The least time [s] that ``action`` takes; the first call, which fills caches, is not counted."""
    action()
    seconds = []
    for _ in range(repeats):
        start = time.process_time()
        action()
        seconds.append(time.process_time() - start)
    return min(seconds)


def cost(repeats: int) -> list[str]:
    """Lines of a table: milliseconds a case and microseconds a time point."""
    t, lines = np.linspace(0.0, 1000.0, TIMES), ["top                    ms a case   µs a time point"]
    for name, (q0, omega0) in STARTS.items():

        def run(t: np.ndarray, q0: list[float] = q0, omega0: list[float] = omega0) -> object:
            return motion(*TOP, q0, omega0, t)

        once, many = (fastest(lambda t=t, run=run: run(t), repeats) for t in (t[-1:], t))
        lines.append(f"{name:22s} {once * 1e3:9.2f} {(many - once) / TIMES * 1e6:17.3f}")
    return lines


def integrated(golden: dict[str, Any], t: float) -> tuple[np.ndarray, np.ndarray]:
    """Attitude (4,) and ω (3,) [rad/s] at t [s], by DOP853 at rtol 1e-13."""
    I1, I3 = golden["moments"]
    moment = golden["mass"] * golden["length"] * golden["gravity"]

    def rate(_: float, y: np.ndarray) -> list[float]:
        x, y_, z, w, a, b, c = y.tolist()
        up1, up2 = 2 * (x * z - w * y_), 2 * (y_ * z + w * x)
        half_q = (
            w * a + y_ * c - z * b,
            w * b + z * a - x * c,
            w * c + x * b - y_ * a,
            -x * a - y_ * b - z * c,
        )
        omega = (((I1 - I3) * b * c + moment * up2) / I1, ((I3 - I1) * c * a - moment * up1) / I1, 0.0)
        return [*(0.5 * v for v in half_q), *omega]

    start = np.array([*golden["q0"], *golden["omega0"]])
    end = solve_ivp(rate, (0.0, t), start, "DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    return end[:4] / np.linalg.norm(end[:4]), end[4:]


def errors(golden: dict[str, Any], place: int, q: np.ndarray, omega: np.ndarray) -> tuple[float, float]:
    """Attitude error [rad] and error of ω relative to |ω| at the time number ``place``."""
    true_q, true_omega = ([Fraction(x) for x in golden[key][place]] for key in ("q", "omega"))
    off_q = np.array([float(Fraction(float(a)) - b) for a, b in zip(q, true_q, strict=True)])
    off_omega = np.array([float(Fraction(float(a)) - b) for a, b in zip(omega, true_omega, strict=True)])
    near = np.array([float(x) for x in true_q])
    speed = float(np.linalg.norm([float(x) for x in true_omega]))
    # Twice the vector part of q̄ times the difference: the turn between the two, where it is small.
    turn = 2 * quaternions.product(quaternions.conjugate(near), off_q)[:3]
    return float(np.linalg.norm(turn)), float(np.linalg.norm(off_omega)) / (speed or 1.0)


def against_integration(goldens: list[dict[str, Any]], repeats: int) -> list[str]:
    """Lines of a table: one point at t = 1000 s, exact and integrated."""
    lines = [
        "one point at t = 1000 s        exact: ms    rad     ω  DOP853: s    rad     ω   faster   more exact"
    ]
    for golden in goldens:
        if golden["t"] != [1000.0]:
            continue
        arguments = [golden[key] for key in ARGUMENTS]
        seconds = fastest(lambda arguments=arguments: motion(*arguments), repeats)
        q, omega = motion(*arguments)
        start = time.process_time()
        end = integrated(golden, 1000.0)
        slow = time.process_time() - start
        ours, theirs = errors(golden, 0, q[0], omega[0]), errors(golden, 0, *end)
        row = (seconds * 1e3, *ours, slow, *theirs, slow / seconds, max(theirs) / max(*ours, 1e-16))
        lines.append(
            "{:30s} {:9.2f} {:.0e} {:.0e} {:10.2f} {:.0e} {:.0e} {:8.0f} {:12.0e}".format(
                golden["name"], *row
            )
        )
    return lines


def worst(goldens: list[dict[str, Any]]) -> list[str]:
    """One line: the largest errors over all stored states."""
    found = []
    for golden in goldens:
        q, omega = motion(*(golden[key] for key in ARGUMENTS))
        found += [errors(golden, i, q[i], omega[i]) for i in range(len(golden["t"]))]
    attitude, rate = (max(column) for column in zip(*found, strict=True))
    return [f"worst of {len(found)} states of {len(goldens)} tops: {attitude:.1e} rad, {rate:.1e} of ω"]


def main() -> int:
    """Print the tables; the one argument is how often a measurement is repeated."""
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    goldens = json.loads(GOLDENS.read_text(encoding="utf-8"))
    for lines in (cost(repeats), against_integration(goldens, repeats), worst(goldens)):
        sys.stdout.write("\n".join(lines) + "\n\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
