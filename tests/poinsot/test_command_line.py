"""Bad input: one clear line, the right exit code, no traceback, and nothing written."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import pytest
from poinsot.reference.errors import InputError

from poinsot import entry, listing
from poinsot.command_line import main

TOP = "free_symmetric_top[oblate]"

OWN = """
import numpy as np
from poinsot.adapters.engine import Scheme, Setup, State

class Still:
    name = "still"
    schemes = (Scheme("none", 1, "none", {}),)
    features = frozenset({"free"})
    settings = {}
    version = staticmethod(lambda: "1")
    def build(self, scene, scheme, dt): self.q, self.v = np.array(scene.q0), np.array(scene.v0)
    def step(self, n): pass
    def state(self):
        q, v, none = self.q[None], self.v[None], np.empty(0)
        return State(q[:, :3], q[:, 3:], v[:, :3], v[:, 3:], none, none)
    def readback(self): return Setup({})
    def acceleration(self, q, v): return np.zeros(6)
    def model_text(self): return "model.txt", "nothing"
    def close(self): pass

class NoEngine:
    name = "nothing"
"""


@pytest.fixture
def own(tmp_path):
    path = tmp_path / "own.py"
    path.write_text(OWN)
    return path


def complaint(capsys, *arguments):
    """Exit code and the one line on standard error."""
    code = main([str(argument) for argument in arguments])
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("poinsot: ")
    assert err.count("\n") == 1
    assert "Traceback" not in err
    return code, err


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["run", "free_symetric_top"], "did you mean 'free_symmetric_top'?"),
        (["run", "heavy_top[slow]"], "heavy_top[moderate]"),
        (["run", TOP, "--engine", "mujocco"], "did you mean 'mujoco'?"),
        (["run", TOP, "--engine", "nowhere.py:Engine"], "existing Python file"),
        (["run", TOP, "--engine", "no_such_module:Engine"], "cannot be found"),
        (["run", TOP, "--scheme", "RK5"], "did you mean 'RK4'?"),
        (["run", TOP, "--dt", "0"], "above 0"),
        (["run", TOP, "--dt", "-1e-3"], "above 0"),
        (["run", TOP, "--dt", "nan"], "finite"),
        (["run", TOP, "--dt", "11"], "longer than the whole run, 10 s"),
        (["run", TOP, "--dt", "fast"], "fast"),
        (["run", TOP, "--workers", "0"], "at least 1"),
        (["run", TOP, "--time-limit", "0"], "above 0"),
        (["run", "--no-such-option"], "no-such-option"),
        (["reprot"], "report"),
        (["report", "nowhere"], "holds no run"),
    ],
)
def test_bad_input_is_refused_in_one_line(capsys, tmp_path, monkeypatch, arguments, says):
    monkeypatch.chdir(tmp_path)
    code, err = complaint(capsys, *arguments)
    assert code == 2
    assert says in err
    assert list(tmp_path.iterdir()) == []


def test_a_class_that_is_no_engine_is_refused(capsys, own):
    code, err = complaint(capsys, "run", TOP, "--engine", f"{own}:NoEngine")
    assert code == 2
    assert "lacks" in err
    assert "schemes" in err


def test_an_out_folder_that_holds_something_is_left_alone(capsys, tmp_path, own):
    out = tmp_path / "out"
    out.mkdir()
    (out / "results.json").write_text("precious")
    code, err = complaint(capsys, "run", TOP, "--engine", f"{own}:Still", "--out", out)
    assert code == 2
    assert "not empty" in err
    assert (out / "results.json").read_text() == "precious"
    assert [path.name for path in out.iterdir()] == ["results.json"]


def test_an_out_folder_that_cannot_be_made_is_refused(capsys, tmp_path, own):
    code, err = complaint(capsys, "run", TOP, "--engine", f"{own}:Still", "--out", own / "below_a_file")
    assert code == 2
    assert "cannot be written" in err


def test_a_wrong_engine_ends_with_1_and_damage_with_4(capsys, tmp_path, own):
    out = tmp_path / "out"
    arguments = ["run", TOP, "--engine", f"{own}:Still", "--dt", "0.02", "--no-timing", "--out", str(out)]
    assert main(arguments) == 1
    assert {"report.html", "summary.md", "results.json", "junit.xml", "cost.json", "logs"} == {
        p.name for p in out.iterdir()
    }
    before = json.loads((out / "results.json").read_text())
    assert main(["report", str(out)]) == 1
    assert json.loads((out / "results.json").read_text()) == before
    capsys.readouterr()
    log = next((out / "logs").iterdir())
    log.write_bytes(log.read_bytes()[:-200])
    code, err = complaint(capsys, "report", out)
    assert code == 4
    assert log.name in err
    (out / "results.json").write_text("{}")
    code, err = complaint(capsys, "report", out)
    assert code == 4
    assert "schema" in err


def test_list_as_json(capsys):
    assert main(["list", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["scenes"][TOP]["features"] == ["free"]
    assert found["scenes"][TOP]["engines"] == ["mujoco", "pinocchio", "pybullet"]
    assert {"mujoco", "pybullet", "pinocchio"} <= found["engines"].keys()
    euler = next(s for s in found["engines"]["mujoco"]["schemes"] if s["name"] == "Euler")
    assert (euler["order"], euler["twin"]) == (1, "semi-implicit Euler")


def test_list_tells_of_each_scene_what_it_is_where_from_and_what_it_leaves_out(capsys):
    assert main(["list"]) == 0
    text = capsys.readouterr().out
    (told,) = re.findall(r"^  heavy_top\n((?: {6}.+\n)+)", text, re.MULTILINE)
    for words in (
        "heavy_top[moderate]: ",
        "heavy_top[fast]: ",
        "source: Landau",
        "needs ball, gravity; can run in",
    ):
        assert words in told
    assert re.search(r"leaves out .*springs in joints.*contact solver", told)


def test_list_imports_no_engine_and_nothing_heavy():
    code = (
        "import sys; from poinsot.entry import main; sys.argv = ['poinsot', 'list']; main();"
        "print(*sys.modules, file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    heavy = {"scipy", "mpmath", "plotly", "mcap", "numpy.random", "cyclopts"}
    assert not ({"mujoco", "pybullet", "pinocchio"} | heavy) & set(done.stderr.split())


@pytest.mark.parametrize("options", [(), ("--json",)])
def test_a_list_is_the_same_with_and_without_the_parser(capsys, monkeypatch, options):
    monkeypatch.setattr(sys, "argv", ["poinsot", "list", *options])
    assert entry.main() == 0
    short = capsys.readouterr()
    assert main(["list", *options]) == 0
    assert capsys.readouterr() == short
    assert short.out


def test_what_a_list_cannot_read_is_told_in_one_line(capsys, monkeypatch):
    def unreadable():
        raise InputError("engine file: got none")

    monkeypatch.setattr(sys, "argv", ["poinsot", "list"])
    monkeypatch.setattr(listing, "as_text", unreadable)
    assert entry.main() == 2
    assert capsys.readouterr().err == "poinsot: engine file: got none\n"


def test_an_interrupt_ends_with_130_and_leaves_no_process(tmp_path):
    command = [sys.executable, "-m", "poinsot", "run", "heavy_top[fast]", "--out", str(tmp_path / "out")]
    started = subprocess.Popen(
        command, cwd=tmp_path, stderr=subprocess.PIPE, text=True, start_new_session=True,
        # Whoever runs tests side by side keeps interrupts from them, and so from what they start.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )  # fmt: skip
    while not list(tmp_path.glob("out/logs/*.mcap")) and started.poll() is None:
        time.sleep(0.1)
    os.killpg(started.pid, signal.SIGINT)
    _, err = started.communicate(timeout=60)
    assert started.returncode == 130
    assert err.endswith("poinsot: interrupted\n")
    assert "Traceback" not in err
    assert gone(started.pid)


def gone(group, patience=15.0):
    """Whether a process group ends in time: the interpreter's own tracker outlives its parent a little."""
    end = time.monotonic() + patience
    while time.monotonic() < end:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.1)
    return False


def test_compare_ends_with_0_if_nothing_changed_and_with_1_if_an_error_did(tmp_path, capsys):
    out = tmp_path / "old"
    assert main(["run", TOP, "--engine", "mujoco", "--scheme", "RK4", "--no-timing", "--out", str(out)]) == 0
    assert main(["compare", str(out), str(out / "results.json")]) == 0
    found = json.loads((out / "results.json").read_text())
    row = next(row for row in found["work_precision"] if row["observable"] == "orientation")
    row["error"] *= 3
    other = tmp_path / "new.json"
    other.write_text(json.dumps(found))
    assert main(["compare", str(out), str(other)]) == 1
    assert "error of orientation" in capsys.readouterr().out
    assert main(["compare", str(out), str(tmp_path / "nothing")]) == 2
    assert "which is not there" in capsys.readouterr().err
