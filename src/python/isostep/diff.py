"""Two replays compared, as tables: where they part, and how far. Needs numpy."""

# SPDX-License-Identifier: MIT
from .replay import Replay

_MOTION = (("pose", "position", False), ("pose", "orientation", True), ("velocity", None, False),
           ("angular_velocity", None, False))


def _opened(source):
    return source if isinstance(source, Replay) else Replay(source)


def _common(a, b):
    """The places in the states of two worlds of the bodies that both have: ids count alike where worlds were built
    alike, in whatever scalar."""
    import numpy

    _, of_a, of_b = numpy.intersect1d(a.bodies(), b.bodies(), assume_unique=True, return_indices=True)
    return of_a, of_b


def _vectors(world, states, name, part, unit):
    return world.floats(states[name][part] if part else states[name], unit)


def _row(number, a, b):
    import numpy

    states_a, states_b = a.states(), b.states()
    of_a, of_b = _common(a, b)
    apart, moved = numpy.zeros(len(of_a), bool), {}
    for name, part, unit in _MOTION:
        gap = _vectors(a, states_a, name, part, unit)[of_a] - _vectors(b, states_b, name, part, unit)[of_b]
        moved[part or name] = numpy.sqrt((gap.astype("f8")**2).sum(axis=1))
        apart |= (gap != 0).any(axis=1)
    distance, speed = moved["position"], moved["velocity"]
    worst = int(distance.argmax()) if len(distance) else -1
    return (number, a.hash, b.hash, a.scalar == b.scalar and a.hash == b.hash, int(apart.sum()),
            len(a.bodies()) + len(b.bodies()) - 2 * len(of_a), distance.max(initial=0), speed.max(initial=0),
            a.bodies()[of_a[worst]] if worst >= 0 else 0)


def diff(a, b):
    """One row for each frame that both replays have, played here, of the same scalar or not:

    frame, hash_a, hash_b, equal; differ: bodies of both whose pose or velocity differs; alone: bodies that one has;
    distance [m] and speed [m/s]: the largest difference of position and of velocity; body: the one furthest apart.
    """
    import numpy

    a, b = _opened(a), _opened(b)
    rows = [_row(frame.number, frame.world, other.world) for frame, other in zip(a, b)]
    return numpy.array(rows, dtype=[("frame", "u8"), ("hash_a", "u8"), ("hash_b", "u8"), ("equal", "?"),
                                    ("differ", "u4"), ("alone", "u4"), ("distance", "f8"), ("speed", "f8"),
                                    ("body", "u8")])


def diff_bodies(a, b, frames):
    """The differences of bodies after so many frames: body, field, its value in a and in b."""
    import numpy

    a, b = _opened(a), _opened(b)
    world_a, world_b = a.at(frames), b.at(frames)
    ids, (of_a, of_b) = world_a.bodies(), _common(world_a, world_b)
    states_a, states_b, rows = world_a.states(), world_b.states(), []
    for name, part, unit in _MOTION:
        values_a = _vectors(world_a, states_a, name, part, unit)[of_a]
        values_b = _vectors(world_b, states_b, name, part, unit)[of_b]
        for i, axis in zip(*numpy.nonzero(values_a != values_b)):
            rows.append((ids[of_a[i]], f"{part or name}.{'xyzw'[axis]}", values_a[i, axis], values_b[i, axis]))
    rows.sort(key=lambda row: int(row[0]) & 0xffffffff)
    return numpy.array(rows, dtype=[("body", "u8"), ("field", "U24"), ("a", "f8"), ("b", "f8")])


def table(rows):
    """An array of diff() as text, a row a line: hashes in hexadecimal, differences in three digits."""
    lines = ["  ".join(rows.dtype.names)]
    for row in rows:
        cells = []
        for name in rows.dtype.names:
            value = row[name]
            cells.append(f"{int(value):016x}" if name.startswith("hash") else f"{value:.3g}" if value.dtype.kind == "f"
                         else str(value))
        lines.append("  ".join(cells))
    widths = [max(len(line.split("  ")[i]) for line in lines) for i in range(len(rows.dtype.names))]
    return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(line.split("  "), widths)) for line in lines)
