"""A look at this installation: versions, engines, and a self-test of each."""

import platform
import tempfile
from collections.abc import Mapping
from pathlib import Path

from .adapters import registry, runner
from .adapters.engine import Engine
from .adapters.environment import environment
from .adapters.runner import Request

#: Pythons from 3.11 on for which wheels of an engine were seen; elsewhere pip may have nothing to install.
WHEELS = {
    "mujoco": "Python 3.10 and later",
    "pinocchio": "CPython 3.11 to 3.14 on Linux (the distribution is called pin)",
    "pybullet": "CPython 3.11 on Linux",
}
SELF_TEST = "free_symmetric_top[oblate]"


def examine() -> tuple[str, bool]:
    """A text for people, and whether every installed engine passed its self-test.

    The self-test runs a free top for its whole duration at a coarse step, in a process of its own.
    """
    lines = [f"{name}: {value}" for name, value in environment().items()]
    found = registry.engines()
    installed = {name: engine for name, engine in found.items() if not isinstance(engine, str)}
    tests = [Request(SELF_TEST, name, engine.schemes[0].name, 2e-3) for name, engine in installed.items()]
    with tempfile.TemporaryDirectory() as folder:
        outcomes = runner.run(tests, Path(folder), workers=1, time_limit=60.0)
    errors = {outcome.request.engine: outcome.error for outcome in outcomes}
    lines += [f"{name}: {_state(name, engine, errors)}" for name, engine in found.items()]
    return "\n".join(lines), not any(errors.values())


def _state(name: str, engine: type[Engine] | str, errors: Mapping[str, str]) -> str:
    if isinstance(engine, str):
        here = f"CPython {platform.python_version()} on {platform.system()}"
        return (
            f"unavailable: {engine}; wheels exist for {WHEELS.get(name, 'unknown systems')}, this is {here}"
        )
    return f"{engine.version()}: {errors[name] or 'self-test passed'}"
