"""Known deviations explained, and scripts that show a cell without Poinsot: run as their reader would."""

import re
import subprocess
import sys

import numpy as np
import pytest
from poinsot.adapters import registry
from poinsot.adapters.simulate import simulate
from poinsot.reports.deviations import recorded
from poinsot.scenarios.registry import scenes

from poinsot import reproduction
from poinsot.command_line import main


def ends(scene, engine, scheme, dt):
    """Numbers that the cell's script prints when it is run by itself, and the script."""
    text = reproduction.script(scenes()[scene], registry.load(engine), scheme, dt)
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    printed = done.stdout.split("2025", 1)[-1] if "build time" in done.stdout else done.stdout
    return text, printed


@pytest.mark.parametrize(
    ("scene", "engine", "scheme"),
    [
        ("free_symmetric_top[oblate]", "mujoco", "RK4"),
        ("heavy_top[fast]", "mujoco", "Euler"),
        ("co2_chain[mixture]", "mujoco", "Euler"),
        ("free_symmetric_top[oblate]", "pybullet", "maximal coordinates"),
        ("free_symmetric_top[defaults]", "pybullet", "reduced coordinates"),
        ("heavy_top[fast]", "pybullet", "reduced coordinates"),
        ("euler_angles[general]", "pybullet", "reduced coordinates"),
        ("inertia_of_shapes[cone]", "mujoco", "Euler"),
    ],
)
def test_a_script_of_the_engine_alone_ends_where_the_cell_does(scene, engine, scheme):
    described, kind = scenes()[scene], registry.load(engine)
    scheme = registry.scheme_of(kind, scheme)
    text, printed = ends(scene, engine, scheme, described.dt)
    assert "poinsot" not in text
    motion, _ = simulate(described, kind, scheme, described.dt)
    numbers = [float(x) for x in re.findall(r"[-+]?\d+\.\d*(?:e[-+]?\d+)?", printed)]
    # numpy prints eight digits, PyBullet's links are read in full.
    for wanted in (motion.position[-1, -1], motion.quaternion[-1, -1]):
        size = len(wanted)
        found = [np.array(numbers[i : i + size]) for i in range(len(numbers) - size + 1)]
        assert min(min(np.abs(f - wanted).max(), np.abs(f + wanted).max()) for f in found) < 1e-7


@pytest.mark.parametrize("variant", ["capsule", "cone"])
def test_a_script_of_pybullet_alone_shows_what_it_makes_of_solids(variant):
    scene, kind = scenes()[f"inertia_of_shapes[{variant}]"], registry.load("pybullet")
    text, printed = ends(scene.full_name, "pybullet", kind.schemes[0], scene.dt)
    assert "poinsot" not in text
    run, _ = simulate(scene, kind, kind.schemes[0], scene.dt)
    moments = np.linalg.eigvalsh(run.provenance.setup[f"body/{scene.bodies[0].name}/inertia"])
    rows = re.findall(r"^([\d.]+) \[(.*)\]$", printed, re.MULTILINE)
    assert len(rows) == 3
    for mass, row in rows:
        assert float(mass) == scene.bodies[0].mass
        np.testing.assert_allclose([float(number) for number in row.split(",")], moments, rtol=1e-12)
    exact = np.linalg.eigvalsh(scene.bodies[0].inertia_array)
    assert f"{exact[0]:.6g}"[:6] in text.split("# Exactly")[1]


def test_a_scene_that_takes_many_calls_to_set_up_is_shown_with_poinsot(capfd):
    kind = registry.load("pinocchio")
    text, printed = ends("co2_chain[mixture]", "pinocchio", registry.scheme_of(kind, "RKMK4"), 0.02)
    assert "import poinsot" in text
    assert "truth position pass" in printed


def test_every_known_deviation_is_listed_and_the_first_is_explained(capsys):
    assert main(["explain"]) == 0
    listed = capsys.readouterr().out
    assert re.match(r"pybullet maximal coordinates in .*\n   1\. twin of state\n", listed)
    numbers = [int(number) for number in re.findall(r"(\d+)\. \w+ of ", listed)]
    assert numbers == list(range(1, len(recorded()) + 1))
    assert listed.count("sensor adds ω×Iω") == 2, "a reason is said once a scene"
    assert main(["explain", "1"]) == 0
    text = capsys.readouterr().out
    assert re.search(r"^Granted: up to .* of pybullet ==3\.2\.7\.$", text, re.MULTILINE)
    assert re.search(r"^Now: [\d.e-]+ .* allowed", text, re.MULTILINE)
    assert "p.stepSimulation()" in text


def test_a_number_that_no_record_has_is_refused(capsys):
    assert main(["explain", "999"]) == 2
    assert "expected a number from 1 to" in capsys.readouterr().err
