"""How long `poinsot list` takes, whole processes, beside Python with numpy alone in the same minute.

python benchmarks/list_time.py [RUNS]
"""

import statistics
import subprocess
import sys
import time

COMMANDS = {
    "poinsot list": (sys.executable, "-m", "poinsot", "list"),
    "import numpy": (sys.executable, "-c", "import numpy"),
    "nothing": (sys.executable, "-c", "pass"),
}


def main(runs: int) -> None:
    """Print the least and the median of each [s], taken in turns."""
    seconds: dict[str, list[float]] = {name: [] for name in COMMANDS}
    for _ in range(runs):
        for name, command in COMMANDS.items():
            start = time.perf_counter()
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
            seconds[name].append(time.perf_counter() - start)
    for name, taken in seconds.items():
        print(f"{name:14s} least {min(taken):.3f} s, median {statistics.median(taken):.3f} s of {runs}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 25)
