"""Integers of any type, games that raise, and what a recording keeps of a crash."""

# SPDX-License-Identifier: MIT
import struct
import unittest

import numpy

import isostep
import support

INTEGERS = [int] + [getattr(numpy, name) for name in ("int8", "int16", "int32", "int64", "uint8", "uint16", "uint32",
                                                       "uint64", "intc", "longlong")]


class Integers(unittest.TestCase):
    def test_of_numpy_are_enumerations_flags_counts_and_ids(self):
        dynamic = isostep.library.interface.enums["iso_body_type"].by_name["dynamic"]
        for integer in INTEGERS:
            world = isostep.World("q32", hz=integer(60), substeps=integer(4))
            box = world.add_shape("box", half_extents=(1, 1, 1))
            if box <= numpy.iinfo(integer if integer is not int else "i8").max:
                box = integer(box)
            body = world.create_body(type=integer(dynamic), shape=box, user_data=integer(7),
                                     filter={"mask": integer(3)})
            self.assertEqual((world.state(body).type, world.state(body).user_data), ("dynamic", 7), integer)
            self.assertEqual(world.call("create_hinge", {"a": numpy.uint64(body)}) >> 32 > 0, True)
            world.call("use_simd", integer(0))
            self.assertEqual(world.settings.hz, 60)
        flags = next(one for one in isostep.library.interface.enums.values() if one.flags)
        names = list(flags.by_name)[:2]
        both = flags.by_name[names[0]] | flags.by_name[names[1]]
        for given in (names, [flags.by_name[name] for name in names], numpy.array([both, both]), [both, names[0]],
                      numpy.uint8(both), numpy.array(both), tuple(map(numpy.int64, [both]))):
            self.assertEqual(flags.number(given), both, given)

    def test_what_is_no_integer_or_beyond_one_is_refused(self):
        world = isostep.World("q32")
        box = world.add_shape("box", half_extents=(1, 1, 1))
        for wrong in (-1, 1 << 32, (1 << 32) + 1, numpy.int8(-1), 1.0, numpy.float64(1), None, ["dynamic"], b"dynamic"):
            with self.assertRaises(ValueError, msg=repr(wrong)):
                world.create_body(type=wrong, shape=box)
        for wrong in (1.5, numpy.float32(1), "1", None):
            with self.assertRaises(ValueError, msg=repr(wrong)):
                world.create_body(shape=box, user_data=wrong)
        with self.assertRaises(isostep.Error):
            world.create_body(type=numpy.uint8(9), shape=box)
        self.assertEqual(len(world.bodies()), 0)


class Clumsy(isostep.Game):
    """A game with a bug: what `raises` says of a call raises there, after half of its work or before all of it."""

    def __init__(self, scalar, raises):
        super().__init__(isostep.World(scalar), block_size=8)
        box = self.world.add_shape("box", half_extents=(0.5, 0.5, 0.5))
        self.crates = [self.world.create_body(type="dynamic", shape=box, position=(3 * i, 0, 0)) for i in range(3)]
        self.raises, self.calls, self.raised, self.hashes = raises, {}, [], {}

    def _may_raise(self, what):
        self.calls[what] = self.calls.get(what, 0) + 1
        if self.raises(what, self.calls[what]):
            self.raised.append(what)
            raise KeyError(what)

    def step(self, inputs):
        self._may_raise("before")
        for crate, one in zip(self.crates, inputs):
            self.world.apply_impulse(crate, (one.bytes[0] / 16, 0, 0))
        struct.pack_into("<q", self.state, 0, struct.unpack_from("<q", self.state)[0] + 1)
        self._may_raise("half")
        self.world.step()
        self._may_raise("after")

    def rolled_back(self, frame):
        self._may_raise("rolled_back")

    def restarted(self, frame):
        self._may_raise("restarted")

    def confirmed(self, frame, hash):
        self.hashes[frame] = hash
        self._may_raise("confirmed")


def play(raises, mode, joins_at=0, seconds=8, scalar="q32"):
    """A match of a host and one or two others whose games raise as `raises` says, each at its own time. Returns the
    games, the recordings of the host, and the events."""
    config = dict(mode=mode, players=3, hz=60, name="clumsy 1", input_text="push", input_least=1, input_cap=1,
                  neutral=b"\0", history=200)
    games = [Clumsy(scalar, lambda what, n, who=who: raises(who, what, n)) for who in range(3)]
    peers = [isostep.Session(games[0], host=True, local_players=1, seed=0x123456789, **config),
             isostep.Session(games[1], **config)]
    for kind in ("match", "world"):
        peers[0].call("record", kind, None)
    network = isostep.Network(seed=1)
    network.add_client("latency=40,jitter=10,loss=2")
    kinds = [set(), set(), set()]
    for now in range(0, seconds * 1_000_000, 4000):
        if now == 400_000:
            peers[0].call("start", now)
        if now == joins_at and joins_at:
            peers.append(isostep.Session(games[2], **config))
            network.add_client("latency=20")
        network.call("advance_to", now)
        for who, peer in enumerate(peers):
            try:
                player = peer.call("local_player")
                if peer.phase == "playing" and player >= 0:
                    peer.add_input(player, bytes([peer.current // (9 + who) % 7]))
                network.call("deliver", who, peer, now)
                peer.drive(now)
            except KeyError:
                pass
            network.call("dispatch", who, peer, now)
            kinds[who] |= {event.kind for event in peer.events()}
    files = [peers[0].call("recorded", kind) for kind in ("match", "world")]
    return games, peers, kinds, files


class Exceptions(unittest.TestCase):
    def check(self, raises, mode, joins_at=0):
        games, peers, kinds, files = play(raises, mode, joins_at)
        what = (mode, [game.raised[:3] for game in games])
        for who, peer in enumerate(peers):
            self.assertGreater(peer.confirmed, 300, what)
            self.assertEqual(peer.phase, "playing", what)
            common = set(games[0].hashes) & set(games[who].hashes)
            self.assertGreater(len(common), 150, what)
            self.assertEqual([n for n in common if games[0].hashes[n] != games[who].hashes[n]], [], what)
            self.assertFalse(kinds[who] & {"desync", "outvoted", "undecided", "bad_snapshot", "refused"}, what)
            stepping = set(games[who].raised) - {"confirmed"}
            self.assertEqual("misuse" in kinds[who], bool(stepping), (what, who, kinds[who]))
        self.assertEqual(isostep.verify(files[1]).outcome, "verified", what)
        self.assertEqual(len(isostep.Replay(files[1])), len(games[0].hashes), what)
        return games

    def test_one_of_each_callback_is_told_and_the_match_goes_on(self):
        for mode in ("lockstep", "rollback"):
            for where in ("before", "half", "after", "rolled_back", "confirmed"):
                for culprit in (0, 1):
                    at = 3 if where == "rolled_back" else 40
                    games = self.check(lambda who, what, n: who == culprit and what == where and n == at, mode)
                    if mode == "rollback" or where != "rolled_back":
                        self.assertEqual(games[culprit].raised, [where])

    def test_the_first_frame_and_many_in_a_row(self):
        for mode in ("lockstep", "rollback"):
            for where in ("before", "half", "after"):
                self.check(lambda who, what, n: what == where and n in (1, 2, 3, 50, 51, 52, 53, 90 + who), mode)

    def test_now_and_then_all_over_while_somebody_joins(self):
        for seed in range(6):
            mode = ("lockstep", "rollback")[seed % 2]

            def raises(who, what, n):
                return (n * 2654435761 + who * 40503 + seed * 97 + len(what) * 7919 >> 5) % 41 == 0

            games = self.check(raises, mode, joins_at=4_600_000)
            self.assertGreater(sum(len(game.raised) for game in games), 20)


class Recordings(unittest.TestCase):
    def test_a_flushed_tape_loses_nothing(self):
        world, _ = support.crate(isostep, "q32")
        tape = world.record("flushed")
        for frame in range(1, 100):
            world.step()
            tape.end_frame()
            if frame % 10 == 0:
                tape.flush()
            torn = tape.bytes + bytes(4096)  # as a power failure leaves it
            replay = isostep.Replay(torn)
            self.assertEqual(replay.info.file, "truncated")
            self.assertEqual(len(replay), frame // 10 * 10)
            self.assertEqual(isostep.verify(torn).outcome, "truncated")

    def test_a_session_is_recorded_as_it_goes(self):
        game = Clumsy("q32", lambda what, n: False)
        session = isostep.Session(game, mode="rollback", host=True, local_players=1, players=1, seed=3, name="flushed")
        session.call("record", "world", "flushed")
        file = b""
        for now in range(0, 3_000_000, 10_000):
            if now == 0:
                session.call("start", now)
            session.drive(now)
            if now % 70_000 == 0:
                file += session.flush_recording("world")
        file += session.flush_recording("world")
        self.assertEqual(len(isostep.Replay(file)), len(game.hashes))
        self.assertEqual(isostep.verify(file).outcome, "truncated")
        whole = session.call("recorded", "world")
        self.assertEqual(file + session.flush_recording("world"), whole)
        self.assertEqual(isostep.verify(whole).outcome, "verified")


if __name__ == "__main__":
    unittest.main()
