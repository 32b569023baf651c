"""What is true: closed forms as pure functions, numbers in, arrays out.

Its modules load when they are first used: ``poinsot.reference.torque_free.motion(…)``.
"""

import importlib
import importlib.util
from types import ModuleType


def __getattr__(name: str) -> ModuleType:
    if name.startswith("_") or importlib.util.find_spec(f"{__name__}.{name}") is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return importlib.import_module(f"{__name__}.{name}")
