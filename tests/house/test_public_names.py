"""The public surface is small, and this is what it is."""

import inspect
import subprocess
import sys

import poinsot


def test_public_names():
    assert sorted(poinsot.__all__) == [
        "InputError",
        "PoinsotError",
        "engines",
        "judge",
        "scenes",
        "simulate",
        "work_precision",
    ]
    for name in poinsot.__all__:
        assert inspect.getdoc(getattr(poinsot, name)), name


def test_reference_names_that_scripts_rely_on():
    reference = poinsot.reference
    signatures = {
        reference.torque_free.motion: "moments q0 omega0 t",
        reference.torque_free.body_cone_rate: "I1 I3 omega3",
        reference.torque_free.space_cone_rate: "I1 I3 omega",
        reference.heavy_top.motion: "mass length moments gravity q0 omega0 t",
        reference.heavy_top.regular_precession: "mass length moments gravity theta omega3",
        reference.normal_modes.normal_modes: "T V",
    }
    for function, parameters in signatures.items():
        assert list(inspect.signature(function).parameters) == parameters.split(), function.__name__


def test_importing_poinsot_imports_no_engine_and_no_scipy():
    code = "import sys, poinsot; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"mujoco", "pybullet", "pinocchio", "scipy"} & set(done.stdout.split())
