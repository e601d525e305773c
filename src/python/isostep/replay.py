"""Replays: frames played one by one, verified, compared."""

# SPDX-License-Identifier: MIT
import os

from .calls import Handle

_library = None


def use_library(library):
    global _library
    _library = library
    library.register(Replay)


def _bytes_of(source):
    """Of a path, or of the file's bytes."""
    if isinstance(source, (bytes, bytearray, memoryview)):
        return bytes(source)
    with open(os.fspath(source), "rb") as file:
        return file.read()


def verify(source, simd="best", most_frames=None):
    """What `isostep verify` does: plays the file and compares every hash. `outcome` of the result is "verified",
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
        """Whether the frame came out as it was recorded."""
        return self.hash == self.recorded

    def states(self):
        """Pose and velocity of every body: World.states."""
        return self.world.states()

    @property
    def events(self):
        return self.world.events


class Replay(Handle):
    """A recording, by its path or its bytes. `for frame in replay` plays it from the start."""

    _kind = "replay"
    SPACING = 60  # [frames] between states that `at` keeps

    def __init__(self, source):
        self._source = source
        self._take(_library.call("iso_replay_open")(_bytes_of(source)))
        self._player, self._position, self._kept = None, 0, []

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
        """The replay's own world after so many frames; 0 is the start. Going back costs at most SPACING frames."""
        if not 0 <= frames <= len(self):
            raise IndexError(f"the replay has {len(self)} frames, {frames} were asked for")
        if self._player is None:
            self._player = self.start()
            self._kept = [self._player.save()]
        if frames < self._position or frames // self.SPACING > self._position // self.SPACING:
            key = min(frames // self.SPACING, len(self._kept) - 1)
            if key * self.SPACING > self._position or frames < self._position:
                self._player.load(self._kept[key])
                self._position = key * self.SPACING
        while self._position < frames:
            self._player.call("apply", self.frame(self._position)[0])
            self._position += 1
            if self._position == len(self._kept) * self.SPACING:
                self._kept.append(self._player.save())
        return self._player

    def verify(self, **options):
        """The file, by `verify`."""
        return verify(self._source, **options)
