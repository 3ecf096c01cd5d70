"""The structs of tangent_c.h, as NumPy and ctypes see them."""

import ctypes

import numpy as np

STATUSES = ("free", "face", "edge", "vertex", "unconverged", "facing")
"""Names of the field `status`, by its value."""
EVENTS = ("none", "first", "reseed", "switch", "branch")
"""Names of the field `event`, by its value."""


def _record(fields):
    """A dtype of a C struct whose members are all aligned by themselves: (name, format, offset), the size last."""
    *members, size = fields
    names, formats, offsets = zip(*members)
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": size})


def _axes(name, unit, offset):
    return [(f"{name}_{axis}{unit}", "<f8", offset + 8 * k) for k, axis in enumerate("xyz")]


INPUT = _record([("size", "<u4", 0), ("has_velocity", "<u4", 4), ("t_s", "<f8", 8), ("position_m", ("<f8", 3), 16),
                 ("orientation_wxyz", ("<f8", 4), 40), ("velocity_m_per_s", ("<f8", 3), 72), 96])
SIZE = np.dtype({"names": ["size"], "formats": ["<u4"], "offsets": [0], "itemsize": 192})
TICKS = _record([("tick", "<u8", 8), ("t_s", "<f8", 16), ("status", "<i4", 4), ("triangle", "<i4", 24),
                 ("u", "<f8", 32), ("v", "<f8", 40), *_axes("contact", "_m", 48), *_axes("normal", "", 72),
                 ("penetration_m", "<f8", 96), *_axes("force", "_n", 104), ("cld_m", "<f8", 128),
                 ("error_m", "<f8", 136), ("iterations", "<i4", 144), ("triangle_changes", "<i4", 148),
                 ("event", "<i4", 28), *_axes("decided_force", "_n", 152), ("decided_cld_m", "<f8", 176),
                 ("searching", "<i4", 184), 192])
"""dtype of what `solve` returns: the columns of ticks.csv, without the time a tick took. SI, world frame; `status` and
`event` index STATUSES and EVENTS; `triangle` is -1 where nothing is tracked."""


class SceneOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("normals", ctypes.c_uint32), ("metres_per_unit", ctypes.c_double),
                ("fit_m", ctypes.c_double), ("crease_rad", ctypes.c_double), ("turn_over", ctypes.c_uint32),
                ("reserved", ctypes.c_uint32)]


class SceneInfo(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("planar", ctypes.c_uint32), ("triangles", ctypes.c_uint64),
                ("usable_triangles", ctypes.c_uint64), ("vertices", ctypes.c_uint64),
                ("content_hash", ctypes.c_uint64), ("memory_bytes", ctypes.c_uint64),
                ("box_min_m", ctypes.c_double * 3), ("box_max_m", ctypes.c_double * 3)]


class MeshAudit(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("reserved", ctypes.c_uint32)]
    _fields_ += [(name, ctypes.c_uint64) for name in (
        "file_vertices", "file_faces", "triangles", "usable_triangles", "vertices", "edges", "components",
        "boundary_edges", "boundary_loops", "non_manifold_edges", "non_manifold_vertices", "inconsistent_edges",
        "crease_edges", "sliver_triangles", "flipped_normals", "wild_normals")]
    _fields_ += [("area_m2", ctypes.c_double), ("max_normal_to_face_deg", ctypes.c_double)]
    _fields_ += [(name, ctypes.c_double * 3) for name in ("edge_length_m", "dihedral_deg", "aspect")]


class DecimateOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_uint32), ("reserved", ctypes.c_uint32), ("angle_deg", ctypes.c_double),
                ("deviation_m", ctypes.c_double), ("aspect", ctypes.c_double)]


def as_dict(struct):
    """The members of a struct by name, arrays as tuples, without what only the interface needs."""
    values = {name: getattr(struct, name) for name, _ in struct._fields_ if name not in ("size", "reserved")}
    return {name: tuple(value) if isinstance(value, ctypes.Array) else value for name, value in values.items()}
