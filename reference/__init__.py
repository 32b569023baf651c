"""What is true: closed forms as pure functions, numbers in, arrays out.

Its modules load when something in them is first used: ``poinsot.reference.torque_free.motion(…)``. A
scene may name the truth that it will be held against without anybody waiting for it to load.
"""

import importlib.util
import sys
from types import ModuleType


def __getattr__(name: str) -> ModuleType:
    full_name = f"{__name__}.{name}"
    if full_name in sys.modules:
        return sys.modules[full_name]
    spec = None if name.startswith("_") else importlib.util.find_spec(full_name)
    if spec is None or spec.loader is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    loader = spec.loader = importlib.util.LazyLoader(spec.loader)
    module = sys.modules[full_name] = importlib.util.module_from_spec(spec)
    loader.exec_module(module)
    return module
