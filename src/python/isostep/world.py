"""Worlds: bodies, shapes, joints and records; steps, states, events and queries."""

# SPDX-License-Identifier: MIT
import ctypes

from .calls import Handle, numpy, owned

_library = None  # set by the package, once it is loaded


def use_library(library):
    global _library
    _library = library
    library.register(World, Snapshot, Tape, Blob)


class Snapshot(Handle):
    """A state of a world, for `World.load`. `World.save(snapshot)` reuses it and allocates nothing once it is warm."""

    _kind = "snapshot"

    def __init__(self, world):
        self._take(_library.call("iso_snapshot_create")(world))

    @property
    def size(self):
        """[bytes] The memory that it holds for itself."""
        return _library.call("iso_snapshot_get_size")(self)


class Blob(Handle):
    """Points of a hull, triangles of a mesh or heights of a field: shared by the worlds that use them, immutable."""

    _kind = "blob"

    @classmethod
    def read(cls, data, home="carried"):
        """Reads a file of `isostep bake`, or one that `write` returned."""
        return _library.call("iso_blob_read")(data, home)

    @classmethod
    def mesh(cls, points, triangles, materials=None, home="carried"):
        """Makes a mesh of points [m] and three indices a triangle, counter-clockwise seen from its outward side."""
        flat = [number for point in points for number in point]
        corners = [index for triangle in triangles for index in triangle]
        given = {"point_count": len(flat) // 3, "triangle_count": len(corners) // 3, "points": flat, "vertices": corners}
        return _library.call("iso_blob_create_mesh")(given, materials, home)

    def write(self):
        return _library.call("iso_blob_write")(self)

    @property
    def name(self):
        """The hash of its content: equal content has one name on every machine."""
        low, high = _library.call("iso_blob_get_name")(self)
        return high << 64 | low


class Tape(Handle):
    """A recording that grows: `World.record`. `end_frame` after the commands and steps of each frame, then `finish`."""

    _kind = "tape"

    def __init__(self):
        self._take(_library.call("iso_tape_create")())

    def end_frame(self):
        _library.call("iso_tape_end_frame")(self)

    def flush(self):
        """Puts all frames so far into `bytes`: written to disk, a crash costs none. Else it costs a second."""
        _library.call("iso_tape_flush")(self)

    def keyframe(self):
        _library.call("iso_tape_keyframe")(self)

    def finish(self):
        """Ends the recording and returns the file's bytes."""
        _library.call("iso_tape_finish")(self)
        return self.bytes

    @property
    def bytes(self):
        """The file so far."""
        return _library.call("iso_tape_bytes")(self)


class Events:
    """Events of the last step, each kind an array of Python's own."""

    NAMES = ("contact_begins", "contact_ends", "contact_points", "contact_hits", "sensor_begins", "sensor_ends",
             "broke_events", "joint_broke_events", "fell_asleep", "woke")

    def __init__(self, world):
        self._world = world

    def __getattr__(self, name):
        if name not in self.NAMES:
            raise AttributeError(f"no events '{name}': {', '.join(self.NAMES)}")
        return self._world.call(name)


class World(Handle):
    """A world of one scalar: "f32", "f64", "q16" or "q32". `settings` are the members of iso_<scalar>_settings.

    Every function of isostep.h that takes a world is `call(name, ...)`; what is used most has a method. Values that are
    no floats of the scalar are rounded to the nearest; Raw(bits) is exact.
    """

    _kind = "world"

    def __init__(self, scalar="q32", **settings):
        prefix = _library.interface.family_of(scalar).prefix
        self._take(_library.call(f"iso_{prefix}_world_create")(settings))
        self._prefix = prefix

    @property
    def scalar(self):
        """ "f32", "f64", "q16" or "q32"."""
        self._open()
        if not hasattr(self, "_prefix"):
            self._prefix = _library.call("iso_world_get_scalar")(self)
        return self._prefix

    @property
    def family(self):
        return _library.interface.families[self.scalar]

    def call(self, name, *values):
        """iso_<scalar>_NAME, iso_<scalar>_world_NAME, iso_world_NAME or iso_NAME of isostep.h: whichever there is, with
        this world first."""
        for full in (f"iso_{self.scalar}_{name}", f"iso_{self.scalar}_world_{name}", f"iso_world_{name}", f"iso_{name}"):
            if _library.has(full):
                return _library.call(full)(self, *values)
        raise AttributeError(f"isostep.h has no function '{name}' of worlds")

    # Time and state

    def step(self):
        """Steps by 1 / hz seconds; returns the report of what it had to mend."""
        return self.call("step")

    @property
    def tick(self):
        return self.call("tick")

    @property
    def hash(self):
        """The hash of the whole state, the same on every machine."""
        return self.call("hash")

    @property
    def counts(self):
        return self.call("get_counts")

    @property
    def settings(self):
        return self.call("get_settings")

    def save(self, into=None):
        """Saves the state, in a new snapshot or into one that was made before."""
        into = into or Snapshot(self)
        self.call("save", into)
        return into

    def load(self, snapshot):
        """Loads a state: the same ids and the same future as the world that saved it."""
        self.call("load", snapshot)

    def write(self):
        """The portable form: bytes that every machine can `read`."""
        return self.call("write")

    def read(self, data):
        self.call("read", data)

    def record(self, scene):
        """A tape that takes all commands and steps from now on."""
        tape = Tape()
        self.call("record", tape, scene)
        return tape

    # What is in it

    def add_shape(self, kind, **fields):
        """Adds a sphere, box, capsule, half_space, cylinder or cone; returns its id."""
        return self.call(f"add_{kind}", fields)

    def add_hull(self, points, radius=0):
        """Adds the convex hull of points [m], and all within `radius` of it."""
        with _library.call(f"iso_{self.scalar}_blob_create_hull")(points, "carried") as blob:
            return self.call("add_hull", {"radius": radius}, blob)

    def add_blob(self, blob):
        """Adds a shape of a Blob."""
        return self.call("add_blob", blob)

    def create_body(self, **definition):
        """Takes members of iso_<scalar>_body_definition; returns the body's id."""
        return self.call("body_create", definition)

    def destroy_body(self, body):
        self.call("body_destroy", body)

    def create_joint(self, kind, **fields):
        """Creates a hinge, slider, ball, fixed, ...: the kinds of isostep.h's iso_<scalar>_create_; returns its id."""
        return self.call(f"create_{kind}", fields)

    def destroy_joint(self, joint):
        self.call("joint_destroy", joint)

    def axis_drive(self, joint, axis):
        """The axis_drive on one axis of a six-axis joint, for get_record and set_record; 0 where there is none."""
        return self.call("joint_get_axis_drive", joint, axis)

    def add_record(self, kind, **fields):
        """Adds a record that acts from step to step: a thruster, spring, zone, wheel, ...; returns its id."""
        return self.call(f"add_{kind}", fields)

    def get_record(self, kind, record):
        return self.call(f"get_{kind}", record)

    def set_record(self, kind, record, **changes):
        """Sets these members of it; the others stay, bit for bit."""
        self.call(f"set_{kind}", record, self.get_record(kind, record).set(**changes))

    def get_input(self, kind, record):
        """The game's input to a record, which holds until the next one: a breakable, character or vehicle."""
        return self.call(f"get_{kind}_input", record)

    def set_input(self, kind, record, **changes):
        """Sets these members of its input; the others stay."""
        self.call(f"set_{kind}_input", record, self.get_input(kind, record).set(**changes))

    def get_state(self, kind, record):
        """The state of a record after the last step: a character, joint_load, vehicle or wheel."""
        return self.call(f"get_{kind}_state", record)

    def remove_record(self, kind, record):
        self.call(f"remove_{kind}", record)

    # Bodies

    def bodies(self):
        """The ids of all bodies, ascending by slot."""
        return self.call("bodies")

    def state(self, body):
        """The pose, velocities, user data, type, and whether it is awake."""
        return self.call("body_get_state", body)

    def properties(self, body):
        """The properties that only commands change: mass, material, filter, ..."""
        return self.call("body_get_properties", body)

    def states(self, bodies=None):
        """The states of all bodies, or of these: an array of iso_<scalar>_body_state over memory of Python's own, with
        the numbers' bits. `floats` makes numbers of them."""
        ids = self.bodies() if bodies is None else bodies
        element = _library.interface.structs[f"iso_{self.scalar}_body_state"]
        given = (ctypes.c_uint64 * len(ids))(*ids)
        one = element()
        one.set(size=ctypes.sizeof(element))
        array = (element * len(ids)).from_buffer(bytearray(bytes(one) * len(ids)))
        status = _library.call(f"iso_{self.scalar}_bodies_get_states").function(self._open(), given, len(ids), array)
        if status:
            raise _library.error(status, self)
        return owned(array, len(ids), _library.interface.dtype(element) if numpy is not None else None)

    def floats(self, values, unit=False):
        """An array of vectors with the numbers' bits, as array (n, 3) or (n, 4) of float64; `unit`: of directions and
        quaternions. float and double are not copied."""
        from numpy.lib.recfunctions import structured_to_unstructured

        family = self.family
        raw = structured_to_unstructured(values) if values.dtype.names else values
        return family.to_float(raw, "unit" if unit else "number")

    def poses(self, alpha=1.0):
        """The poses for drawing: body, position [m] and orientation of all moving bodies between the last two steps, in
        float."""
        return self.call("poses", alpha)

    @property
    def events(self):
        self._open()
        return Events(self)

    def set_pose(self, body, position, orientation=(0, 0, 0, 1)):
        self.call("body_set_pose", body, {"position": position, "orientation": orientation})

    def set_velocity(self, body, linear, angular=(0, 0, 0)):
        self.call("body_set_velocity", body, linear, angular)

    def apply_force(self, body, force, torque=None):
        self.call("body_apply_force", body, force, torque)

    def apply_impulse(self, body, impulse, angular_impulse=None):
        self.call("body_apply_impulse", body, impulse, angular_impulse)

    # Queries: `filter` has members of iso_query_filter

    def cast_ray(self, origin, translation, **filter):
        """The first hit, or None."""
        return _found(self.call("cast_ray", {"origin": origin, "translation": translation, "filter": filter}))

    def cast_ray_all(self, origin, translation, **filter):
        """All hits in order, as an array."""
        return self.call("cast_ray_all", {"origin": origin, "translation": translation, "filter": filter})

    def closest_point(self, point, max_distance, **filter):
        """The closest point of the nearest body, or None."""
        return _found(self.call("closest_point", {"point": point, "max_distance": max_distance, "filter": filter}))


def _found(result):
    hit, found = result
    return hit if found else None
