"""One cell that dies, hangs or raises is an error that says so; the others finish."""

import textwrap

import pytest
from poinsot.adapters import log, runner
from poinsot.adapters.runner import Request

SCENE = "free_symmetric_top[oblate]"

ENGINES = """
    import os, signal, time
    import numpy as np
    from poinsot.adapters.engine import Scheme, Setup, State

    class Still:
        name = "still"
        schemes = (Scheme("none", 1, "none", {}),)
        features = frozenset({"free"})
        settings = {}
        version = staticmethod(lambda: "1")

        def build(self, scene, scheme, dt):
            self.q, self.v = np.array(scene.q0), np.array(scene.v0)

        def step(self, n):
            pass

        def state(self):
            q, v, none = self.q[None], self.v[None], np.empty(0)
            return State(q[:, :3], q[:, 3:], v[:, :3], v[:, 3:], none, none)

        def readback(self):
            return Setup({})

        def acceleration(self, q, v):
            return np.zeros(6)

        def model_text(self):
            return "model.txt", "nothing"

        def close(self):
            pass

    class Dies(Still):
        def step(self, n):
            os.kill(os.getpid(), signal.SIGSEGV)

    class Exits(Still):
        def step(self, n):
            os._exit(7)

    class Hangs(Still):
        def step(self, n):
            time.sleep(60)

    class Raises(Still):
        def step(self, n):
            raise RuntimeError("the solver did not converge")

    class TurnsToNaN(Still):
        def step(self, n):
            self.v[3] = np.nan
"""


@pytest.fixture(scope="module")
def outcomes(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cells")
    path = folder / "engines.py"
    path.write_text(textwrap.dedent(ENGINES))
    names = ["Still", "Dies", "Exits", "Hangs", "Raises", "TurnsToNaN"]
    requests = [Request(SCENE, f"{path}:{name}", "none", 0.02) for name in (*names, "Missing", "Still")]
    # The hang is stopped by this limit; the others need a fraction of it even on a busy machine.
    found = runner.run(requests[:-1], folder / "logs", workers=2, time_limit=15.0)
    return folder, dict(zip([*names, "Missing"], found, strict=True))


def test_the_sound_cell_is_logged(outcomes):
    folder, found = outcomes
    assert found["Still"].error == ""
    assert log.read(folder / "logs" / found["Still"].log).trajectory.provenance.scene == SCENE


def test_the_memory_of_a_cell_is_known(outcomes):
    _, found = outcomes
    # Python and numpy alone take 30 MB; a cell that takes 2 GB would be found out.
    assert 3e7 < found["Still"].memory < 2e9
    assert found["Dies"].memory is None


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("Dies", "SIGSEGV"),
        ("Exits", "exit code 7"),
        ("Hangs", "time limit of 15 s"),
        ("Raises", "RuntimeError: the solver did not converge"),
        ("TurnsToNaN", "not finite at t = 0.04 s"),
        ("Missing", "has no 'Missing'"),
    ],
)
def test_what_went_wrong_is_named(outcomes, name, says):
    _, found = outcomes
    assert found[name].log is None
    assert says in found[name].error


def test_nothing_half_written_is_left(outcomes):
    folder, found = outcomes
    assert [path.name for path in (folder / "logs").iterdir()] == [found["Still"].log]


def test_file_names_are_plain():
    name = runner.file_name(Request("co2_chain[mixture]", "my/engine.py:A", "semi-implicit Euler", 2.5e-4))
    assert name == "co2_chain-mixture-my_engine.py_A-semi-implicit_Euler-0.00025.mcap"
