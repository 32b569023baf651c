"""What is told of a motion must fit together: this needs neither a scheme's order nor its error."""

from collections.abc import Sequence

import numpy as np

from ..adapters.centred import centred
from ..reference.checked import EPSILON, Array
from ..scenarios import observables
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory
from . import truth
from .cell import Cell
from .intervals import apart, coordinates
from .verdict import Status, Verdict

#: Roundings along the longest chain of joints, with room: right engines were seen to need up to 20.
ROUNDINGS = 1000
NORM = observables.unit_norm()
ON_JOINTS = "bodies on their joints"


def check(cells: Sequence[Cell]) -> list[Verdict]:
    """Verdicts on cells of one scene: quaternions of length 1, and bodies where their joints have them."""
    message = "difference from 1; only round-off is allowed, whatever the scheme"
    norms = [
        cell.compared("invariant", NORM, cell.distance(NORM), cell.floor(NORM), message)
        for cell in cells
        if not _judged(cell)
    ]
    return [*norms, *_on_joints(cells)]


def _judged(cell: Cell) -> bool:
    """Whether the scene looks at the quaternions' length itself, and knows what this scheme makes of it."""
    return any(o.name == NORM.name and truth.own_error(cell, o) is not None for o in cell.scene.observables)


def _on_joints(cells: Sequence[Cell]) -> list[Verdict]:
    scene = centred(cells[0].scene).scene
    if all([joint.kind for joint in body.joints] == ["free"] for body in scene.bodies):
        return []  # such a body may be anywhere
    # Of quaternions of no length nothing follows; that they have none is told already.
    cells = [cell for cell in cells if cell.distance(NORM).max() < 0.5]
    if not cells:
        return []
    told = _joined([cell.trajectory for cell in cells])
    state = coordinates(scene, told)
    if state is None:
        return []
    sizes = _sizes(scene, cells[0].truth)
    off = {name: np.abs(values).max(axis=(1, 2)) / sizes[name] for name, values in apart(scene, told, *state)}
    found, start = [], 0
    for cell in cells:
        mine = slice(start, start := start + len(cell.trajectory.t))
        worst = {name: float(values[mine].max()) for name, values in off.items()}
        name = max(worst, key=lambda name: np.nan_to_num(worst[name], nan=np.inf))
        found.append(_verdict(cell, name, worst[name], int(np.argmax(off[name][mine]))))
    return found


def _verdict(cell: Cell, name: str, measured: float, place: int) -> Verdict:
    allowed = ROUNDINGS * EPSILON
    message = (
        f"{name} told of bodies, against what is told of their joints, relative to its size; "
        f"{ROUNDINGS} roundings are allowed, whatever the scheme"
    )
    status = Status.PASS if measured <= allowed else Status.FAIL
    at = float(cell.trajectory.t[place])
    return cell.verdict("invariant", ON_JOINTS, status, message, measured, allowed, "1", at)


def _joined(told: Sequence[Trajectory]) -> Trajectory:
    """All samples as of one motion: what follows from joints is worked out once."""

    def every(name: str) -> Array:
        return np.concatenate([getattr(one, name) for one in told])

    return Trajectory(
        t=every("t"),
        position=every("position"),
        quaternion=every("quaternion"),
        velocity=every("velocity"),
        omega=every("omega"),
        joint_position=every("joint_position"),
        joint_velocity=every("joint_velocity"),
    )


def _sizes(scene: Scene, truth: Trajectory) -> dict[str, float]:
    """Sizes of what is compared: of lengths in the model, of what turns them, of speeds that come of both."""
    lengths = [truth.position, *(np.array([body.position, body.center_of_mass]) for body in scene.bodies)]
    length = max(_longest(each) for each in lengths) or 1.0
    turning = max(_longest(truth.omega), np.abs(truth.joint_velocity).max(initial=0.0), 1 / scene.duration)
    return {
        "position": length,
        "orientation": max(1.0, float(np.abs(truth.joint_position).max(initial=0.0))),
        "velocity": max(_longest(truth.velocity), turning * length),
        "omega": turning,
    }


def _longest(vectors: Array) -> float:
    return float(np.linalg.norm(vectors, axis=-1).max())
