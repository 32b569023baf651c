"""What the exact motion of a free top costs: ``python benchmarks/truth_speed.py [repeats]``.

First the time of a case (its scalars, once) and of a time point among 100 000. Then one point at t = 1000 s
beside `scipy.integrate.solve_ivp` (DOP853, rtol 1e-13): times, and errors against the thirty-digit motions
in tests/reference/torque_free_goldens.json, which come from Taylor series. Times are this process's own, so
that a busy machine does not show in them.
"""

import json
import math
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from poinsot.reference import quaternions
from poinsot.reference.torque_free import motion
from scipy.integrate import solve_ivp

GOLDENS = Path(__file__).parents[1] / "tests" / "reference" / "torque_free_goldens.json"
TIMES = 100_000
#: The integrator is asked for no more turns than these [rad]: a fast top would take it hours.
TURNS = 2500
TOPS = {
    "ordinary": ([1.0, 2.0, 2.5], [0.5, 0.75, 2.0]),
    "on the separatrix": ([1.0, 2.0, 2.25], [3.0, 0.0, 4.0]),
    "1e-8 beside it": ([1.0, 2.0, 2.25], [3.0, 0.0, 4.00000004]),
    "symmetric": ([1.0, 1.0, 1.5], [0.5, 0.75, 2.0]),
    "principal axis": ([1.0, 2.0, 2.5], [0.0, 0.75, 0.0]),
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
    for name, (moments, omega0) in TOPS.items():

        def run(t, moments=moments, omega0=omega0):
            return motion(moments, [0.0, 0.0, 0.0, 1.0], omega0, t)

        once, many = (fastest(lambda t=t, run=run: run(t), repeats) for t in (t[-1:], t))
        lines.append(f"{name:22s} {once * 1e3:9.2f} {(many - once) / TIMES * 1e6:17.3f}")
    return lines


def integrated(golden: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Attitude (4,) and ω (3,) [rad/s] at the golden's time, by DOP853 at rtol 1e-13."""
    I1, I2, I3 = golden["moments"]
    inverse = np.array([(I2 - I3) / I1, (I3 - I1) / I2, (I1 - I2) / I3])

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        x, y_, z, w, a, b, c = y
        half_q = 0.5 * np.array([w * a + y_ * c - z * b, w * b + z * a - x * c, w * c + x * b - y_ * a])
        scalar = -0.5 * (x * a + y_ * b + z * c)
        return np.array([*half_q, scalar, *(inverse * (b * c, c * a, a * b))])

    start = np.array([*golden["q0"], *golden["omega0"]])
    end = solve_ivp(rate, (0.0, golden["t"]), start, "DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    return end[:4] / np.linalg.norm(end[:4]), end[4:]


def errors(golden: dict[str, Any], q: np.ndarray, omega: np.ndarray) -> tuple[float, float]:
    """Attitude error [rad] and error of ω relative to |ω|, against thirty digits rounded to double."""
    true_q, true_omega = (np.array([float(x) for x in golden[key]]) for key in ("q", "omega"))
    turn = quaternions.rotation_vector(quaternions.product(quaternions.conjugate(true_q), q))
    return float(np.linalg.norm(turn)), float(np.linalg.norm(omega - true_omega) / np.linalg.norm(true_omega))


def against_integration(repeats: int) -> list[str]:
    """Lines of a table: one point at t = 1000 s, exact and integrated."""
    lines = [
        "one point at t = 1000 s        exact: ms    rad     ω  DOP853: s    rad     ω   faster   more exact"
    ]
    for golden in json.loads(GOLDENS.read_text()):
        if "t = 1000 s" not in golden["name"] or 1000 * math.hypot(*golden["omega0"]) > TURNS:
            continue
        arguments = (golden["moments"], golden["q0"], golden["omega0"], golden["t"])
        seconds = fastest(lambda arguments=arguments: motion(*arguments), repeats)
        q, omega = motion(*arguments)
        start = time.process_time()
        end = integrated(golden)
        slow = time.process_time() - start
        ours, theirs = errors(golden, q[0], omega[0]), errors(golden, *end)
        row = (seconds * 1e3, *ours, slow, *theirs, slow / seconds, max(theirs) / max(*ours, 1e-16))
        lines.append(
            "{:30s} {:9.2f} {:.0e} {:.0e} {:10.2f} {:.0e} {:.0e} {:8.0f} {:12.0e}".format(
                golden["name"], *row
            )
        )
    return lines


def main() -> int:
    """Print both tables; the one argument is how often a measurement is repeated."""
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    for lines in (cost(repeats), against_integration(repeats)):
        sys.stdout.write("\n".join(lines) + "\n\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
