"""PyBullet's own settings that a reader should know, in words."""

SETTINGS = {
    "damping": "none, linear or angular (PyBullet's own default in reduced coordinates is 0.04)",
    "velocity limit": "none (PyBullet's own default in reduced coordinates is 100)",
    "motors": "without force (PyBullet's own hold every joint)",
    "sleeping": "off",
    "springs and forces": "ours, handed over at the start of each step; PyBullet has neither",
    "reactions": "by sensors in the joints of a copy, which takes the step that they speak of the start of",
    "batches": "without springs, dampers, forces and contacts up to 256 steps in one call, by numSubSteps",
    "solids": "PyBullet is told their mass and centre and works out the moments; cylinders by "
    "URDF_USE_IMPLICIT_CYLINDER (PyBullet's own give the moments of a box around them)",
    "contacts": "200 iterations, no tolerance, no correction of depths, no least speed of a bounce",
}
