"""python_test.py PAGE TICKS MESH PRESET POSES: the examples of PAGE; that a path solved in Python is TICKS, which the
program wrote; and that what can't be used is an error. Runs beside sphere.obj and default.toml."""

import copy
import csv
import ctypes
import os
import re
import signal
import sys
import threading

import numpy as np
import tangent
from tangent._library import library


def check(holds, what):
    if not holds:
        sys.exit(f"python_test: {what}")


def run_page(page):
    blocks = re.findall(r"```python\n(.*?)```", open(page, encoding="utf-8").read(), re.S)
    check(len(blocks) > 5, "the page has lost its examples")
    names = {}
    for number, block in enumerate(blocks, 1):
        exec(compile(block, f"{page}, example {number}", "exec"), names)


def check_ticks(ticks_file, mesh, preset_file, poses_file):
    poses = np.genfromtxt(poses_file, delimiter=",", names=True)
    positions = np.stack([poses["x_m"], poses["y_m"], poses["z_m"]], axis=-1)
    scene = tangent.load_scene(mesh, fit_m=0.08)
    ticks = tangent.solve(scene, tangent.read_preset(preset_file), poses["t_s"], positions)
    rows = list(csv.DictReader(open(ticks_file, encoding="utf-8")))
    check(len(rows) == len(ticks), "another number of ticks")
    shown = [name for name in rows[0] if name != "solve_ns"]
    check(set(shown) == set(ticks.dtype.names), f"fields other than the columns: {set(shown) ^ set(ticks.dtype.names)}")
    for name in shown:
        words = {"status": tangent.STATUSES, "event": tangent.EVENTS}.get(name)
        theirs = [words.index(row[name]) if words else float(row[name]) for row in rows]
        check((ticks[name] == np.array(theirs)).all(), f"{name} differs from ticks.csv")
    return scene


def fails(words, function, *arguments, **named):
    try:
        function(*arguments, **named)
    except tangent.Error as error:
        check(words in str(error), f"the error says {error}, not {words}")
        return
    check(False, f"no error about {words}")


def check_errors(scene):
    preset = tangent.make_preset()
    fails("nowhere.obj", tangent.load_scene, "nowhere.obj")
    fails("nowhere.toml", tangent.read_preset, "nowhere.toml")
    fails("choose auto", tangent.load_scene, "sphere.obj", normals="none")
    fails("allowed", preset.__setitem__, "solver.gain_overall", -1.0)
    fails("no such key", preset.__getitem__, "solver.nothing")
    fails("choose paper", preset.__setitem__, "solver.method", "magic")
    fails("shape", tangent.solve, scene, preset, [0.0, 1.0], np.zeros((3, 3)))
    fails("dimensions", tangent.solve_fingers, scene, preset, [0.0], np.zeros((1, 3)))
    fails("pose 1: orientation_wxyz", tangent.solve, scene, preset, [0.0, 1.0], np.zeros((2, 3)),
          orientations=[[1, 0, 0, 0], [2, 0, 0, 0]])
    check(tangent.solve(scene, preset, [], np.zeros((0, 3))).shape == (0,), "no poses are no ticks")
    check(tangent.version()[:2] == (0, 1), "the version is not 0.1")


def check_arguments(scene):
    """What is no scene, number, text or array is an error of ours, before the library is told its address."""
    preset, one, twice = tangent.make_preset(), np.zeros((1, 3)), np.zeros((2, 3))
    fails("not a tangent.Scene", tangent.solve, preset, scene, [0.0], one)
    fails("not a tangent.Preset", tangent.solve, scene, None, [0.0], one)
    fails("not a tangent.Scene", tangent.audit, preset)
    fails("not text", tangent.load_scene, None)
    fails("zero byte", tangent.load_scene, "sphere.obj\0.obj")
    fails("zero byte", preset.__getitem__, "solver.gain_overall\0")
    fails("not text", preset.__getitem__, 3)
    fails("no number", tangent.load_scene, "sphere.obj", metres_per_unit="mm")
    fails("no number", preset.__setitem__, "solver.gain_overall", None)
    fails("metres_per_unit", tangent.load_scene, "sphere.obj", metres_per_unit=-1)
    fails(".", tangent.read_preset, ".")
    fails("rows differ", tangent.solve, scene, preset, [0.0, 1.0], [[0, 0, 0], [0, 0]])
    fails("complex128", tangent.solve, scene, preset, [0.0], one + 1j)
    fails("not real", tangent.solve, scene, preset, ["now"], one)
    fails("masked", tangent.solve, scene, preset, [0.0], np.ma.masked_equal(one, 0.0))
    fails("shape (3, 2)", tangent.solve, scene, preset, [0.0, 1.0], twice.T)
    fails("shape", tangent.solve, scene, preset, [0.0, 1.0], twice, velocities=np.zeros((2, 2)))
    fails("threads: -1", tangent.solve_fingers, scene, preset, [[0.0]], [one], threads=-1)
    fails("threads", tangent.solve_fingers, scene, preset, [[0.0]], [one], threads=1.5)
    fails("memory", tangent.solve, scene, preset, np.broadcast_to(0.0, (10**13,)), [0.0, 0.0, 0.1])
    fails("pickled", copy.deepcopy, scene)
    check(tangent.solve_fingers(scene, preset, np.zeros((3, 0)), np.zeros((3, 0, 3))).shape == (3, 0), "no ticks")


def check_arrays(scene):
    """Other layouts and types of the same numbers give the same ticks, and nobody's arrays are written to."""
    preset, t_s = tangent.make_preset(), np.arange(4) * 1e-3
    positions = np.float32([[0.0, 0.01, 0.05 - 0.001 * i] for i in range(4)]).astype(np.float64)
    expected = tangent.solve(scene, preset, t_s, positions)
    spread = np.zeros((8, 6))
    spread[::2, ::2] = positions
    frozen = positions.copy()
    frozen.flags.writeable = False
    for other in (spread[::2, ::2], positions.T.copy().T, positions.astype(np.float32), positions.astype(">f8"), frozen,
                  positions.tolist(), positions[::-1].copy()[::-1]):
        check((tangent.solve(scene, preset, t_s, other) == expected).all(), f"other ticks from {type(other)}")
    check((frozen == positions).all(), "an array of the caller was changed")


def check_interrupt(scene):
    """Ctrl-C ends a long batch at once, as KeyboardInterrupt, and what comes after is as before."""
    preset, n = tangent.make_preset(), 1_000_000
    places = np.broadcast_to([0.0, 0.01, 0.05], (n, 3))
    before = tangent.solve(scene, preset, [0.0], places[:1])
    for many in (False, True):
        timer = threading.Timer(0.02, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        try:
            while True:  # until it comes, wherever the machine is just then
                if many:
                    tangent.solve_fingers(scene, preset, np.zeros((1000, n // 1000)), places.reshape(1000, -1, 3))
                else:
                    tangent.solve(scene, preset, np.arange(n) * 1e-3, places)
        except KeyboardInterrupt:
            pass
        timer.join()
        check(threading.active_count() == 1, "a thread is left of the interrupted batch")
        check((tangent.solve(scene, preset, [0.0], places[:1]) == before).all(), "other ticks after an interrupt")


def check_threads(scene):
    """The interpreter's lock is released (ctypes does so for a CDLL), and several threads at once give the same ticks."""
    check(type(library) is ctypes.CDLL, "calls keep the interpreter's lock")
    preset, n, found = tangent.make_preset(), 2000, []
    positions = np.tile([[0.0, 0.0, 0.05]], (n, 1)) + np.linspace(0, 0.01, n)[:, None]
    stamps = np.arange(n) * 1e-3
    threads = [threading.Thread(target=lambda: found.append(tangent.solve(scene, preset, stamps, positions)))
               for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    alone = tangent.solve(scene, preset, stamps, positions)
    check(len(found) == 3 and all((ticks == alone).all() for ticks in found), "threads find other ticks")


page, ticks_file, mesh, preset_file, poses_file = sys.argv[1:]
run_page(page)
spot = check_ticks(ticks_file, mesh, preset_file, poses_file)
check_errors(spot)
check_arguments(spot)
check_arrays(spot)
check_interrupt(spot)
check_threads(spot)
