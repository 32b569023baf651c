"""On what a run was made: versions and machine, for the log and the report."""

import os
import platform
from importlib import metadata
from pathlib import Path

#: Distributions whose version may change a number in a report.
PACKAGES = ("numpy", "scipy", "mcap", "protobuf", "mujoco", "pybullet", "pin")


def environment() -> dict[str, str | int]:
    """Versions of Python, of Poinsot and of what it stands on, and the machine's kind."""
    found: dict[str, str | int] = {
        "poinsot": metadata.version("poinsot"),
        "python": platform.python_version(),
        "platform": f"{platform.system()} {platform.machine()}",
        "cpu": processor(),
        "cores": os.cpu_count() or 1,
    }
    return found | {name: version for name in PACKAGES if (version := _version(name))}


def processor() -> str:
    """The processor's own name, where the system tells it."""
    information = Path("/proc/cpuinfo")
    if information.is_file():
        for line in information.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def _version(package: str) -> str | None:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None
