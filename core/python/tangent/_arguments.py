"""What callers give, checked before the library sees it: the library is told addresses, and believes them."""

import operator
import os

import numpy as np

from ._library import Error, Handle


def handle_of(thing, kind):
    """The handle in a Scene (`kind` scene) or Preset (preset); anything else is an error."""
    handle = getattr(thing, "_handle", None)
    if not isinstance(handle, Handle) or handle.kind != kind:
        maker = {"scene": "load_scene", "preset": "read_preset"}[kind]
        raise Error(f"{kind}: this is a {type(thing).__name__}, not a tangent.{kind.title()}; {maker} makes one")
    return handle


def text(name, value):
    """Bytes for the library, which ends them at a zero."""
    try:
        encoded = os.fsencode(value)
    except TypeError:
        raise Error(f"{name}: this is a {type(value).__name__}, not text; give a string or a path") from None
    if b"\0" in encoded:
        raise Error(f"{name}: there is a zero byte in {value!r}; leave it out")
    return encoded


def number(name, value):
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise Error(f"{name}: {value!r} is no number; give one") from None


def count(name, value):
    """For a uint32_t."""
    try:
        value = operator.index(value)
    except TypeError:
        raise Error(f"{name}: {value!r} is no whole number; give one from 0") from None
    if not 0 <= value < 2**32:
        raise Error(f"{name}: {value} is out of range; give 0 for one per core, or their number")
    return value


def reals(name, values):
    """An array of float64, of any shape; not what would lose something on the way there."""
    if np.ma.is_masked(values):
        raise Error(f"{name}: some values are masked; leave these rows out")
    try:
        values = np.asarray(values)
    except ValueError:
        raise Error(f"{name}: its rows differ in length; give an array with a row for each pose") from None
    if values.size and values.dtype.kind not in "fiu":
        raise Error(f"{name}: it holds {values.dtype}, not real numbers; give float64")
    return values.astype(np.float64, copy=False)
