"""A run as a table of scenes and engines: ``python benchmarks/scene_table.py DIR``, made by `poinsot run`.

For each scene and engine over all variants, schemes and steps: the largest measured value over what is
allowed in any check that has both, the largest difference between twins, the orders in the first state
observable that were fitted, and cells that are not a pass.
"""

import json
import re
import sys
from collections import Counter
from pathlib import Path


def line(cells: list[dict]) -> str:
    """What one engine did in one scene."""
    verdicts = [verdict for cell in cells for verdict in cell["verdicts"]]
    shares = [v["measured"] / v["allowed"] for v in verdicts if v["allowed"] and v["measured"] is not None]
    twins = [v["measured"] for v in verdicts if v["check"] == "twin" and v["measured"] is not None]
    orders = [
        float(found[1])
        for v in verdicts
        if v["check"] == "order" and (found := re.match(r"fitted order (-?[\d.]+)", v["message"]))
    ]
    others = Counter(cell["status"] for cell in cells if cell["status"] != "pass")
    parts = [
        f"{max(shares):.2f}" if shares else "–",
        f"{max(twins):.0e}" if twins else "–",
        f"{min(orders):.2f} to {max(orders):.2f}" if orders else "–",
        ", ".join(f"{n} {status}" for status, n in others.items()),
    ]
    return " | ".join(parts)


def main(folder: Path) -> None:
    """Print the table."""
    results = json.loads((folder / "results.json").read_text(encoding="utf-8"))
    groups: dict[tuple[str, str], list[dict]] = {}
    for cell in results["cells"]:
        groups.setdefault((cell["scene"].partition("[")[0], cell["engine"]), []).append(cell)
    print("scene | engine | of its limit | twins apart | orders | not a pass")
    for (scene, engine), cells in groups.items():
        print(f"{scene} | {engine} | {line(cells)}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("got no folder, expected one that `poinsot run` wrote")
    main(Path(sys.argv[1]))
