"""Haptic shading in Python: contact, force and contact location of a finger on a coarse mesh.

>>> import tangent, numpy as np
>>> scene = tangent.load_scene("sphere.obj", metres_per_unit=1e-3)
>>> preset = tangent.read_preset("default.toml")
>>> ticks = tangent.solve(scene, preset, t_s, positions)   # structured array, fields named as in ticks.csv

SI units, right-handed world frame. The finger frame has +x along the finger towards its tip and -z out of the fingerpad;
orientations are unit quaternions (w, x, y, z) from it to the world. Arrays are float64. Every failure is a
`tangent.Error` that says what, where and what to do. The interpreter's lock is released while anything is computed.

Scenes may be shared by threads; a preset may be while nobody writes it. `solve` makes what it needs for each call, so it
can be called from any number of threads.
"""

from ._fields import EVENTS, STATUSES, TICKS
from ._library import Error, version
from ._objects import Preset, Scene, audit, decimate, load_scene, make_preset, read_preset
from ._solve import solve, solve_fingers

__all__ = ["EVENTS", "STATUSES", "TICKS", "Error", "Preset", "Scene", "audit", "decimate", "load_scene", "make_preset",
           "read_preset", "solve", "solve_fingers", "version"]
