"""Replays: frames played one by one, verified, compared."""

# SPDX-License-Identifier: MIT
import os

from .calls import Handle
from .errors import Error

_library = None


def use_library(library):
    global _library
    _library = library
    library.register(Replay)


def _bytes_of(source):
    """The bytes of a path, or of the file itself."""
    if isinstance(source, (bytes, bytearray, memoryview)):
        return bytes(source)
    with open(os.fspath(source), "rb") as file:
        return file.read()


def verify(source, simd="best", most_frames=None):
    """Plays the file and compares every hash, like `isostep verify`. `outcome` of the result is "verified",
    "diverged", "incompatible", "truncated" or "corrupt", `text` the sentence."""
    most = (1 << 64) - 1 if most_frames is None else most_frames
    return _library.call("iso_replay_verify")(_bytes_of(source), simd, most)


class Frame:
    """One frame while a replay plays. `world` is the replay's own and goes on with it: what is kept is copied."""

    def __init__(self, world, number, recorded):
        self.world, self.number, self.recorded = world, number, recorded
        self.hash = world.hash

    @property
    def agrees(self):
        """True if the frame came out as it was recorded."""
        return self.hash == self.recorded

    def states(self):
        """The pose and velocity of every body: World.states."""
        return self.world.states()

    @property
    def events(self):
        return self.world.events


class Replay(Handle):
    """A recording, by its path or its bytes. `for frame in replay` plays it from the start."""

    _kind = "replay"
    SPACING = 60  # [frames] between states that `at` keeps, at first
    STATES, BYTES = 128, 256 << 20  # that it keeps at most, the start included, and what they may take

    def __init__(self, source):
        self._source = source
        self._take(_library.call("iso_replay_open")(_bytes_of(source)))
        self._player, self._position, self._kept, self._spacing = None, 0, [], self.SPACING

    def close(self):
        """Closes the replay and the world of `at`, which is its own."""
        super().close()
        for one in [self._player, *self._kept]:
            if one is not None:
                one.close()
        self._player, self._kept = None, []

    @property
    def info(self):
        """What the file says: scalar, scene, frames, hz, behaviour, ..."""
        return _library.call("iso_replay_get_info")(self)

    def __len__(self):
        return self.info.frames

    def start(self):
        """A new world in the state before the first frame."""
        return _library.call("iso_replay_create_world")(self)

    def frame(self, number):
        """The commands of a frame, for World.call("apply", commands), and the hash that was recorded after it."""
        return _library.call("iso_replay_get_frame")(self, number)

    def __iter__(self):
        with self.start() as world:
            for number in range(len(self)):
                commands, recorded = self.frame(number)
                world.call("apply", commands)
                yield Frame(world, number, recorded)

    def at(self, frames):
        """The replay's own world after so many frames; 0 is the start. Going back costs at most SPACING frames at
        first. When there is room for no more states every other one goes, and the spacing doubles."""
        if not 0 <= frames <= len(self):
            raise IndexError(f"the replay has {len(self)} frames, {frames} were asked for")
        if self._player is None or not self._player.is_open:
            self._player, self._position = self.start(), 0
            self._kept = self._kept or [self._player.save()]
        key = min(frames // self._spacing, len(self._kept) - 1)
        if frames < self._position or key * self._spacing > self._position:
            self._go_to(key)
        while self._position < frames:
            try:
                self._player.call("apply", self.frame(self._position)[0])
            except Error:  # commands before the bad one were applied
                self._go_to(min(self._position // self._spacing, len(self._kept) - 1))
                raise
            self._position += 1
            if self._position == len(self._kept) * self._spacing:
                self._kept.append(self._player.save())
                self._thin()
        return self._player

    def _go_to(self, key):
        self._player.load(self._kept[key])
        self._position = key * self._spacing

    def _thin(self):
        while len(self._kept) > 1 and (len(self._kept) > self.STATES or
                                       sum(state.size for state in self._kept) > self.BYTES):
            for state in self._kept[1::2]:
                state.close()
            self._kept = self._kept[::2]
            self._spacing *= 2

    def verify(self, **options):
        """Verifies the file by `verify`."""
        self._open()
        return verify(self._source, **options)
