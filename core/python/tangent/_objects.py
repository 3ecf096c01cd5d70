"""Scenes and presets."""

import ctypes
import math

from . import _fields
from ._arguments import handle_of, number, text
from ._library import VERSION, Error, Handle, library


def _sized(struct, **values):
    return struct(size=ctypes.sizeof(struct), **values)


class Scene:
    """A mesh, or a polygon in 2D, and what searches in it need. Immutable; made by load_scene and decimate.

    info: dict with planar (1: 2D), triangles, usable_triangles, vertices, content_hash, memory_bytes, box_min_m and
    box_max_m (world, 3 values each).
    """

    def __init__(self, handle):
        self._handle = handle

    @property
    def info(self):
        info = _sized(_fields.SceneInfo)
        self._handle.check(library.tangent_get_scene_info(self._handle.pointer, ctypes.byref(info)))
        return _fields.as_dict(info)

    def write(self, path, metres_per_unit=1e-3):
        """Writes the mesh as OBJ, positions in units of `metres_per_unit` m. Whole or not at all."""
        self._handle.check(library.tangent_write_mesh(self._handle.pointer, text("path", path),
                                                     number("metres_per_unit", metres_per_unit)))

    def __repr__(self):
        return f"<tangent.Scene of {self.info['triangles']} triangles>"


def load_scene(path, metres_per_unit=1e-3, fit_m=None, normals="auto", crease_deg=45.0, turn_over=False):
    """Reads a mesh (.obj, .ply, .stl, .off) or a polygon (.csv, .obj with a line element). Returns a Scene.

    metres_per_unit: of the file's coordinates. fit_m: bounding-box centre to the origin, longest side to this many
    metres. normals: "auto" (the file's where every corner has one), "file" or "computed". crease_deg: edges whose
    dihedral angle exceeds this many degrees are creases (computed normals). turn_over: closed parts that are inside out
    are turned over. Raises Error, which names file and line.
    """
    sources = ("auto", "file", "computed")
    if not isinstance(normals, str) or normals not in sources:
        raise Error(f"normals: {normals!r} is not known; choose auto, file or computed")
    options = _sized(_fields.SceneOptions, normals=sources.index(normals),
                     metres_per_unit=number("metres_per_unit", metres_per_unit),
                     fit_m=0.0 if fit_m is None else number("fit_m", fit_m),
                     crease_rad=math.radians(number("crease_deg", crease_deg)), turn_over=bool(turn_over))
    return Scene(Handle("scene", library.tangent_load_scene, VERSION, text("path", path), ctypes.byref(options)))


def audit(scene):
    """Properties and defects of a 3D scene's mesh: dict of counts, area_m2, max_normal_to_face_deg, and (least, median,
    largest) of edge_length_m, dihedral_deg and aspect. Not for one scene from two threads at a time."""
    found = _sized(_fields.MeshAudit)
    handle = handle_of(scene, "scene")
    handle.check(library.tangent_audit(handle.pointer, ctypes.byref(found)))
    return _fields.as_dict(found)


def decimate(scene, angle_deg=14.8, deviation_m=0.0, aspect=12.0):
    """A Scene with as few triangles as a finger can't tell from `scene`'s.

    angle_deg: largest angle between facets across a smooth edge that is left; 14.8 is the paper's pilot threshold where
    force and display are smooth. deviation_m: largest distance, at samples, of the new smooth surface from the old; 0: a
    thousandth of the mesh's longest side. aspect: of a new triangle, longest side over smallest height.
    """
    options = _sized(_fields.DecimateOptions, angle_deg=number("angle_deg", angle_deg),
                     deviation_m=number("deviation_m", deviation_m), aspect=number("aspect", aspect))
    pointer = handle_of(scene, "scene").pointer
    return Scene(Handle("scene", library.tangent_decimate, pointer, ctypes.byref(options)))


def _names(function, *arguments):
    names = []
    while (name := function(*arguments, len(names))) is not None:
        names.append(name.decode())
    return names


class Preset:
    """Everything a person tunes, by the names, units (SI) and ranges of presets/default.toml.

    preset["solver.gain_overall"] is a float; of a key that chooses among words (preset["solver.method"]) it is the word.
    Setting refuses unknown keys, words and values out of range, and then changes nothing. Not to be written while
    another thread uses it.
    """

    def __init__(self, handle):
        self._handle = handle

    @staticmethod
    def keys():
        """All names, in the order of the file."""
        return _names(library.tangent_preset_key)

    @staticmethod
    def choices(key):
        """The words that a key chooses from; empty for one that is a number."""
        return _names(library.tangent_preset_choice, text("key", key))

    def __getitem__(self, key):
        value = ctypes.c_double()
        self._handle.check(library.tangent_get_value(self._handle.pointer, text("key", key), ctypes.byref(value)))
        words = self.choices(key)
        return words[int(value.value)] if words else value.value

    def __setitem__(self, key, value):
        if isinstance(value, str):
            words = self.choices(key)
            if words and value not in words:
                raise Error(f"{key}: {value!r} is not one of its words; choose {', '.join(words)}")
            value = words.index(value) if words else value
        status = library.tangent_set_value(self._handle.pointer, text("key", key), number(key, value))
        self._handle.check(status)

    def __iter__(self):
        return iter(self.keys())

    def __len__(self):
        return len(self.keys())

    def write(self, path):
        """Writes every key with its unit and range; values read back as the same float. Whole or not at all."""
        self._handle.check(library.tangent_write_preset(self._handle.pointer, text("path", path)))


def make_preset():
    """The built-in values."""
    return Preset(Handle("preset", library.tangent_make_preset, VERSION))


def read_preset(path):
    """Reads a preset (TOML). Raises Error, which names file, line, key and range."""
    return Preset(Handle("preset", library.tangent_read_preset, VERSION, text("path", path)))
