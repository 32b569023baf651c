"""Results and motions as a run leaves them: realistic in every field, made by rule, no engine needed."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import pytest
from poinsot.reports import setup
from poinsot.reports.plots import Motion
from poinsot.reports.verdict import Status
from poinsot.scenarios import observables, pictures
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.scene import Scene
from poinsot.scenarios.trajectory import Provenance, Trajectory
from scipy.spatial.transform import Rotation


class Scheme(NamedTuple):
    engine: str
    version: str
    scheme: str
    twin: str
    order: int
    cost: float


SCHEMES = (
    Scheme("mujoco", "4.0.0", "Euler", "semi-implicit Euler", 1, 1.2e-6),
    Scheme("mujoco", "4.0.0", "implicit", "implicit gyroscopic", 1, 1.4e-6),
    Scheme("mujoco", "4.0.0", "implicitfast", "implicit gyroscopic", 1, 1.3e-6),
    Scheme("mujoco", "4.0.0", "RK4", "RKMK4", 4, 4.4e-6),
    Scheme("mujoco", "4.0.0", "discrete", "semi-implicit Euler", 1, 1.3e-6),
    Scheme("pybullet", "3.2.7", "reduced", "semi-implicit Euler", 1, 0.6e-6),
    Scheme("pybullet", "3.2.7", "maximal", "implicit gyroscopic", 1, 0.9e-6),
    Scheme("pinocchio", "4.1.0", "semi-implicit Euler", "semi-implicit Euler", 1, 2.2e-6),
    Scheme("pinocchio", "4.1.0", "implicit gyroscopic", "implicit gyroscopic", 1, 3.1e-6),
    Scheme("pinocchio", "4.1.0", "RKMK4", "RKMK4", 4, 9.5e-6),
    Scheme("drake", "", "radau", "radau3", 3, 20e-6),
    Scheme("drake", "", "runge_kutta3", "rk3", 3, 12e-6),
)

TOP_NAMES = (
    "free_symmetric_top[oblate]",
    "free_symmetric_top[prolate]",
    "heavy_top[moderate]",
    "heavy_top[fast]",
    "heavy_top[released_at_rest]",
    "co2_chain[translation]",
    "co2_chain[symmetric]",
    "co2_chain[antisymmetric]",
    "co2_chain[mixture]",
)
MORE_NAMES = (
    *("space_cone", "free_asymmetric_top", "middle_axis[1e-2]", "middle_axis[1e-8]", "poinsot_construction"),
    *(
        "euler_angles[zyz]",
        "euler_angles[zxz]",
        "regular_precession",
        "sleeping_top[0.99]",
        "sleeping_top[1.01]",
    ),
    *("hanging_gyroscope", "cone_top", "axis_theorems[welded]", "axis_theorems[offset]", "rotor_balance"),
    *("orbit_and_spin", "normal_modes[64]", "double_pendulum[large]", "car_pendulum", "turntable_puck"),
    *("coriolis_fall", "plumb_line", "tides", "stacked_turntables", "two_body[e=0.9]", "rocket"),
)

NO_BALL = "PyBullet's maximal coordinates have no ball joint with a spring."
LEAVES_FINITE = 'left the finite numbers at t = 1.25 s: "qvel & qacc" <inf>'


def _truth(scene: Scene, t: np.ndarray) -> Trajectory:
    """Steady precession: exact for the picture's purpose, and simple enough to be read here."""
    spin, nod = 5.0, 2.0
    turn = Rotation.from_rotvec(np.outer(t, [0, 0, nod])) * Rotation.from_rotvec([0.4, 0.0, 0.0])
    q = (turn * Rotation.from_rotvec(np.outer(t, [0, 0, spin]))).as_quat()
    omega = np.column_stack([np.cos(spin * t), np.sin(spin * t), np.full_like(t, 5.0)])
    nothing = np.zeros((len(t), 1, 3))
    return Trajectory(
        t, nothing, q[:, None], nothing, omega[:, None], np.empty((len(t), 0)), np.empty((len(t), 0))
    )


def scene(full_name: str) -> Scene:
    name, _, variant = full_name.rstrip("]").partition("[")
    return Scene(
        name=name,
        variant=variant,
        summary="A body whose axis circles the vertical at a steady rate.",
        source="Landau & Lifshitz, Mechanics, § 33",
        bodies=(Body("top", 1.0, diagonal(0.01, 0.01, 0.02), (Joint("free", "free"),)),),
        q0=(0, 0, 0, 0, 0, 0, 1),
        v0=(0, 0, 0, 1, 0, 5),
        duration=10.0,
        samples=500,
        truth=_truth,
        observables=(observables.orientation(),),
        pictures=(
            pictures.tip(),
            pictures.body_cone(),
            pictures.against_time("First component of ω", "ω1 [rad/s]", lambda scene, m: m.omega[:, 0, 0]),
        ),
    )


def _run(of: Scene, scheme: Scheme) -> Trajectory:
    """The truth, ahead of itself by the scheme's error, and out of bounds in the end for one."""
    t = of.sample_times()
    late = _truth(of, t * (1 + (0.02 if scheme.order == 1 else 1e-9)))
    omega = late.omega.copy()
    if scheme.scheme == "maximal":
        omega[200:] *= np.exp(np.minimum((t[200:] - t[200]) * 40, 700.0))[:, None, None]
        omega[400:] = np.nan
    source = Provenance(
        of.full_name, scheme.engine, scheme.version, scheme.scheme, scheme.order, scheme.twin, 1e-3, 10_000
    )
    return Trajectory(
        t, late.position, late.quaternion, late.velocity, omega, *[late.joint_position] * 2, source
    )


def motions(names: tuple[str, ...], schemes: tuple[Scheme, ...] = SCHEMES) -> Iterator[Motion]:
    """Pictures for every scene, of the schemes that ran."""
    for of in map(scene, names):
        yield Motion(of, tuple(_run(of, scheme) for scheme in schemes if scheme.version))


#: Check, observable, unit, error constant, whether it may be at round-off.
CHECKS = (
    ("truth", "orientation", "rad", 12.0),
    ("truth", "omega", "rad/s", 40.0),
    ("truth", "Omega_b", "rad/s", 0.5),
    ("invariant", "energy", "J", 3.0),
    ("invariant", "angular momentum", "kg m²/s", 0.4),
    ("invariant", "quaternion norm", "1", 0.0),
    ("setup", "inertia", "kg m²", 0.0),
    ("determinism", "states", "1", 0.0),
)


def _verdict(
    check: str, observable: str, unit: str, measured: float, allowed: float, at: float | None
) -> dict:
    status = Status.PASS if measured <= allowed else Status.FAIL
    compared = "within" if status is Status.PASS else "beyond"
    return {
        "check": check,
        "observable": observable,
        "status": status.value,
        "measured": measured,
        "allowed": allowed,
        "unit": unit,
        "at": at,
        "message": f"{observable}: {measured:.3g} {unit}, {compared} its {allowed:.3g} {unit}",
    }


def _verdicts(scheme: Scheme, dt: float, main: bool, draw: np.random.Generator) -> list[dict[str, Any]]:
    result = []
    for check, observable, unit, constant in CHECKS:
        share, at = draw.uniform(0.3, 0.95), float(np.round(draw.uniform(0, 10), 2))
        allowed = 1.5 * constant * dt**scheme.order if constant else 1e-12
        result.append(_verdict(check, observable, unit, allowed * share, allowed, at if constant else None))
    if main:
        order = scheme.order + draw.uniform(-0.05, 0.05)
        said = f"order {order:.2f} over five steps, declared {scheme.order}"
        result.append(
            {**_verdict("order", "orientation", "1", order, 0.2, None), "status": "pass", "message": said}
        )
        result.append(_verdict("twin", "orientation", "rad", 3e-14, 1e-12 + 1e-13 * 12, 9.98))
    return result


def _ladder(scheme: Scheme) -> list[float]:
    finest = 1.25e-4 if scheme.order == 1 else 1.25e-3
    return sorted({1e-3, *(finest * 2**k for k in range(5))}, reverse=True)


def _judged(verdicts: list[dict[str, Any]]) -> str:
    found = {verdict["status"] for verdict in verdicts}
    return next(s for s in ("error", "fail", "fixed", "known", "pass") if s in found)


def _with_oddities(name: str, scheme: Scheme, dt: float, cell: dict[str, Any]) -> dict[str, Any]:
    """The few places where something is not a pass, so that every status occurs."""
    if not scheme.version:
        return {
            **cell,
            "status": "unavailable",
            "verdicts": [],
            "log": None,
            "message": "drake is not installed.",
        }
    if scheme.scheme == "maximal" and name.startswith("co2_chain"):
        return {**cell, "status": "unsupported", "verdicts": [], "log": None, "message": NO_BALL}
    if scheme.scheme == "maximal" and name == "heavy_top[fast]" and dt >= 1e-3:
        return {**cell, "status": "error", "verdicts": [], "log": None, "message": LEAVES_FINITE}
    verdicts = [dict(verdict) for verdict in cell["verdicts"]]
    first = verdicts[0]
    if scheme.scheme == "reduced" and name == "heavy_top[moderate]":
        worse = _verdict(
            first["check"], first["observable"], first["unit"], 7 * first["allowed"], first["allowed"], 4.2
        )
        verdicts[0] = worse
    if scheme.scheme == "discrete" and name.startswith("free_symmetric_top"):
        first.update(
            status="known",
            message="MuJoCo's discrete scheme drops the gyroscopic term; recorded bound 3.5e-1 rad.",
        )
    if scheme.scheme == "implicitfast" and name == "co2_chain[mixture]":
        first.update(
            status="fixed", message="The recorded deviation of 2.00e-02 rad is gone: remove its record."
        )
    if scheme.engine == "pybullet":
        note = "Accelerations cannot be read in maximal coordinates or with gravity off."
        verdicts.append(
            {
                **first,
                "check": "acceleration",
                "observable": "all coordinates",
                "status": "unsupported",
                "measured": None,
                "allowed": None,
                "unit": "",
                "at": None,
                "message": note,
            }
        )
    return {**cell, "verdicts": verdicts, "status": _judged(verdicts)}


def _cell(name: str, scheme: Scheme, dt: float, draw: np.random.Generator) -> dict[str, Any]:
    cell = {
        "scene": name,
        "engine": scheme.engine,
        "engine_version": scheme.version,
        "scheme": scheme.scheme,
        "twin": scheme.twin,
        "order": scheme.order,
        "dt": dt,
        "steps": round(10 / dt),
        "status": "pass",
        "log": f"logs/{name}-{scheme.engine}-{scheme.scheme}-{dt:g}.mcap".replace(" ", "_"),
        "message": "",
        "settings": {"velocity limit": "none", "auto-reset": "off"} if scheme.engine == "mujoco" else {},
        "verdicts": _verdicts(scheme, dt, dt == 1e-3, draw),
    }
    return _with_oddities(name, scheme, dt, cell)


def _costs(cells: list[dict[str, Any]], timed: bool) -> Iterator[dict[str, Any]]:
    cost = {(s.engine, s.scheme): s.cost for s in SCHEMES}
    for cell in cells:
        for verdict in cell["verdicts"]:
            if verdict["check"] != "truth":
                continue
            seconds = cell["steps"] * cost[cell["engine"], cell["scheme"]] if timed else None
            yield {
                **{key: cell[key] for key in ("scene", "engine", "engine_version", "scheme", "dt", "steps")},
                "observable": verdict["observable"],
                "unit": verdict["unit"],
                "error": max(verdict["measured"] / 1.3, 3e-13),
                "seconds_min": seconds,
                "seconds_median": seconds and seconds * 1.04,
                "repeats": 10 if timed else 0,
            }


def make_results(
    names: tuple[str, ...] = TOP_NAMES, schemes: tuple[Scheme, ...] = SCHEMES, timed: bool = True
) -> dict[str, Any]:
    """What results.json of such a run holds."""
    draw = np.random.default_rng(1)
    cells = [_cell(name, scheme, dt, draw) for name in names for scheme in schemes for dt in _ladder(scheme)]
    return {
        "schema": "poinsot.results/1",
        "environment": {
            "poinsot": "0.1.0",
            "python": "3.11.2",
            "platform": "Linux-6.1-x86_64-with-glibc2.36",
            "cpu": "AMD EPYC 9B14",
            "cores": 2,
            "numpy": "2.4.6",
            "scipy": "1.17.1",
            "engines": {"mujoco": "4.0.0", "pybullet": "3.2.7", "pinocchio": "4.1.0"},
            "command": "poinsot run --out out",
            "started": "2026-01-31T12:00:00+00:00",
            "seconds": 48.7,
        },
        "scenes": {
            name: {
                "summary": "A free top: ω turns about the body's axis at Ω_b, the axis about L at L/I1.",
                "source": "Landau & Lifshitz, Mechanics, § 33; Goldstein, Classical Mechanics, ch. 5.6",
                "features": ["free"],
                "left_out": [
                    "hinges",
                    "gravity",
                    "collision shapes",
                    "contact solver",
                    "actuators",
                    "ground",
                ],
                "duration": 10.0,
                "samples": 500,
            }
            for name in names
        },
        "cells": cells,
        "work_precision": list(_costs(cells, timed)),
        "notes": ["No twin check on heavy_top[fast]: a kick of 1e-9 grows by 3.2e+06, more than 1e+06."],
    }


@pytest.fixture(scope="session")
def results() -> dict[str, Any]:
    """Nine scene variants in twelve schemes, with every status; not to be changed."""
    return make_results()


@pytest.fixture(scope="session")
def remade() -> Callable[..., dict[str, Any]]:
    """Makes results of one's own: of other scenes or schemes, timed or not, free to be changed."""
    return make_results


@pytest.fixture(scope="session")
def moved() -> Callable[..., Iterator[Motion]]:
    """Makes the motions of some scenes."""
    return motions


@pytest.fixture(scope="session")
def ahead() -> Callable[..., Trajectory]:
    """Makes the run of a scheme that is right but for its clock: it runs fast by the part c·dt^order.

    Its error is of that order in everything that moves; ``changes`` go into its provenance.
    """

    def make(of: Scene, dt: float, order: int = 1, c: float = 1e-2, **changes: Any) -> Trajectory:
        t = of.sample_times()
        early = of.truth(of, t * (1 + c * dt**order))
        steps, asked = of.samples * of.steps_per_sample(dt), setup.expected(of, dt)
        own = Provenance(of.full_name, "alpha", "1.0", "own", order, "own", dt, steps, setup=asked)
        return replace(early, t=t, provenance=replace(own, **changes))

    return make
