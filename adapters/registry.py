"""Every engine there is: found by listing this folder, by entry points, or named by the user."""

import importlib
import importlib.metadata
import importlib.util
import pkgutil
import sys
import traceback
from functools import cache
from pathlib import Path
from types import ModuleType

from ..reference.errors import InputError, UnavailableError
from ..reference.spelling import nearest
from .engine import Engine, Scheme

ENTRY_POINTS = "poinsot.engines"
#: What a class must have to be an engine.
REQUIRED = tuple(name for name in (*Engine.__annotations__, *vars(Engine)) if not name.startswith("_"))


def names() -> list[str]:
    """Names of the engines that Poinsot has a file or an entry point for, installed or not."""
    return list(
        dict.fromkeys([*_own(tuple(importlib.import_module(__package__).__path__)), *sorted(_points())])
    )


def engines() -> dict[str, type[Engine] | str]:
    """Every engine by name, or the reason why it is unavailable."""
    found: dict[str, type[Engine] | str] = {}
    for name in names():
        try:
            found[name] = load(name)
        except UnavailableError as error:
            found[name] = str(error)
    return found


def load(spec: str) -> type[Engine]:
    """The engine called ``name``, ``package.module:Class`` or ``path/to/file.py:Class``.

    Raises ``UnavailableError`` if its package is not installed, ``InputError`` if there is no such
    engine or if what is there is not one.
    """
    if ":" in spec:
        return _checked(spec, *_from_path(spec))
    if spec in _points():
        return _checked(spec, _points()[spec].load(), spec)
    if spec not in names():
        raise InputError(
            f"engine: got {spec!r}; {nearest(spec, names())}, or your own as path/to/file.py:Class"
        )
    try:
        module = importlib.import_module(f"{__package__}.{spec}_")
    except ModuleNotFoundError as error:
        # Only the engine's own package may be missing; anything else that fails to import is a fault.
        if error.name != spec:
            raise
        raise UnavailableError(f"{spec} is not installed; pip install 'poinsot[{spec}]'") from error
    return _checked(spec, _only_engine(module), spec)


def scheme_of(engine: type[Engine], name: str | None) -> Scheme:
    """The scheme of this name, or the engine's first; raises ``InputError`` listing the valid ones."""
    schemes = {scheme.name: scheme for scheme in engine.schemes}
    if name is None:
        return engine.schemes[0]
    if name not in schemes:
        raise InputError(f"scheme of {engine.name}: got {name!r}; {nearest(name, schemes)}")
    return schemes[name]


@cache
def _own(folders: tuple[str, ...]) -> tuple[str, ...]:
    """Engines with a file in this package; its folders are listed once, and not for every cell."""
    modules = pkgutil.iter_modules(folders)
    return tuple(sorted(module.name.removesuffix("_") for module in modules if module.name.endswith("_")))


@cache
def _points() -> dict[str, importlib.metadata.EntryPoint]:
    """Entry points by name; to find them, all that is installed is looked through, so it is done once."""
    return {point.name: point for point in importlib.metadata.entry_points(group=ENTRY_POINTS)}


def _only_engine(module: ModuleType) -> object:
    classes = [
        thing
        for thing in vars(module).values()
        if isinstance(thing, type) and thing.__module__ == module.__name__ and hasattr(thing, "schemes")
    ]
    if len(classes) != 1:
        raise InputError(
            f"{module.__name__}: got {len(classes)} classes with schemes, expected one engine a file"
        )
    return classes[0]


def _from_path(spec: str) -> tuple[object, str]:
    place, _, name = spec.rpartition(":")
    module = _file(Path(place)) if place.endswith(".py") else _module(place)
    if not hasattr(module, name):
        raise InputError(f"engine: got {spec!r}, but {place} has no {name!r}; {nearest(name, vars(module))}")
    return getattr(module, name), name


def _file(path: Path) -> ModuleType:
    if not path.is_file():
        raise InputError(f"engine: got {str(path)!r}, expected an existing Python file before the colon")
    specification = importlib.util.spec_from_file_location(path.stem, path)
    if specification is None or specification.loader is None:
        raise InputError(f"engine: got {str(path)!r}, expected a Python file")
    module = importlib.util.module_from_spec(specification)
    folder = str(path.resolve().parent)
    if folder not in sys.path:
        sys.path.append(folder)  # as when Python runs a file: it finds its neighbours
    try:
        specification.loader.exec_module(module)
    except Exception as error:
        raise _fault(str(path), path, error) from error
    return module


def _module(name: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name is None or not name.startswith(error.name):
            raise _fault(name, None, error) from error
        raise InputError(
            f"engine: got module {name!r}, which cannot be found; expected one that is installed"
        ) from error
    except Exception as error:
        raise _fault(name, None, error) from error


def _fault(name: str, path: Path | None, error: Exception) -> InputError:
    """What a user's own code raised: theirs to mend, told in one line with its place, without our frames."""
    frames = traceback.extract_tb(error.__traceback__)
    lines = [frame.lineno for frame in frames if path and frame.filename == str(path)]
    where = f", line {lines[-1]}" if lines else ""
    return InputError(f"engine: {name}{where}: {type(error).__name__}: {error}")


def _checked(spec: str, candidate: object, name: str) -> type[Engine]:
    missing = [attribute for attribute in REQUIRED if not hasattr(candidate, attribute)]
    if not isinstance(candidate, type) or missing:
        raise InputError(
            f"engine: got {spec!r}, which is no engine: {name} lacks {', '.join(missing) or 'a class'}"
        )
    return candidate
