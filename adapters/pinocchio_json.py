"""The text of a Pinocchio model: JSON, as a URDF holds no ball joint and no two joints on one body."""

import json
from collections.abc import Sequence
from typing import Any


def model_json(
    model: Any, frames: Sequence[Any], springs: Sequence[tuple[int, float, float]], dt: float
) -> str:
    """Joints, bodies, gravity and step, every number with all its digits.

    ``frames`` are those of the bodies; ``springs`` gives place in v, stiffness and damping of each
    hinge and slide. A joint's placement is in its parent's frame, a body's in its joint's; rotations
    are matrices by rows, SI units throughout.
    """
    pulls = {v: {"stiffness": stiffness, "damping": damping} for v, stiffness, damping in springs}
    joints = [_joint(model, i) | pulls.get(model.idx_vs[i], {}) for i in range(1, model.njoints)]
    bodies = [_body(model, frame) for frame in frames]
    head = {"name": model.name, "dt": dt, "gravity": model.gravity.linear.tolist()}
    lines = [f"{_text(name)}: {_text(value)}" for name, value in head.items()]
    lines += [f"{_text(name)}: {_rows(rows)}" for name, rows in (("joints", joints), ("bodies", bodies))]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _rows(rows: Sequence[dict[str, Any]]) -> str:
    return "[\n" + ",\n".join(f"  {_text(row)}" for row in rows) + "\n]"


def _text(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)


def _joint(model: Any, i: int) -> dict[str, Any]:
    joint = model.joints[i]
    kind = joint.shortname()
    axis = {"axis": joint.extract().axis.tolist()} if kind.endswith("Unaligned") else {}
    parent = model.names[model.parents[i]]
    return {"name": model.names[i], "type": kind, "parent": parent} | axis | _place(model.jointPlacements[i])


def _body(model: Any, frame: Any) -> dict[str, Any]:
    inertia = frame.inertia
    return (
        {"name": frame.name, "joint": model.names[frame.parentJoint]}
        | _place(frame.placement)
        | {
            "mass": float(inertia.mass),
            "center_of_mass": inertia.lever.tolist(),
            "inertia": inertia.inertia.tolist(),
        }
    )


def _place(place: Any) -> dict[str, Any]:
    return {"translation": place.translation.tolist(), "rotation": place.rotation.tolist()}
