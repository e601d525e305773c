"""Objects that were closed, and arrays that outlive them."""

# SPDX-License-Identifier: MIT
import inspect
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


if __name__ == "__main__":
    unittest.main()
