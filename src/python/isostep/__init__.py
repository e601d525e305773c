"""isostep in Python: deterministic 3D physics for lockstep and rollback games, by the shared library's C interface.

Replays are opened, played, verified and compared; worlds of every scalar stepped and changed; sessions driven. numpy is
optional: with it arrays are structured numpy arrays, without it ctypes arrays of the same members. See README.md.
"""

# SPDX-License-Identifier: MIT
from . import replay as _replay, session as _session, world as _world
from .diff import diff, diff_bodies, table
from .errors import Closed, Corrupt, Error, NoScalar, Refused, WrongScalar
from .library import Library
from .replay import Frame, Replay, verify
from .session import Game, Network, Session
from .structs import Raw, Struct
from .world import Blob, Events, Snapshot, Tape, World

library = Library()
for _module in (_world, _replay, _session):
    _module.use_library(library)

__version__ = library.call("iso_version")()
abi_version = library.interface.abi
#: Two builds of one behaviour version promise each other's hashes.
behaviour_version = library.call("iso_behaviour_version")()
SCALARS = tuple(prefix for prefix in library.interface.families
                if library.call("iso_has_scalar")(prefix))


def selfcheck():
    """Replays the library's own recordings in every scalar and with every set of lanes: `sound`, `text`."""
    return library.call("iso_selfcheck")()


__all__ = ["Blob", "Closed", "Corrupt", "Error", "Events", "Frame", "Game", "Library", "Network", "NoScalar", "Raw",
           "Refused", "Replay", "SCALARS", "Session", "Snapshot", "Struct", "Tape", "World", "WrongScalar",
           "abi_version", "behaviour_version", "diff", "diff_bodies", "library", "selfcheck", "table", "verify"]
