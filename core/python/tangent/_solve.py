"""Ticks from arrays to arrays."""

import threading

import numpy as np

from . import _fields
from ._arguments import count, handle_of, reals
from ._library import Error, Handle, library

_LONG = 20_000
"""Poses that take long enough, some milliseconds, for a person to want to interrupt them."""


def _fill(poses, name, values, shape):
    """Copies what has `shape`, or one row of it for all."""
    values = reals(name, values)
    try:
        poses[name] = np.broadcast_to(values, shape)
    except ValueError:
        raise Error(f"{name}: the shape {values.shape} does not fit {shape}; give one row for each pose") from None


def _poses(t_s, positions, orientations, velocities):
    poses = np.zeros(t_s.shape, _fields.INPUT)
    poses["size"] = _fields.INPUT.itemsize
    poses["t_s"] = t_s
    _fill(poses, "position_m", positions, t_s.shape + (3,))
    if orientations is not None:
        _fill(poses, "orientation_wxyz", orientations, t_s.shape + (4,))
    if velocities is not None:
        poses["has_velocity"] = 1
        _fill(poses, "velocity_m_per_s", velocities, t_s.shape + (3,))
    return poses


def _ticks(shape):
    """Room for as many ticks, and the size for the library, which lies outside the fields that are shown."""
    ticks = np.empty(shape, _fields.TICKS)
    if ticks.size:
        ticks.reshape(-1)[:1].view(_fields.SIZE)["size"] = _fields.TICKS.itemsize
    return ticks


def _interruptibly(stepper, call):
    """What `call` returns. Python handles Ctrl-C in its main thread, once that is out of the library: so another thread
    goes there, and is called off."""
    returned = []
    worker = threading.Thread(target=lambda: returned.append(call()))
    try:
        worker.start()
        worker.join()
    except BaseException:
        library.tangent_cancel(stepper.pointer)
        if worker.is_alive():
            worker.join()
        raise
    return returned[0]


def _run(scene, preset, t_s, dimensions, otherwise, motion, solve_all):
    """Ticks of `motion` (positions, orientations, velocities); solve_all(stepper, preset, poses, ticks) is the call."""
    scene, preset = handle_of(scene, "scene"), handle_of(preset, "preset")
    t_s = reals("t_s", t_s)
    if t_s.ndim != dimensions:
        raise Error(f"t_s: has {t_s.ndim} dimensions, not {dimensions}; {otherwise}")
    try:
        poses, ticks = _poses(t_s, *motion), _ticks(t_s.shape)
    except MemoryError:
        raise Error(f"t_s: there is not enough memory for {t_s.size} ticks; solve fewer at a time") from None
    stepper = Handle("stepper", library.tangent_make_stepper, scene.pointer)

    def call():
        return solve_all(stepper.pointer, preset.pointer, poses, ticks.ctypes.data)

    long = poses.size > _LONG and threading.current_thread() is threading.main_thread()
    stepper.check(_interruptibly(stepper, call) if long else call())
    return ticks


def solve(scene, preset, t_s, positions, orientations=None, velocities=None):
    """One finger's ticks in turn, each from the state that the last one left.

    t_s: (n,) s. positions: (n, 3) m, centre of the finger, world. orientations: (n, 4) unit quaternions (w, x, y, z),
    finger frame to world, or one for all; none: not turned. velocities: (n, 3) m/s; none: found from the positions.
    Returns (n,) of dtype TICKS. Raises Error on a pose that is not finite, naming it; then nothing was computed. Ctrl-C
    ends it at once.
    """
    return _run(scene, preset, t_s, 1, "solve_fingers takes (fingers, ticks)", (positions, orientations, velocities),
                lambda stepper, values, poses, ticks: library.tangent_step_many(
                    stepper, values, poses.ctypes.data, ticks, poses.size))


def solve_fingers(scene, preset, t_s, positions, orientations=None, velocities=None, threads=0):
    """Many fingers at once, on `threads` threads (0: one per core), the same bits as by `solve` for each of more
    than one tick.

    t_s: (fingers, ticks) s. positions: (fingers, ticks, 3) m. orientations: (fingers, ticks, 4), velocities: (fingers,
    ticks, 3) m/s, as in solve. Poses that have nothing to do with each other are fingers of one tick: then no
    search is left to the next tick, as a first one of `solve` may be. Returns (fingers, ticks) of dtype TICKS.
    """
    threads = count("threads", threads)
    return _run(scene, preset, t_s, 2, "give it as (fingers, ticks)", (positions, orientations, velocities),
                lambda stepper, values, poses, ticks: library.tangent_solve_fingers(
                    stepper, values, poses.ctypes.data, ticks, *poses.shape, threads))
