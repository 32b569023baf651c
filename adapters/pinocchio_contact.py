"""Contact by Pinocchio's own solver of constraints, at points that are ours to supply."""

from collections.abc import Sequence
from math import hypot
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..scenarios.scene import Scene
from .contact_points import Touch, touch

#: Of the projected Gauss-Seidel solver; its sweeps end by tolerance.
SWEEPS, TOLERANCE = 500, 1e-16


class Contacts:
    """The contacts of a scene in a Pinocchio model; ``frames`` are those of the scene's bodies."""

    def __init__(self, pin: Any, model: Any, scene: Scene, frames: Sequence[Any], dt: float) -> None:
        self._pin, self._model, self._data, self._dt = pin, model, model.createData(), dt
        at = {body.name: frame for body, frame in zip(scene.bodies, frames, strict=True)}
        self.pairs = [(c, at[c.first], at[c.second] if c.second else None) for c in scene.contacts]
        self._above = np.triu_indices(model.nv, 1)
        self._settings = pin.PGSSolverSettings()
        self._settings.max_iterations = SWEEPS
        for kind in ("feasibility", "complementarity"):
            setattr(self._settings, f"absolute_{kind}_tol", TOLERANCE)
            setattr(self._settings, f"relative_{kind}_tol", TOLERANCE)

    def after(self, q: Array, before: Array, free: Array) -> Array:
        """Velocities (nv,) once the contacts at ``q`` have changed those that the step would end with.

        ``before`` (nv,) are those at its start, ``free`` those it would end with if nothing touched.
        """
        pin, model, data = self._pin, self._model, self._data
        pin.computeJointJacobians(model, data, q)
        models, datas, offsets = pin.StdVec_ConstraintModel(), pin.StdVec_ConstraintData(), []
        for contact, first, second in self.pairs:
            found = self._touching(contact, first, second)
            if found.gap > 0 and not contact.friction:
                continue  # a blow falls in the first step that begins inside
            models.append(self._constraint(contact, first, second, found))
            datas.append(models[len(models) - 1].createData())
            offsets.append((contact, found.gap))
        return self._solved(q, before, free, models, datas, offsets) if offsets else free

    def _solved(self, q: Array, before: Array, free: Array, models: Any, datas: Any, offsets: Any) -> Array:
        pin, model, data = self._pin, self._model, self._data
        rows = []
        for one, its in zip(models, datas, strict=True):
            one.calc(model, data, its)
            rows.append(pin.getConstraintJacobian(model, data, one, its))
        J = np.vstack([_along_slip(row, free) for row in rows])
        inverse = pin.computeMinverse(model, data, q)  # Pinocchio fills its upper half
        inverse.T[self._above] = inverse[self._above]
        turned = inverse @ J.T
        meeting, g = J @ before, J @ free
        for k, (contact, gap) in enumerate(offsets):
            # Rough: in one step no deeper than the surface. Smooth: parting at −e times the speed of meeting.
            back = contact.restitution * min(0.0, meeting[3 * k + 2])
            g[3 * k + 2] += gap / self._dt if contact.friction else back
        result, solver = pin.PGSSolverResult(), pin.PGSConstraintSolver(len(g))
        solver.solve(pin.DelassusOperatorDense(J @ turned), g, models, datas, self._settings, result)
        return np.asarray(free + turned @ result.retrieveConstraintImpulses())

    def _touching(self, contact: Any, first: Any, second: Any) -> Touch:
        place = self._placed(first)
        other = self._placed(second) if second else self._pin.SE3.Identity()
        return touch(
            contact.shape,
            place.translation,
            place.rotation,
            contact.against,
            other.translation,
            other.rotation,
        )

    def _constraint(self, contact: Any, first: Any, second: Any, found: Touch) -> Any:
        pin = self._pin
        world = pin.SE3(_axes(found.normal), found.point)
        joints = [frame.parentJoint if frame else 0 for frame in (first, second)]
        places = [self._data.oMi[joint].actInv(world) if joint else world for joint in joints]
        model = pin.PointContactConstraintModel(self._model, joints[0], places[0], joints[1], places[1])
        # Assigning its set does nothing, and reading it back dangles.
        model.setFriction(contact.friction)
        return pin.ConstraintModel(model)

    def _placed(self, frame: Any) -> Any:
        return self._data.oMi[frame.parentJoint] * frame.placement


def _along_slip(J: Array, free: Array) -> Array:
    """A contact's Jacobian (3, nv) with its first direction along the slip: fewer sweeps are then enough."""
    x, y, _ = J @ free
    size = float(np.hypot(x, y))
    if size == 0:
        return J
    turn = np.array([[x, y, 0.0], [-y, x, 0.0], [0.0, 0.0, size]]) / size
    return np.asarray(turn @ J)


def _axes(normal: Array) -> Array:
    """Axes (3, 3), the third of which is ``normal``."""
    x, y, z = normal.tolist()  # by hand: numpy's cross takes longer than the solver
    level = hypot(x, y)
    if level < 1e-6:
        return np.array([[z, 0.0, x], [0.0, 1.0, y], [-x, -y, z]])
    c, s = x / level, y / level
    return np.array([[-s, -c * z, x], [c, -s * z, y], [0.0, level, z]])
