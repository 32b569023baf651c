"""Poinsot: cross-validation of rigid-body physics engines against exact solutions and each other."""

import importlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

_checkout = Path(__file__).resolve().parent.parent
if (_checkout / "reference" / "errors.py").is_file():
    # Python started in a checkout finds this folder before the installed package; its four
    # subpackages are the folders beside it.
    __path__.append(str(_checkout))

if TYPE_CHECKING:
    from .api import engines, judge, scenes, simulate, work_precision
    from .reference.errors import InputError, PoinsotError

__version__ = "0.1.0"
__all__ = ["InputError", "PoinsotError", "engines", "judge", "scenes", "simulate", "work_precision"]

#: Where each public name lives; it is imported when first used, so that ``import poinsot`` is quick.
_HOMES = {
    "InputError": ".reference.errors",
    "PoinsotError": ".reference.errors",
    "engines": ".api",
    "judge": ".api",
    "scenes": ".api",
    "simulate": ".api",
    "work_precision": ".api",
}
_SUBPACKAGES = ("adapters", "reference", "reports", "scenarios")


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(importlib.import_module(_HOMES[name], __name__), name)
    if name in _SUBPACKAGES:
        return importlib.import_module(f".{name}", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
