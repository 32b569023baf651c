"""MuJoCo's own settings that a reader should know, in words."""

SETTINGS = {
    "autoreset": "off: a state that is not finite stays what it is and is reported",
    "eulerdamp": "off: Euler takes dampers at the start of the step, as its twins do",
    "contact, constraint": "off, but where a scene has contacts",
    "contacts": "impedance 0.9999; a blow without spring, damped at (1 + e)/dt; a rough contact with a "
    "spring of 1/dt², damped at 1/dt; elliptic cone, impratio 10, tolerance 0; what slides: impedance "
    "0.995, impratio 1e4, friction undamped; under a rim: impedance 0.99, impratio 1e4",
    "solids": "geoms of a density, from which the compiler works out masses, centres and inertias; meshes "
    "as they are (inertia exact)",
    "free bodies": "moved by their centre of mass, wherever their origin is, as PyBullet moves them",
    "forces": "by the callback for passive forces, at every stage of a step",
    "reactions": "by mj_rnePostConstraint, at the accelerations of the very state; forces of the callback, "
    "which it leaves in, are told it again as xfrc_applied, which it takes off",
    "sameframe": "none, where the inertial frame differs at all from the body's; "
    "MuJoCo by itself drops offsets below 1e-6 m and turns below 1e-6",
}
