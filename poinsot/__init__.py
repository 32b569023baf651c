"""Poinsot: cross-validation of rigid-body physics engines against exact solutions and each other."""

from pathlib import Path

_checkout = Path(__file__).resolve().parent.parent
if (_checkout / "reference" / "errors.py").is_file():
    # Python started in a checkout finds this folder before the installed package; its four
    # subpackages are the folders beside it.
    __path__.append(str(_checkout))

__version__ = "0.1.0"
