"""Functions of the C interface as Python calls, made from their declarations in interface.json.

What a function takes is given in Python's values; what it hands out through pointers, an id, a struct, an array, is
what the call returns, several as a tuple. A status that is no success becomes an exception.
"""

# SPDX-License-Identifier: MIT
import ctypes
import operator

from .errors import Closed, error_of

try:
    import numpy
except ImportError:  # arrays are ctypes' own then
    numpy = None

PLAIN = {"size_t": ctypes.c_size_t, "float": ctypes.c_float, "double": ctypes.c_double, "char": ctypes.c_char,
          "uint8_t": ctypes.c_uint8, "int8_t": ctypes.c_int8, "uint16_t": ctypes.c_uint16, "int16_t": ctypes.c_int16,
          "uint32_t": ctypes.c_uint32, "int32_t": ctypes.c_int32, "uint64_t": ctypes.c_uint64,
          "int64_t": ctypes.c_int64, "iso_status": ctypes.c_int32, "iso_body": ctypes.c_uint64,
          "iso_shape": ctypes.c_uint64, "iso_joint": ctypes.c_uint64, "iso_record": ctypes.c_uint64}
SMALL_BUFFER, NOT_ALIVE = -4, -9


class Handle:
    """An object of the library, closed by `close`, by `with`, or when nobody has it any more. Once closed it raises
    Closed, whatever it is asked but `is_open` and `close`."""

    _kind = ""  # "world": destroyed by iso_world_destroy

    def __init__(self, library, address):
        self._library, self._address = library, address

    def _take(self, other):
        """What `other` had is this object's now."""
        self._library, self._address = other._library, other._address
        other._address = 0

    @classmethod
    def _of(cls, library, address):
        """The object of an address that a call hands out."""
        made = cls.__new__(cls)
        Handle.__init__(made, library, address)
        return made

    @property
    def is_open(self):
        return self._address != 0

    def _open(self):
        """The object's address."""
        if not self._address:
            raise Closed(NOT_ALIVE, f"the {self._kind} was closed")
        return self._address

    def close(self):
        """Destroys it; arrays that it gave stay. A second call does nothing."""
        if self._address:
            status = self._destroy()
            if status:
                raise error_of(status, self._library.last_error())
            self._address = 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __del__(self):
        if getattr(self, "_address", 0):
            self._destroy()

    def _destroy(self):
        # The address goes as a pointer: ctypes would hand on the low 32 bits of a plain number.
        return self._library.raw(f"iso_{self._kind}_destroy")(ctypes.c_void_p(self._address))


def copied(c_type, address, count, dtype):
    """`count` elements in the library's memory as they are now: a read-only numpy array or, without numpy, ctypes'
    own. The elements go with their owner, or the next call moves them; a copy costs less than the call."""
    size = count * ctypes.sizeof(c_type)
    data = ctypes.string_at(address, size) if size else b""
    if numpy is None:
        return (c_type * count).from_buffer_copy(data)
    return numpy.frombuffer(data, dtype=dtype) if size else numpy.zeros(0, dtype=dtype)


def owned(array, count, dtype):
    """The first elements of a ctypes array that is Python's: a numpy array over the same memory, or itself."""
    if numpy is None:
        return array if len(array) == count else (array._type_ * count).from_buffer(array)
    return numpy.frombuffer(array, dtype=dtype, count=count) if count else numpy.zeros(0, dtype=dtype)


class _Declared:
    """A type of a declaration: "const iso_q32_vec3*"."""

    def __init__(self, text):
        self.is_const = text.startswith("const ")
        self.stars = text.count("*")
        self.base = text.replace("const", "").replace("*", "").strip()


class _Run:
    """One execution: `room` for results of unknown size, `need` as the function tells it."""

    def __init__(self, room):
        self.room, self.need = room, None


class Call:
    """One function, by steps: one that takes a value and returns C arguments for it, or one that returns C arguments
    for something handed out and a function that reads it afterwards."""

    def __init__(self, library, described):
        self.library, self.name = library, described["name"]
        self.interface = library.interface
        self.family = self.interface.families.get(described["family"])
        self.numbers = library.numbers_of(described)
        self.takes, self.steps, self.room, self.repeats = [], [], 0, False
        declared = [(_Declared(one["type"]), one["name"]) for one in described["arguments"]]
        result = _Declared(described["returns"])
        self.function = library.raw(self.name)
        self.function.argtypes = [ctypes.c_void_p if one.stars else self._element(one.base) for one, _ in declared]
        self.function.restype = self._result_type(result)
        self.gives_status = result.base == "iso_status"
        self.read_result = self._result_reader(result)
        i = 0
        while i < len(declared):
            i += self._compile(declared, i)

    def __call__(self, *values):
        if len(values) != len(self.takes):
            raise TypeError(f"{self.name} takes {', '.join(self.takes)}")
        run = _Run(self.room)
        while True:
            arguments, readers, given = [], [], iter(values)
            for takes, step in self.steps:
                if takes:
                    arguments.extend(step(next(given)))
                else:
                    more, read = step(run)
                    arguments.extend(more)
                    readers.append(read)
            result = self.function(*arguments)
            if self.gives_status and result == SMALL_BUFFER and self.repeats and run.need() > run.room:
                run.room = run.need()
                continue
            break
        if self.gives_status and result != 0:
            raise self.library.error(result, values[0] if values else None)
        read = [one() for one in readers]
        if not self.gives_status:
            read.insert(0, self.read_result(result, run))
        return read[0] if len(read) == 1 else tuple(read) if read else None

    # Types

    def _element(self, base):
        if base in self.interface.enums:
            return ctypes.c_uint32
        return self.interface.structs.get(base) or PLAIN.get(base)

    def _result_type(self, result):
        if result.stars:
            return ctypes.c_char_p if result.base == "char" else ctypes.c_void_p
        return self._element(result.base)

    def _result_reader(self, result):
        if result.stars and result.base == "char":
            return lambda value, run: value.decode() if value is not None else None
        if self.name.endswith("_from_double"):
            return lambda value, run: value  # bits
        if self.name.endswith("_to_double") or result.base not in self.interface.enums:
            return lambda value, run: value
        return lambda value, run: self.interface.enums[result.base].text(value)

    def _dtype(self, element):
        return self.interface.dtype(element) if numpy is not None else None

    # Compiling

    def _compile(self, declared, i):
        """Appends the step of argument i and of those that go with it; returns how many these are."""
        one, name = declared[i]
        after = [(other.base, other.stars) for other, _ in declared[i + 1:i + 3]] + [("", 0)] * 2
        is_sized, is_counted = after[0] == ("size_t", 0), after[0] in (("size_t", 1), ("uint32_t", 1))
        kind = one.base.removeprefix("iso_")
        if one.stars == 0:
            return self._take(name, self._plain(one, name))
        if kind in self.library.handles:
            if one.stars == 1:
                return self._take(name, _handle)
            return self._take(name, _handles, 2) if one.is_const else self._give(self._new_handle(kind))
        if one.base in ("void", "char"):
            if one.stars == 2:
                return self._give(self._bytes_view, 2) if is_counted else self._give(_text_view)
            if one.is_const:
                return self._take(name, _bytes, 2) if is_sized else self._take(name, _text)
            return self._repeat(self._text_out if one.base == "char" else self._bytes_out, 2)
        element = self._element(one.base)
        if one.stars == 2:
            return self._give(self._array_view(element), 2) if is_counted else self._give(_address_out)
        if one.is_const:
            return self._take(name, self._array(element), 2) if is_sized else self._take(name, self._struct(element))
        if is_sized and after[1] == ("size_t", 1):
            return self._repeat(self._array_out(element), 3)
        return self._give(self._one_out(element, one, name))

    def _take(self, name, step, arguments=1):
        self.takes.append(name)
        self.steps.append((True, step))
        return arguments

    def _give(self, step, arguments=1):
        self.steps.append((False, step))
        return arguments

    def _repeat(self, step, arguments):
        self.repeats = True
        return self._give(step, arguments)

    # Steps that take

    def _plain(self, one, name):
        if name in self.numbers:
            kind = "unit" if self.name.endswith("_unit_to_double") else "number"
            return lambda value: (self.family.to_raw(value, kind),)
        if one.base in self.interface.enums:
            return lambda value: (self.interface.enums[one.base].number(value),)
        if one.base in ("float", "double"):
            return lambda value: (float(value),)
        bits = 8 * ctypes.sizeof(self._element(one.base))
        low = -(1 << bits - 1) if one.base.startswith("int") else 0

        def whole(value):
            value = operator.index(value)
            if not low <= value < low + (1 << bits):
                raise ValueError(f"{self.name}: {name} does not hold {value}")
            return (value,)

        return whole

    def _array(self, element):
        is_struct = hasattr(element, "_members_")

        def convert(values):
            array = (element * len(values))()
            for i, value in enumerate(values):
                if is_struct:
                    self.library.filled(array[i], value)
                else:
                    array[i] = value
            return array, len(values)

        return convert

    def _struct(self, element):
        def convert(value):
            if value is None:
                return (None,)
            if not isinstance(value, element):
                value = self.library.filled(element(), value)
            return (ctypes.byref(value),)

        return convert

    # Steps that give

    def _new_handle(self, kind):
        def step(run):
            address = ctypes.c_void_p()
            return (ctypes.byref(address),), lambda: self.library.wrap(kind, address.value)

        return step

    def _one_out(self, element, one, name):
        is_struct, enumeration = hasattr(element, "_members_"), self.interface.enums.get(one.base)

        def step(run):
            made = element()
            if is_struct and element.is_sized:
                made._size = ctypes.sizeof(element)

            def read():
                if is_struct:
                    return made
                if enumeration:
                    return enumeration.text(made.value)
                return self.family.to_float(made.value) if name in self.numbers else made.value

            return (ctypes.byref(made),), read

        return step

    def _array_view(self, element):
        def step(run):
            address, count = ctypes.c_void_p(), ctypes.c_size_t()
            return ((ctypes.byref(address), ctypes.byref(count)),
                    lambda: copied(element, address.value, count.value, self._dtype(element)))

        return step

    def _array_out(self, element):
        is_sized = hasattr(element, "_members_") and element.is_sized

        def step(run):
            array, count = (element * run.room)(), ctypes.c_size_t()
            for i in range(run.room if is_sized else 0):
                array[i]._size = ctypes.sizeof(element)
            run.need = lambda: count.value
            return (array, run.room, ctypes.byref(count)), lambda: owned(array, count.value, self._dtype(element))

        return step

    def _bytes_out(self, run):
        size = ctypes.c_size_t(run.room)
        buffer = ctypes.create_string_buffer(run.room) if run.room else None
        run.need = lambda: size.value
        return (buffer, ctypes.byref(size)), lambda: buffer.raw[:size.value] if buffer else b""

    def _text_out(self, run):
        arguments, read = self._bytes_out(run)
        return arguments, lambda: read().split(b"\0", 1)[0].decode()

    def _bytes_view(self, run):
        address, size = ctypes.c_void_p(), ctypes.c_size_t()
        return ((ctypes.byref(address), ctypes.byref(size)),
                lambda: ctypes.string_at(address.value, size.value) if size.value else b"")


def _handle(value):
    return (None if value is None else value._open(),)


def _handles(values):
    return (ctypes.c_void_p * len(values))(*[one._open() for one in values]), len(values)


def _bytes(value):
    return (None, 0) if value is None else (bytes(value), len(value))


def _text(value):
    return (None if value is None else value.encode(),)


def _text_view(run):
    text = ctypes.c_char_p()
    return (ctypes.byref(text),), lambda: None if text.value is None else text.value.decode()


def _address_out(run):
    address = ctypes.c_void_p()
    return (ctypes.byref(address),), lambda: address.value
