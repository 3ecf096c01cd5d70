"""Ticks from arrays to arrays."""

import numpy as np

from . import _fields
from ._library import Error, Handle, library


def _fill(poses, name, values, shape):
    """Copies what has `shape`, or one row of it for all."""
    values = np.asarray(values, dtype=np.float64)
    try:
        poses[name] = np.broadcast_to(values, shape)
    except ValueError:
        raise Error(f"{name}: the shape {values.shape} does not fit {shape}; give one row for each pose") from None


def _poses(t_s, positions, orientations, velocities):
    t_s = np.asarray(t_s, dtype=np.float64)
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


def solve(scene, preset, t_s, positions, orientations=None, velocities=None):
    """One finger's ticks in turn, each from the state that the last one left.

    t_s: (n,) s. positions: (n, 3) m, centre of the finger, world. orientations: (n, 4) unit quaternions (w, x, y, z),
    finger frame to world, or one for all; none: not turned. velocities: (n, 3) m/s; none: found from the positions.
    Returns (n,) of dtype TICKS. Raises Error on a pose that is not finite, naming it; then nothing was computed.
    """
    poses = _poses(t_s, positions, orientations, velocities)
    if poses.ndim != 1:
        raise Error(f"t_s: has {poses.ndim} dimensions, not 1; solve_fingers takes (fingers, ticks)")
    ticks = _ticks(poses.shape)
    stepper = Handle("stepper", library.tangent_make_stepper, scene._handle.pointer)
    stepper.check(library.tangent_step_many(stepper.pointer, preset._handle.pointer, poses.ctypes.data,
                                            ticks.ctypes.data, poses.size))
    return ticks


def solve_fingers(scene, preset, t_s, positions, orientations=None, velocities=None, threads=0):
    """Many fingers at once, on `threads` threads (0: one per core), the same bits as by `solve` for each.

    t_s: (fingers, ticks) s. positions: (fingers, ticks, 3) m. orientations: (fingers, ticks, 4), velocities: (fingers,
    ticks, 3) m/s, as in solve. Poses that have nothing to do with each other are fingers of one tick. Returns (fingers,
    ticks) of dtype TICKS.
    """
    poses = _poses(t_s, positions, orientations, velocities)
    if poses.ndim != 2:
        raise Error(f"t_s: has {poses.ndim} dimensions, not 2; give it as (fingers, ticks)")
    ticks = _ticks(poses.shape)
    stepper = Handle("stepper", library.tangent_make_stepper, scene._handle.pointer)
    stepper.check(library.tangent_solve_fingers(stepper.pointer, preset._handle.pointer, poses.ctypes.data,
                                                ticks.ctypes.data, poses.shape[0], poses.shape[1], threads))
    return ticks
