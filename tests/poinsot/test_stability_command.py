"""`poinsot stability`: what it writes, what it refuses, and what becomes of engines that hang, die or lie."""

import json

import pytest

pytest.importorskip("pinocchio")

from poinsot.reports import stability_results

from poinsot.command_line import main

#: Pinocchio that stands still for ever at one point of a family, and takes its process with it at another.
OWN = """
import os, time
from poinsot.adapters.engine import Scheme
from poinsot.adapters.pinocchio_ import Pinocchio

class Frail(Pinocchio):
    name = "frail"
    schemes = (Scheme("semi-implicit Euler", 1, "semi-implicit Euler", {}),)
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self.place = scene.variant, dt
    def step(self, n):
        if self.place == ("1e-12", 1.0):
            time.sleep(60)
        if self.place == ("1e-10", 1.0):
            os.abort()
        super().step(n)

class Liar(Pinocchio):
    name = "liar"
    schemes = (Scheme("implicit", 1, "discrete", {}),)
    def build(self, scene, scheme, dt):
        super().build(scene, Pinocchio.schemes[0], dt)
"""


@pytest.fixture
def own(tmp_path):
    path = tmp_path / "own.py"
    path.write_text(OWN)
    return path


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["springs"], "stiff_spring"),
        (["spin", "--scheme", "RK5"], "RK4"),
        (["spin", "--engine", "mujocco"], "mujoco"),
        (["spin", "--workers", "0"], "--workers"),
        (["spin", "--time-limit", "0"], "--time-limit"),
    ],
)
def test_bad_input_is_one_line_and_writes_nothing(arguments, said, tmp_path, capsys):
    assert main(["stability", *arguments, "--out", str(tmp_path / "out")]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert said in err
    assert not (tmp_path / "out").exists()


def test_a_folder_that_holds_something_is_refused(tmp_path, capsys):
    (tmp_path / "mine").write_text("")
    assert main(["stability", "spin", "--out", str(tmp_path)]) == 2
    assert "not empty" in capsys.readouterr().err


def test_one_that_hangs_and_one_that_dies_end_alone(own, tmp_path, capsys):
    out = tmp_path / "out"
    code = main(
        ["stability", "near_separatrix", "--engine", f"{own}:Frail", "--time-limit", "4", "--out", str(out)]
    )
    assert code == 3
    assert "1 timed out" in capsys.readouterr().out
    found = stability_results.read(out / "stability.json")
    points = {(point["value"], point["dt"]): point for each in found["maps"] for point in each["points"]}
    assert len(points) == 60
    assert points[1e-12, 1.0]["outcome"] == "timed out"
    assert points[1e-10, 1.0]["outcome"] == "crashed"
    assert "SIGABRT" in points[1e-10, 1.0]["said"]
    assert points[1e-2, 1e-3]["outcome"] == "accurate"
    assert (out / "stability.html").is_file()


def test_a_run_that_is_accurate_only_so_far_goes_on(tmp_path):
    out = tmp_path / "out"
    arguments = ["--engine", "pinocchio", "--scheme", "semi-implicit Euler", "--out", str(out)]
    assert main(["stability", "spin", *arguments]) == 0
    (found,) = stability_results.read(out / "stability.json")["maps"]
    points = {(point["value"], point["dt"]): point for point in found["points"]}
    for place in ((10.0, 1e-4), (100.0, 1e-5)):
        assert points[place]["outcome"] == "growing"
        assert points[place]["covered"] == 1
    assert points[10.0, 1e-7]["covered"] == pytest.approx(4000 * 1e-7 / 3.2)


def test_a_lie_about_a_scheme_ends_with_one(own, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["stability", "stiff_spring", "--engine", f"{own}:Liar", "--out", str(out)]) == 1
    said = capsys.readouterr().out
    assert "9 largest stable steps: 9 fail"[2:] in said
    assert "by theory at any step" in said
    verdicts = json.loads((out / "stability.json").read_text())["verdicts"]
    assert {verdict["status"] for verdict in verdicts} == {"fail"}
    assert {verdict["check"] for verdict in verdicts} == {"stability"}
