"""Replays from Python: the tool's own figures, frames forward and back, verification, comparison."""

# SPDX-License-Identifier: MIT
import os
import subprocess
import sys
import tempfile
import unittest

import numpy

import isostep
import support

SOURCE = os.environ["ISOSTEP_SOURCE"]
sys.path.insert(0, os.path.join(SOURCE, "src/python/examples"))
import energy  # the example's own functions

SCALARS = {"f32": "float", "f64": "double", "q16": "q16.16", "q32": "q32.32"}


class Figures(unittest.TestCase):
    def test_a_scenes_figures_are_the_tools(self):
        for name in SCALARS.values():
            path, told = support.recorded("S1x5", name, 90)
            replay = isostep.Replay(path)
            self.assertEqual((replay.info.scene, replay.info.scalar, len(replay)), ("S1x5", name, 90))
            frames, moved = 0, 0.0
            for frame in replay:
                self.assertTrue(frame.agrees)
                frames += 1
                moved = max(moved, float(numpy.abs(frame.world.floats(frame.states()["velocity"])).max()))
                world = frame.world
                if frame.number == 0:
                    first = energy.energy(world)
            self.assertEqual(frames, 90)
            self.assertGreater(moved, 0)
            self.assertEqual(f"{frame.hash:016x}", told["hash"])
            self.assertTrue(numpy.isfinite(first))

    def test_the_energy_at_the_end_is_the_tools(self):
        for scene in ("S1x5", "top"):
            for name in SCALARS.values():
                path, told = support.recorded(scene, name, 60)
                replay = isostep.Replay(path)
                world = replay.at(60)
                self.assertEqual(world.counts.bodies, told["bodies"])
                self.assertEqual(world.counts.awake, told["awake"])
                self.assertEqual(world.counts.contacts, told["contacts"])
                scale = abs(told["energy_end"])
                self.assertGreater(scale, 0)
                # The tool turns by kappa, Python by the world's inertia about the spin: rounded in the scalar.
                self.assertAlmostEqual(energy.energy(world) / told["energy_end"], 1, delta=2e-3 if "16" in name else 1e-5,
                                       msg=f"{scene} {name}")


class Frames(unittest.TestCase):
    def test_any_frame_forward_and_back(self):
        path, _ = support.recorded("medley", "q32.32", 200)
        replay = isostep.Replay(path)
        hashes = [replay.start().hash] + [frame.hash for frame in replay]
        self.assertEqual(len(set(hashes)), 201, "the scene stands still")
        for frames in (0, 200, 3, 61, 60, 59, 150, 149, 0, 120):
            self.assertEqual(replay.at(frames).hash, hashes[frames], frames)
        for beyond in (-1, 201):
            with self.assertRaises(IndexError):
                replay.at(beyond)

    def test_what_python_records_the_tool_verifies(self):
        for scalar, name in SCALARS.items():
            world, body = support.crate(isostep, scalar)
            tape = world.record("of_python")
            for frame in range(60):
                if frame == 20:
                    world.apply_impulse(body, (1, 4, 0))
                world.step()
                tape.end_frame()
            with tempfile.NamedTemporaryFile(suffix=".replay") as file:
                file.write(tape.finish())
                file.flush()
                self.assertIn("VERIFIED", support.run(support.TOOL, "verify", file.name))
                self.assertEqual(isostep.verify(file.name).outcome, "verified")
                replay = isostep.Replay(file.name)
                self.assertEqual((replay.info.scene, replay.info.scalar), ("of_python", name))
                self.assertEqual([frame.hash for frame in replay][-1], world.hash)


class Verification(unittest.TestCase):
    def test_outcomes_are_those_of_the_tool(self):
        path, _ = support.recorded("S1x5", "q32.32", 90)
        with open(path, "rb") as file:
            whole = file.read()
        changed = bytearray(whole)
        changed[len(whole) // 2] ^= 1
        for data, outcome in ((whole, "verified"), (whole[:len(whole) * 2 // 3], "truncated"), (bytes(changed), "corrupt")):
            result = isostep.verify(data)
            with tempfile.NamedTemporaryFile(suffix=".replay") as file:
                file.write(data)
                file.flush()
                ended = subprocess.run([support.TOOL, "verify", file.name], capture_output=True, text=True)
            self.assertEqual(result.outcome, outcome)
            self.assertIn(result.text.split(" at ")[0].split(":")[0], ended.stdout + ended.stderr)
        self.assertEqual(isostep.Replay(path).verify(most_frames=10).frames, 10)

    def test_what_is_no_replay(self):
        for data in (b"", b"GIF89a", bytes(100)):
            with self.assertRaises(isostep.Corrupt):
                isostep.Replay(data)
        with self.assertRaises(FileNotFoundError):
            isostep.Replay("/nowhere/at.all")
        path, _ = support.recorded("S1x5", "q32.32", 90)
        with open(path, "rb") as file:
            cut = isostep.Replay(file.read()[:-200])
        self.assertEqual(cut.info.file, "truncated")
        self.assertTrue(all(frame.agrees for frame in cut))


class Comparison(unittest.TestCase):
    def test_a_replay_is_like_itself(self):
        path, _ = support.recorded("S1x5", "float", 90)
        rows = isostep.diff(path, path)
        self.assertEqual(len(rows), 90)
        self.assertTrue(rows["equal"].all())
        self.assertEqual((rows["distance"].max(), rows["differ"].max(), rows["alone"].max()), (0, 0, 0))
        self.assertEqual(len(isostep.diff_bodies(path, path, 90)), 0)

    def test_two_scalars_drift_apart(self):
        a, b = (isostep.Replay(support.recorded("S1x5", scalar, 90)[0]) for scalar in ("float", "q32.32"))
        rows = isostep.diff(a, b)
        self.assertFalse(rows["equal"].any())
        self.assertEqual(rows["alone"].max(), 0)
        self.assertGreater(rows["distance"][-1], 0)
        self.assertLess(rows["distance"].max(), 1e-2)
        bodies = isostep.diff_bodies(a, b, 90)
        self.assertGreater(len(bodies), 0)
        last = rows[-1]
        worst = bodies[bodies["body"] == last["body"]]
        gap = [row["a"] - row["b"] for row in worst if row["field"].startswith("position.")]
        self.assertAlmostEqual(float(numpy.sqrt(numpy.sum(numpy.square(gap)))), float(last["distance"]), delta=1e-12)
        text = isostep.table(rows[:3])
        self.assertEqual(len(text.splitlines()), 4)
        self.assertIn(f"{int(rows['hash_a'][0]):016x}", text)

    def test_the_first_frame_that_differs(self):
        def play(push_at):
            world, body = support.crate(isostep, "q32")
            tape = world.record("pushed")
            for frame in range(40):
                if frame == push_at:
                    world.apply_impulse(body, (1, 0, 0))
                world.step()
                tape.end_frame()
            return tape.finish(), body

        (a, body), (b, _) = play(None), play(17)
        rows = isostep.diff(a, b)
        self.assertEqual(rows["frame"][~rows["equal"]][0], 17)
        self.assertEqual(rows["body"][17], body)
        self.assertEqual({row["field"] for row in isostep.diff_bodies(a, b, 18)}, {"position.x", "velocity.x"})

    def test_the_example_prints_its_table_and_draws(self):
        paths = [support.recorded("S1x5", scalar, 90)[0] for scalar in ("float", "q32.32")]
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "energy.png")
            said = support.run(sys.executable, os.path.join(SOURCE, "src/python/examples/energy.py"), *paths, out)
            self.assertIn("distance", said.splitlines()[0])
            self.assertGreaterEqual(len(said.splitlines()), 10)
            try:
                import matplotlib  # noqa: F401
            except ImportError:
                self.assertFalse(os.path.exists(out))
            else:
                self.assertGreater(os.path.getsize(out), 10000)


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


if __name__ == "__main__":
    unittest.main()
