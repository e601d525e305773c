"""What callers get wrong: objects that were closed, arrays kept for long, exceptions in a game, numpy's integers."""

# SPDX-License-Identifier: MIT
import inspect
import struct
import sys
import unittest

import numpy

import isostep
import support

CLOSING = {"close", "is_open"}


def objects():
    """One of each kind of object, after its close; all of what they depend on is open."""
    world, _ = support.crate(isostep, "q32")
    tape = world.record("closed")
    world.step()
    tape.end_frame()
    data = tape.finish()
    game = isostep.Game(support.crate(isostep, "q16")[0], block_size=8)
    config = dict(mode="lockstep", host=True, local_players=1, players=1, seed=3, name="closed")
    made = [isostep.World(scalar) for scalar in isostep.SCALARS]
    made += [world.save(), tape, isostep.Replay(data), isostep.Session(game, **config), isostep.Network(1),
             isostep.Blob.mesh([(0, 0, 0), (0, 0, 1), (1, 0, 0)], [(0, 1, 2)])]
    for one in made:
        one.close()
    return made


class ClosedObjects(unittest.TestCase):
    def assert_closed(self, use, what):
        with self.assertRaises(isostep.Closed, msg=what) as caught:
            result = use()
            if inspect.isgenerator(result):
                list(result)
        self.assertIn("closed", str(caught.exception), what)

    def test_every_attribute_and_method_raises(self):
        tried = 0
        for one in objects():
            for name in dir(type(one)):
                if name.startswith("_") or name in CLOSING or name.isupper():
                    continue
                member = inspect.getattr_static(type(one), name)
                if isinstance(member, (classmethod, staticmethod)):
                    continue
                what = f"{type(one).__name__}.{name}"
                tried += 1
                if isinstance(member, property):
                    self.assert_closed(lambda: getattr(one, name), what)
                    continue
                wanted = [one for one in inspect.signature(member).parameters.values()
                          if one.default is one.empty and one.kind is one.POSITIONAL_OR_KEYWORD][1:]
                values = ["step" if name == "call" else "box" if one.name == "kind" else 0 for one in wanted]
                self.assert_closed(lambda: getattr(one, name)(*values), what)
        self.assertGreater(tried, 100)

    def test_every_function_of_the_interface_raises(self):
        closed, tried = {one._kind: one for one in objects()}, 0
        worlds = {one.scalar: one for one in [isostep.World(scalar) for scalar in isostep.SCALARS]}
        for one in worlds.values():
            one.close()
        for name, described in isostep.library._described.items():
            first = described["arguments"][0] if described["arguments"] else None
            if first is None or first["type"].count("*") != 1:
                continue
            kind = first["type"].replace("const ", "").replace("*", "").removeprefix("iso_")
            if kind not in closed or name == "iso_world_use_threads":  # which is not wrapped
                continue
            call = isostep.library.call(name)
            handle = worlds.get(described["family"], closed[kind]) if kind == "world" else closed[kind]
            self.assert_closed(lambda: call(handle, *[0] * (len(call.takes) - 1)), name)
            tried += 1
        self.assertGreater(tried, 500)

    def test_what_is_made_of_a_closed_one_raises(self):
        world, _ = support.crate(isostep, "q32")
        snapshot, other = world.save(), isostep.World("q32")
        blob = isostep.Blob.mesh([(0, 0, 0), (0, 0, 1), (1, 0, 0)], [(0, 1, 2)])
        events = world.events
        for one in (world, snapshot, blob):
            one.close()
        config = dict(mode="lockstep", host=True, local_players=1, players=1, seed=3, name="closed")
        for use in (lambda: events.woke, lambda: isostep.Snapshot(world), lambda: other.load(snapshot),
                    lambda: other.save(snapshot), lambda: other.add_blob(blob), lambda: world.states([1]),
                    lambda: isostep.Session(isostep.Game(world, block_size=8), **config)):
            self.assert_closed(use, inspect.getsource(use))

    def test_a_replay_closes_with_its_world(self):
        world, _ = support.crate(isostep, "q32")
        tape = world.record("closed")
        world.step()
        tape.end_frame()
        replay = isostep.Replay(tape.finish())
        frames = list(replay)
        self.assert_closed(frames[0].states, "the world of an iteration that is over")
        replay.at(1).close()
        self.assertEqual(replay.at(1).hash, world.hash)
        shown = replay.at(1)
        replay.close()
        self.assert_closed(lambda: shown.hash, "the replay's own world")

    def test_a_session_whose_world_was_closed_says_so(self):
        game = isostep.Game(isostep.World("q32"), block_size=8)
        session = isostep.Session(game, mode="lockstep", host=True, local_players=1, players=1, seed=3, name="closed")
        game.world.close()
        with self.assertRaises(isostep.Closed):
            session.drive(0)
        session.close()


# Whoever reads an array again reads what was there, whatever has become of the world: in a process of its own.
ARRAYS = """
import gc, sys
import numpy, isostep
how, scalar = sys.argv[1:]
world = isostep.World(scalar)
ball = world.add_shape("sphere", radius=0.5)
world.create_body(shape=world.add_shape("half_space", normal=(0, 1, 0)))
bodies = [world.create_body(type="dynamic", shape=ball, position=(2 * (i % 50), 0.45, 2 * (i // 50)))
          for i in range(2000)]
world.call("keep_log", 1)
world.call("trace", 1)
kept = []
for _ in range(3):
    world.apply_impulse(bodies[0], (1, 0, 0))
    world.step()
    kept += [world.poses(), world.states(), world.bodies(), world.call("stage_hashes")]
    kept += [getattr(world.events, name) for name in world.events.NAMES]
seen = [one.tobytes() for one in kept]
assert sum(len(one) > 0 for one in seen) > 10
if how == "closed":
    world.close()
elif how == "forgotten":
    del world
elif how == "changed":  # its arrays grow and move
    for i in range(8000):
        world.create_body(type="dynamic", shape=ball, position=(2 * (i % 50), 9, 2 * (i // 50)))
    for _ in range(3):
        world.step()
        world.poses(), [getattr(world.events, name) for name in world.events.NAMES]
gc.collect()
others = [isostep.World(scalar) for _ in range(50)]  # take what was given back
junk = [bytearray(b"\\xee" * 80000) for _ in range(200)]
assert [one.tobytes() for one in kept] == seen
print("same")
"""


class Arrays(unittest.TestCase):
    def test_they_stay_as_they_were(self):
        for scalar in isostep.SCALARS:
            for how in ("closed", "forgotten", "changed"):
                self.assertEqual(support.run(sys.executable, "-c", ARRAYS, how, scalar), "same\n", f"{how} {scalar}")

    def test_so_without_numpy(self):
        program = """
import sys
sys.modules["numpy"] = None
import isostep
with isostep.World("f32") as world:
    ball = world.add_shape("sphere", radius=0.5)
    for i in range(20000):
        world.create_body(type="dynamic", shape=ball, position=(2 * (i % 300), 2 * (i // 300), 0))
    world.step()
    poses = world.poses()
    first = [poses[i].position[0] for i in range(20000)]
isostep.World("f32").step()
assert [poses[i].position[0] for i in range(20000)] == first and len(set(first)) == 300
print("same")
"""
        self.assertEqual(support.run(sys.executable, "-c", program), "same\n")


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


class Seeking(unittest.TestCase):
    def test_a_long_replay_keeps_few_states(self):
        world, body = support.crate(isostep, "q16")
        tape, hashes = world.record("long"), [world.hash]
        for frame in range(5000):
            if frame % 200 == 0:
                world.apply_impulse(body, (1, 3, 0))
            world.step()
            tape.end_frame()
            hashes.append(world.hash)
        data = tape.finish()

        class Sparing(isostep.Replay):
            SPACING, STATES = 3, 7

        for most in (isostep.Replay.BYTES, 1 << 14, 1):
            replay = Sparing(data)
            replay.BYTES = most
            for frames in [5000, 4999, 0, 1, 2500, 2499, 2501, 17] + [n * 2654435761 % 5001 for n in range(40)]:
                self.assertEqual(replay.at(frames).hash, hashes[frames], frames)
                self.assertLessEqual(len(replay._kept), 7)
                taken = sum(state.size for state in replay._kept)
                self.assertTrue(taken <= most or len(replay._kept) == 1, taken)
        self.assertLessEqual(isostep.Replay.STATES, 128)

    def test_memory_is_bounded_however_long_the_match(self):
        world, _ = support.crate(isostep, "f32")
        tape = world.record("long")
        for _ in range(60):
            tape.end_frame()  # pauses: frames without a step
        for _ in range(20000):
            tape.end_frame()
        replay = isostep.Replay(tape.finish())
        replay.at(len(replay))
        self.assertLessEqual(len(replay._kept), isostep.Replay.STATES)
        self.assertGreater(len(replay._kept), isostep.Replay.STATES // 2 - 1)


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
