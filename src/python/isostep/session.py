"""Sessions: which frames a game steps, with whose inputs, and when. No sockets, no clock, no callbacks: bytes and the
time go in, bytes and requests come out."""

# SPDX-License-Identifier: MIT
import ctypes
from dataclasses import dataclass

from .calls import Handle

_library = None


def use_library(library):
    global _library
    _library = library
    library.register(Session, Network)


@dataclass
class Input:
    """One player's input for one frame: its bytes, and "confirmed", "predicted" or "disconnected"."""

    bytes: bytes
    status: str


class Game:
    """The state that a session saves, rolls back, hashes and sends to late joiners: a world, a block of bytes, or both.

    `step(inputs)` is called for every frame, again for those that are rolled back; what it does depends on the world,
    the block and the inputs alone. `state` is the block as a memoryview of bytes, which struct.pack_into writes to.
    """

    def __init__(self, world=None, block_size=0):
        self.world = world
        self._block = (ctypes.c_uint8 * block_size)() if block_size else None
        self.state = memoryview(self._block).cast("B") if block_size else memoryview(b"")

    def step(self, inputs):
        """Steps the next frame: `inputs` has an Input for each player."""
        raise NotImplementedError("a game overrides step")

    def rolled_back(self, frame):
        """Hears that the state is again that before `frame`."""

    def restarted(self, frame):
        """Hears that the state is one that arrived from elsewhere, before `frame`."""

    def confirmed(self, frame, hash):
        """Hears that `frame` is final; `hash` is that of the state after it."""

    def _in_c(self):
        made = _library.new("game")
        if self.world is not None:
            made.set(world=self.world._open())
        if self._block is not None:
            made.set(block=ctypes.addressof(self._block), block_size=len(self._block))
        return made


class Session(Handle):
    """`config` has members of iso_session_config, after the defaults or those of `preset` (a genre and a number of
    players). `file`: the recording that a replay plays, or the match that a host goes on with."""

    _kind = "session"

    def __init__(self, game, preset=None, file=None, **config):
        given = (_library.new("session_config") if preset is None else
                 _library.call("iso_session_config_preset")(*preset))
        for name in ("neutral", "credential"):
            if name in config:
                config[name + "_size"] = len(config[name])
        given.set(**config)
        problem = _library.call("iso_session_config_problem")(given)
        if problem:
            raise ValueError(f"session: {problem}")
        c_game, address = game._in_c(), ctypes.c_void_p()
        status = _library.raw("iso_session_create")(ctypes.byref(given), ctypes.byref(c_game), file,
                                                    ctypes.c_size_t(len(file or b"")), ctypes.byref(address))
        if status:
            raise _library.error(status, None)
        Handle.__init__(self, _library, address.value)
        self._game = game  # lives as long as the session

    @property
    def game(self):
        self._open()
        return self._game

    def close(self):
        super().close()
        self._game = None

    def call(self, name, *values):
        """Calls iso_session_NAME of isostep.h, with this session first."""
        self._open()
        return _library.call(f"iso_session_{name}")(self, *values)

    def add_input(self, player, data):
        """Gives the next frame's input; until that is stepped a later one replaces it."""
        self.call("add_local_input", player, data)

    def drive(self, now):
        """Plays a turn at `now` [us]: steps the game as often as it is due; returns the number of steps. An
        error that the game raises ends the turn. The next one tells "misuse", steps again what was missed, from the
        newest final state, and the match goes on."""
        self.call("advance", now)
        steps = 0
        while True:
            request = self.call("next")
            if request.kind == "nothing":
                return steps
            if request.kind == "step":
                self.game.step(self.inputs())
                steps += 1
            elif request.kind == "rolled_back":
                self.game.rolled_back(request.frame)
            elif request.kind == "restarted":
                self.game.restarted(request.frame)
            else:
                self.game.confirmed(request.frame, request.hash)

    def inputs(self):
        """The inputs of the step that was asked for, by player."""
        address, players = self.call("inputs")
        return [_input_of(one) for one in (_c_input() * players).from_address(address)] if address else []

    def input(self, frame, player):
        """The input of a player in a frame that is at most `kept` frames old."""
        return _input_of(self.call("input", frame, player))

    def events(self):
        """The events since the last call, in order: `kind`, `player`, `frame`, ..."""
        while True:
            event = self.call("poll_event")
            if event.kind == "none":
                return
            yield event

    def sends(self, now):
        """The messages to send as (peer, "datagram" or "reliable", bytes, whether the connection ends after it)."""
        while True:
            out, address = self.call("poll_send", now)
            if not address and not out.close:
                return
            yield out.peer, out.channel, ctypes.string_at(address, out.length) if out.length else b"", bool(out.close)

    def go_on(self, now):
        """Goes on with those who are here, at this machine. It is for sessions with `migration` whose match stands for
        lack of a majority, or whose host is lost. The caller knows that the others play nowhere else: nothing else
        keeps one match from becoming two. Error: the match goes on without, or this machine has no part in it."""
        self.call("go_on", now)

    def flush_recording(self, kind):
        """The new bytes of a recording's file, "match" or "world", with all final frames so far: appended to a file
        it survives a crash. `call("record", kind, None)` begins one and `call("recorded", kind)` ends it: the whole."""
        return self.call("flush_recording", kind)

    @property
    def confirmed(self):
        """The last frame whose state is final; -1: none."""
        return self.call("confirmed")

    @property
    def current(self):
        """The next frame to be stepped."""
        return self.call("current")

    @property
    def phase(self):
        return self.call("phase")

    @property
    def stats(self):
        return self.call("get_stats")


class Network(Handle):
    """A network in virtual time, for tests: endpoint 0 is the host, `add_client` makes further ones."""

    _kind = "network"

    def __init__(self, seed):
        self._take(_library.call("iso_network_create")(seed))

    def call(self, name, *values):
        """Calls iso_network_NAME of isostep.h, with this network first."""
        self._open()
        return _library.call(f"iso_network_{name}")(self, *values)

    def add_client(self, profile="wifi"):
        """Adds the endpoint of a client whose line is like `profile`: "mobile", "latency=80,jitter=20,loss=5". It is
        connected to the host."""
        endpoint = self.call("add_client", profile)
        self.call("connect", endpoint, 0)
        return endpoint

    def drive(self, sessions, now):
        """Plays a turn of the game's loop for the sessions of all endpoints, in order."""
        self.call("advance_to", now)
        for endpoint, session in enumerate(sessions):
            self.call("deliver", endpoint, session, now)
            session.drive(now)
            self.call("dispatch", endpoint, session, now)


def _c_input():
    return _library.interface.structs["iso_input"]


def _input_of(one):
    status = _library.interface.enums["iso_input_status"].text(one.raw("status"))
    return Input(bytes(one.raw("bytes"))[:one.raw("size")], status)
