"""throughput.py MESH PRESET N: as throughput.cpp, what Python does with the arrays included."""

import sys
import time

import numpy as np
import tangent


def report(name, poses, work):
    least = 1e300
    for _ in range(5):
        began = time.perf_counter_ns()
        work()
        least = min(least, time.perf_counter_ns() - began)
    print(f"{name:22} {least / poses:7.1f} ns a pose")


scene, preset, n = tangent.load_scene(sys.argv[1]), tangent.read_preset(sys.argv[2]), int(sys.argv[3])
t_s = 1e-3 * np.arange(n)
positions = np.stack([np.zeros(n), 0.059 * np.sin(t_s), 0.059 * np.cos(t_s)], axis=-1)
report("Python", n, lambda: tangent.solve(scene, preset, t_s, positions))
report("Python, 100 fingers", n, lambda: tangent.solve_fingers(scene, preset, t_s.reshape(100, -1),
                                                               positions.reshape(100, -1, 3)))
