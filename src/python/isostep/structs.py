"""Structs of the C interface as ctypes and numpy types, made from interface.json.

A struct's members are read and written in Python's own values: numbers as float, ids as int, enumerations by name,
truth values as bool, vectors as anything with as many items. What is in the memory stays raw: `raw` and numpy views
have the numbers' bits, so that nothing is rounded by who only looks.
"""

# SPDX-License-Identifier: MIT
import ctypes
import functools
import math
import operator

_C_TYPES = {"float": ctypes.c_float, "double": ctypes.c_double, "int32_t": ctypes.c_int32, "int64_t": ctypes.c_int64,
            "u8": ctypes.c_uint8, "u16": ctypes.c_uint16, "u32": ctypes.c_uint32, "u64": ctypes.c_uint64,
            "i8": ctypes.c_int8, "i16": ctypes.c_int16, "i32": ctypes.c_int32, "i64": ctypes.c_int64,
            "f32": ctypes.c_float, "f64": ctypes.c_double, "bool": ctypes.c_uint8, "enum": ctypes.c_uint32,
            "id": ctypes.c_uint64, "pointer": ctypes.c_uint64, "word": ctypes.c_size_t, "char": ctypes.c_char,
            "reserved": ctypes.c_uint8}
_POINTEES = {"iso_body": ctypes.c_uint64, "uint32_t": ctypes.c_uint32, "int16_t": ctypes.c_int16,
             "uint8_t": ctypes.c_uint8, "double": ctypes.c_double}
_NARROW = ctypes.sizeof(ctypes.c_void_p) == 4  # a struct with words has another layout then
_NUMPY_TYPES = {ctypes.c_float: "<f4", ctypes.c_double: "<f8", ctypes.c_char: "S1"}


def whole(value):
    """An integer of any type, numpy's too, as int; None where it is none."""
    try:
        return operator.index(value)
    except TypeError:
        return None


class Raw:
    """A number of a scalar by its bits: Raw(1 << 32) is 1 in Q32.32. In float and double it is the number itself."""

    def __init__(self, bits):
        self.bits = bits

    def __repr__(self):
        return f"Raw({self.bits})"


class Family:
    """The numbers of one scalar: how Python's floats become its bits, and back."""

    def __init__(self, described):
        self.prefix = described["prefix"]
        self.scalar = described["scalar"]
        self.number = _C_TYPES[described["number"]]
        self.unit = _C_TYPES[described["unit"]]
        self._bits = {"number": described["fraction_bits"], "unit": described["unit_fraction_bits"]}
        self.from_double = {"number": float, "unit": float}  # the library's own, once it is loaded

    def to_raw(self, value, kind="number"):
        """The bits of `value`, nearest to it; `kind` is number, or unit for directions and quaternions."""
        if isinstance(value, Raw):
            return value.bits
        value = float(value)
        if not math.isfinite(value):
            raise ValueError(f"{value} is no number of a world")
        return self.from_double[kind](value)

    def to_float(self, raw, kind="number"):
        """The floats nearest to a number or an array of them: a double has 53 bits, Q32.32 has 64."""
        bits = self._bits[kind]
        return raw if bits == 0 else raw / 2.0**bits


class Enumeration:
    """Names of numbers, and of bits where `flags`."""

    def __init__(self, described):
        self.name = described["name"]
        self.flags = described["flags"]
        self.by_name = {value["base"]: value["value"] for value in described["values"]}
        shared = {name.split("_", 1)[0] + "_" for name in self.by_name}
        if len(shared) == 1 and all("_" in name for name in self.by_name):  # event_started: started
            self.by_name = {name.split("_", 1)[1]: number for name, number in self.by_name.items()}
        self.by_value = {number: name for name, number in self.by_name.items()}

    def number(self, value):
        """The number of a name, of a number of any integer type, or of several where they are flags."""
        if isinstance(value, str):
            if value not in self.by_name:
                raise ValueError(f"no {self.name} '{value}': {', '.join(self.by_name)}")
            return self.by_name[value]
        number = whole(value)
        if number is not None:
            if not 0 <= number < 1 << 32:
                raise ValueError(f"no {self.name} {number}: {', '.join(self.by_name)}")
            return number
        if not self.flags or not hasattr(value, "__iter__"):
            raise ValueError(f"no {self.name} {value!r}: {', '.join(self.by_name)}")
        return functools.reduce(operator.or_, map(self.number, value), 0)

    def text(self, number):
        return self.by_value.get(number, number)


class Struct(ctypes.Structure):
    """A struct of the interface. Attributes convert when read and set; `raw(name)` does not."""

    _members_ = {}
    _family_ = None

    def raw(self, name):
        """The member's own bits, from which another machine computes, where a float would round."""
        return super().__getattribute__("_" + name)

    def set(self, **values):
        """Sets several members at once."""
        for name, value in values.items():
            setattr(self, name, value)
        return self

    def as_dict(self):
        """All members, with structs in it as dictionaries and vectors as tuples."""
        return {name: member.plain(self) for name, member in self._members_.items() if member.is_shown}

    def __getattr__(self, name):
        member = self._members_.get(name)
        if member is None:
            raise AttributeError(f"{type(self).__name__} has no '{name}': {', '.join(self._members_)}")
        return member.get(self)

    def __setattr__(self, name, value):
        if name.startswith("_"):
            super().__setattr__(name, value)
            return
        member = self._members_.get(name)
        if member is None:
            raise AttributeError(f"{type(self).__name__} has no '{name}': {', '.join(self._members_)}")
        member.set(self, value)

    def __iter__(self):
        return (getattr(self, name) for name, member in self._members_.items() if member.is_shown)

    def __len__(self):
        return sum(member.is_shown for member in self._members_.values())

    def __eq__(self, other):
        return bytes(self) == bytes(other) if type(other) is type(self) else tuple(self) == other

    __hash__ = None

    def __repr__(self):
        return f"{type(self).__name__}({', '.join(f'{k}={v!r}' for k, v in self.as_dict().items())})"


class _Member:
    """The read and the write of one member of a struct."""

    def __init__(self, described, c_type, family, interface):
        self.name, self.kind, self.count = described["name"], described["kind"], described.get("count", 0)
        self.c_type, self.family = c_type, family
        self.enumeration = interface.enums[described["of"]] if self.kind == "enum" else None
        self.pointee = interface.pointees.get(described.get("of"))
        self.is_shown = not self.name.startswith("reserved") and self.name != "size"
        self.is_vector = self.kind == "struct" and {"x", "y"} <= set(c_type._members_)

    def get(self, struct):
        raw = struct.raw(self.name)
        if self.count and self.kind == "char":
            return raw.decode()
        return [self._value(one) for one in raw] if self.count else self._value(raw)

    def _value(self, raw):
        if self.kind in ("number", "unit"):
            return self.family.to_float(raw, self.kind)
        if self.kind == "bool":
            return bool(raw)
        return self.enumeration.text(raw) if self.kind == "enum" else raw

    def plain(self, struct):
        value = self.get(struct)
        items = [one.as_dict() if isinstance(one, Struct) else one for one in (value if self.count else [value])]
        if self.is_vector:
            items = [tuple(one.values()) for one in items]
        if self.kind == "char" or not self.count:
            return value if self.kind == "char" else items[0]
        return items

    def set(self, struct, value):
        if self.count and self.kind == "char":
            super(Struct, struct).__setattr__("_" + self.name, value.encode())
            return
        if self.count:
            array = struct.raw(self.name)
            if len(value) > len(array):
                raise ValueError(f"{self.name} has {len(array)} places, {len(value)} were given")
            for i, one in enumerate(value):
                array[i] = self._raw(one, array[i])
            return
        if self.kind == "struct":
            self._raw(value, struct.raw(self.name))
        elif self.kind == "pointer" and whole(value) is None:
            self._point_at(struct, value)
        else:
            super(Struct, struct).__setattr__("_" + self.name, self._raw(value, None))

    def _point_at(self, struct, values):
        """Points the member at an array of these values, which lives as long as the struct; a count with the member's
        name follows them."""
        array = (self.pointee * len(values))(*values)
        if f"{self.name}_count" in struct._members_:
            struct.set(**{f"{self.name}_count": len(values)})
        super(Struct, struct).__setattr__("_" + self.name, ctypes.addressof(array))
        root = struct
        while root._b_base_ is not None:
            root = root._b_base_
        root.__dict__.setdefault("_kept", []).append(array)

    def _raw(self, value, place):
        """The value for the memory; for a struct, `place` with these members, or with these values in order."""
        if self.kind in ("number", "unit"):
            return self.family.to_raw(value, self.kind)
        if self.kind == "bool":
            if value not in (0, 1):
                raise ValueError(f"{self.name} is True or False, not {value!r}")
            return int(value)
        if self.kind == "enum":
            return self.enumeration.number(value)
        if self.kind == "struct":
            return fill(place, value)
        if self.c_type in (ctypes.c_float, ctypes.c_double):
            return value
        bits, number = 8 * ctypes.sizeof(self.c_type), whole(value)
        low = -(1 << bits - 1) if self.kind.startswith("i") and self.kind != "id" else 0
        if number is None or not low <= number < low + (1 << bits):
            raise ValueError(f"{self.name} does not hold {value!r}")
        return number


def fill(struct, values):
    """Fills `struct` with the members of a mapping, the items of a sequence, or all of an equal struct."""
    if isinstance(values, type(struct)):
        ctypes.pointer(struct)[0] = values
    elif hasattr(values, "items"):
        struct.set(**values)
    else:
        names = [name for name, member in struct._members_.items() if member.is_shown]
        values = list(values)
        if len(values) != len(names):
            raise ValueError(f"{type(struct).__name__} has {len(names)} members, {len(values)} were given")
        struct.set(**dict(zip(names, values)))
    return struct


def _place(described, key):
    """The offset of a member or the size of a struct on this machine."""
    return described.get(f"{key}32", described[key]) if _NARROW else described[key]


class Interface:
    """All types of interface.json, by their names in C."""

    def __init__(self, described):
        self.version, self.abi = described["version"], described["abi"]
        self.families = {family["prefix"]: Family(family) for family in described["families"]}
        self.enums = {one["name"]: Enumeration(one) for one in described["enums"]}
        self.pointees = {one["name"]: _POINTEES.get(one["to"]) for one in described["pointers"]}
        self.structs = {}
        for struct in described["structs"]:
            self.structs[struct["name"]] = self._make_struct(struct)
        self.functions = described["functions"]
        self._dtypes = {}

    def family_of(self, scalar):
        """The family by its name in C ("q32") or in replays ("q32.32")."""
        for family in self.families.values():
            if scalar in (family.prefix, family.scalar):
                return family
        raise ValueError(f"no scalar '{scalar}': {', '.join(self.families)}")

    def c_type(self, member, family):
        """The type of one element of a member."""
        if member["kind"] in ("number", "unit"):
            return getattr(family, member["kind"])
        return self.structs[member["of"]] if member["kind"] == "struct" else _C_TYPES[member["kind"]]

    def _make_struct(self, described):
        family = self.families.get(described["family"])
        fields, members = [], {}
        for member in described["members"]:
            if member["kind"] == "reserved":
                member = {**member, "count": member["size"]}
            one = self.c_type(member, family)
            fields.append(("_" + member["name"], one * member["count"] if member.get("count") else one))
            members[member["name"]] = _Member(member, one, family, self)
        made = type(described["name"], (Struct,), {"_fields_": fields, "_members_": members, "_family_": family,
                                                   "is_sized": described["sized"]})
        offsets = {name: getattr(made, "_" + name).offset for name in members}
        expected = {member["name"]: _place(member, "offset") for member in described["members"]}
        if offsets != expected or ctypes.sizeof(made) != _place(described, "size"):
            raise ImportError(f"{described['name']} is laid out in another way here than interface.json says")
        return made

    def dtype(self, c_type):
        """The numpy type over the same memory; padding is left out."""
        import numpy

        if not issubclass(c_type, Struct):
            kind = _NUMPY_TYPES.get(c_type)
            return numpy.dtype(kind or f"<{'i' if c_type(-1).value < 0 else 'u'}{ctypes.sizeof(c_type)}")
        if c_type not in self._dtypes:
            names, formats, offsets = [], [], []
            for name, member in c_type._members_.items():
                if not member.is_shown:
                    continue
                one = self.dtype(member.c_type)
                if member.kind == "char":
                    one = numpy.dtype(f"S{member.count}")
                elif member.count:
                    one = numpy.dtype((one, (member.count,)))
                names.append(name)
                formats.append(one)
                offsets.append(getattr(c_type, "_" + name).offset)
            self._dtypes[c_type] = numpy.dtype({"names": names, "formats": formats, "offsets": offsets,
                                                "itemsize": ctypes.sizeof(c_type)})
        return self._dtypes[c_type]
