"""Finds the shared library of isostep, loads it, and knows its functions by their names.

Looked for in this order: where the environment variable ISOSTEP_LIBRARY says; beside this package; in lib of the prefix
that this package is installed below; where the system's loader finds it.
"""

# SPDX-License-Identifier: MIT
import ctypes
import json
import os
import pathlib
import sys

from .calls import Call, Handle
from .errors import Refused, error_of
from .structs import Interface, Struct, fill

_HERE = pathlib.Path(__file__).resolve().parent


def _file_name(abi):
    if sys.platform == "win32":
        return "isostep.dll"
    return f"libisostep.{abi}.dylib" if sys.platform == "darwin" else f"libisostep.so.{abi}"


def _candidates(abi):
    name = _file_name(abi)
    told = os.environ.get("ISOSTEP_LIBRARY")
    if told:
        yield told  # and no other: who says where means that one
        return
    yield str(_HERE / name)
    for parent in list(_HERE.parents)[:4]:
        for pattern in (f"lib*/{name}", f"lib*/*/{name}", f"bin/{name}"):
            yield from (str(found) for found in sorted(parent.glob(pattern))[:1])
    yield name


class Library:
    """The functions of one shared library, compiled when they are used first."""

    handles = ("world", "snapshot", "tape", "replay", "blob", "session", "network")

    def __init__(self):
        with open(_HERE / "interface.json", encoding="utf-8") as file:
            described = json.load(file)
        self.interface = Interface(described)
        self._described = {one["name"]: one for one in described["functions"]}
        self._library = self._load()
        self._calls, self._classes = {}, {}
        for family in self.interface.families.values():
            family.from_double = {"number": self.call(f"iso_{family.prefix}_from_double").function,
                                  "unit": self.call(f"iso_{family.prefix}_unit_from_double").function}
        found = self.call("iso_abi_version")()
        if found != self.interface.abi:
            raise ImportError(f"isostep: the library has ABI {found}, this package is for {self.interface.abi}")

    def _load(self):
        tried = []
        for candidate in _candidates(self.interface.abi):
            if os.path.isabs(candidate) and not os.path.exists(candidate):
                tried.append(candidate)
                continue
            try:
                return ctypes.CDLL(candidate)
            except OSError as error:
                tried.append(str(error))
        raise ImportError("isostep: no shared library; set ISOSTEP_LIBRARY to its path. Tried: " + "; ".join(tried))

    def raw(self, name):
        """The C function itself."""
        return getattr(self._library, name)

    def call(self, name):
        """The function `name` of isostep.h as a Python function: calls.py."""
        if name not in self._calls:
            if name not in self._described:
                raise AttributeError(f"isostep.h has no function {name}")
            self._calls[name] = Call(self, self._described[name])
        return self._calls[name]

    def has(self, name):
        return name in self._described

    def numbers_of(self, described):
        """The arguments that are numbers of the scalar: float in f32 and double in f64."""
        if not described["family"]:
            return ()
        rest = described["name"].split("_", 2)[2]
        single, double = (self._described[f"iso_{family}_{rest}"]["arguments"] for family in ("f32", "f64"))
        return tuple(one["name"] for one, other in zip(single, double)
                     if one["type"].strip("*") == "float" and other["type"].strip("*") == "double")

    def last_error(self):
        return self.call("iso_last_error")() or "unknown error"

    def error(self, status, owner):
        """The exception of a status, with what the world says of it."""
        if status > 0 and getattr(owner, "_kind", "") == "world":
            fault = self.call("iso_world_fault")(owner)
            if fault.raw("status") == status:
                texts = [ctypes.string_at(fault.raw(name)).decode() if fault.raw(name) else ""
                         for name in ("command", "field", "expected")]
                return Refused(status, self.last_error(), *texts)
        return error_of(status, self.last_error())

    def register(self, *classes):
        """The Python classes of handles that calls hand out."""
        self._classes.update({one._kind: one for one in classes})

    def wrap(self, kind, address):
        return self._classes[kind]._of(self, address)

    def new(self, name):
        """iso_NAME with its defaults."""
        return self.filled(self.interface.structs[f"iso_{name}"](), {})

    def filled(self, struct, values):
        """`struct` with its defaults, then with `values`: a mapping, items in order, or an equal struct."""
        name = type(struct).__name__
        if struct.is_sized and name + "_init_sized" in self._described:
            self.raw(name + "_init_sized")(ctypes.byref(struct), ctypes.c_size_t(ctypes.sizeof(struct)))
        elif name + "_init" in self._described:
            self.raw(name + "_init")(ctypes.byref(struct))
        else:
            _upright(struct)
        return fill(struct, values)


def _upright(struct):
    """Quaternions of a new struct turn nothing."""
    for name, member in struct._members_.items():
        if member.kind == "struct" and not member.count:
            _upright(struct.raw(name))
    if type(struct).__name__.endswith("_quat"):
        struct.set(w=1.0)


__all__ = ["Handle", "Library", "Struct"]
