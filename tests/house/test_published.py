"""A published page that no longer holds is seen, by `benchmarks/published.py`."""

import runpy
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
FOUND = runpy.run_path(str(ROOT / "benchmarks" / "published.py"))
PAGE = """# A page

Of 12 scenes 11 agree with engine 4.0.0.

| scene | ratio | said |
|---|---|---|
| `top[1e-2]` | 1.50 | fails from 2^-12, by 1.5e-06 |
| `chain` | 2.00 | stops: I3 < 0 |
"""
FACTORS = {"ratio": 1.25, "said": 3.0}


def differences(now, factors=FACTORS):
    return list(FOUND["differences"](PAGE, now, factors))


def test_what_is_the_same_or_about_the_same_agrees():
    assert differences(PAGE) == []
    assert differences(PAGE.replace("1.50", "1.80").replace("1.5e-06", "0.9e-6")) == []


@pytest.mark.parametrize(
    ("published", "now"),
    [
        ("1.50", "1.90"),
        ("1.50", "-1.50"),
        ("2.00", "0.00"),
        ("1.5e-06", "1.5e-05"),
        ("2^-12", "2^-11"),
        ("top[1e-2]", "top[1e-3]"),
        ("I3", "I2"),
        ("stops", "runs"),
        ("11 agree", "10 agree"),
        ("4.0.0", "4.0.1"),
    ],
)
def test_another_number_or_word_is_seen(published, now):
    assert len(differences(PAGE.replace(published, now))) in (1, 2)


def test_a_line_more_or_less_is_seen_alone():
    line = "| `chain` | 2.00 | stops: I3 < 0 |\n"
    assert differences(PAGE.replace(line, "")) == [f"published, and no longer so: {line.strip()}"]
    assert differences(PAGE + "| `rope` | 3.00 | runs |\n") == [
        "measured, and not published: | `rope` | 3.00 | runs |"
    ]


def test_only_the_column_that_may_differ_may():
    assert differences(PAGE.replace("1.50", "15.0"), {"ratio": float("inf")}) == []
    assert len(differences(PAGE.replace("1.5e-06", "1.6e-06"), {"ratio": float("inf")})) == 1


def test_pages_are_written_and_held(tmp_path, capsys):
    path = tmp_path / "new" / "PAGE.md"
    settled = FOUND["settled"]
    assert settled(PAGE, path, ["--publish"]) == 0
    assert settled(PAGE, path, ["--check"]) == 0
    assert settled(PAGE.replace("stops", "runs"), path, ["--check"]) == 1
    assert "runs: I3 < 0" in capsys.readouterr().out


def test_an_error_that_stops_growing_is_told_from_one_that_is_bounded():
    pytest.importorskip("mujoco")
    long_runs = runpy.run_path(str(ROOT / "benchmarks" / "long_runs.py"))
    # √(1 + (Ω_b dt)²) a step, of Ω_b = 5 rad/s at 1 ms.
    for scheme, law, across in (("implicit", "came to rest", (1 + 0.005**2) ** -160_000), ("RK4", "", 1.0)):
        told = long_runs["measured"]("free top", "mujoco", scheme, 320_000)
        found = np.array(told["found"])
        assert long_runs["left"](found, told["stride"], 320_000) == pytest.approx(across, rel=0.01)
        # All that the motion across the axis holds is lost, a fiftieth of what turning holds.
        if law:
            said, largest = long_runs["law"](np.arange(len(found)) * 0.2, found[:, 0] / told["energy_scale"])
            assert said == law
            assert largest == pytest.approx(0.005 / 0.255, rel=0.01)


def test_first_steps_refute_a_law_that_is_not_theirs():
    pytest.importorskip("mujoco")
    refuted = runpy.run_path(str(ROOT / "benchmarks" / "long_runs.py"))["refuted"]
    swing, line = np.abs(np.sin(np.arange(1600.0))), np.arange(1600) / 16.0
    assert not refuted(swing, 100, "bounded", 1.0)
    assert refuted(swing, 100, "bounded", 0.5)
    assert refuted(swing, 100, "came to rest", 0.5)
    assert not refuted(swing, 100, "came to rest", 1.0)
    assert refuted(swing, 100, "bounded", 5.0)
    assert not refuted(line, 100, "linear, -1.0 /s", 1e4)
    assert refuted(line, 100, "linear, 0.01 /s", 1e2)
    assert refuted(line, 100, "linear, 10 /s", 1e5)
    assert not refuted(line, 100, "exponential or faster", 1e9)
    assert refuted(swing, 100, "exponential or faster", 1e9)
