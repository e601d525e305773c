"""Worlds from Python: the hashes of C++, values in and out, refusals, views, memory."""

# SPDX-License-Identifier: MIT
import gc
import subprocess
import sys
import unittest

import numpy

import isostep
import support


class Hashes(unittest.TestCase):
    def test_every_frame_has_the_hash_of_cpp_in_four_scalars(self):
        expected = support.cpp_hashes()
        self.assertEqual(set(expected), set(isostep.SCALARS))
        for scalar in isostep.SCALARS:
            world, _ = support.crate(isostep, scalar)
            hashes = []
            for _ in range(120):
                world.step()
                hashes.append(world.hash)
            self.assertEqual(hashes, expected[scalar], scalar)
            self.assertEqual(len(set(hashes[:40])), 40, "the crate stands still")

    def test_a_loaded_state_has_the_same_future(self):
        for scalar in isostep.SCALARS:
            world, _ = support.crate(isostep, scalar)
            frame = world.save()
            futures = []
            for _ in range(2):
                world.load(frame)
                for _ in range(60):
                    world.step()
                futures.append(world.hash)
            self.assertEqual(futures[0], futures[1])

    def test_bytes_make_the_same_world_elsewhere(self):
        world, _ = support.crate(isostep, "q32")
        for _ in range(30):
            world.step()
        other = isostep.World("q32")
        other.read(world.write())
        self.assertEqual(other.hash, world.hash)

    def test_the_example_runs_without_numpy(self):
        said = support.run(sys.executable, "-c", "import sys, runpy; sys.modules['numpy'] = None; "
                           "runpy.run_path(sys.argv[1], run_name='__main__')", "src/python/examples/four_scalars.py",
                           cwd=support.os.environ["ISOSTEP_SOURCE"])
        self.assertEqual(said, support.run(support.FOUR_SCALARS))

    def test_the_library_checks_itself(self):
        check = isostep.selfcheck()
        self.assertTrue(check.sound, check.text)
        self.assertGreater(check.frames, 0)


class Values(unittest.TestCase):
    def test_what_is_set_comes_back(self):
        for scalar in isostep.SCALARS:
            world = isostep.World(scalar, hz=30, substeps=4, gravity=(0, -1.625, 0))
            settings = world.settings
            self.assertEqual((settings.hz, settings.substeps, tuple(settings.gravity)), (30, 4, (0, -1.625, 0)))
            body = world.create_body(type="dynamic", shape=world.add_shape("sphere", radius=0.5), position=(1, 2.25, -3),
                                     velocity=(0.5, 0, 0), material={"friction": 0.25}, user_data=1 << 63)
            state, properties = world.state(body), world.properties(body)
            self.assertEqual(tuple(state.pose.position), (1, 2.25, -3))
            self.assertEqual(tuple(state.pose.orientation), (0, 0, 0, 1))
            self.assertEqual((state.type, state.user_data, state.awake), ("dynamic", 1 << 63, True))
            self.assertEqual((properties.material.friction, properties.material.restitution), (0.25, 0))
            self.assertEqual(isostep.World(scalar).settings.hz, 60, "defaults are C++'s")

    def test_settings_take_no_input_and_no_state_back(self):
        for scalar in isostep.SCALARS:
            hashes = []
            for stale in (False, True):
                world = isostep.World(scalar)
                capsule = world.add_shape("capsule", radius=0.5, half_height=0.5)
                body = world.create_body(type="kinematic", shape=capsule, position=(0, 20, 0))
                walker = world.add_record("character", body=body, step_height=0.25)
                for _ in range(60):
                    if stale:
                        world.set_record("character", walker, step_height=0.25)
                    world.set_input("character", walker, move=(1, 0, 0))
                    world.step()
                self.assertLess(world.get_state("character", walker).velocity.y, -5, "it falls for a second")
                self.assertEqual(tuple(world.get_input("character", walker).move), (1, 0, 0))
                hashes.append(world.hash)
            self.assertEqual(hashes[0], hashes[1], scalar)

    def test_settings_take_nothing_back_from_a_vehicle_and_its_wheel(self):
        for scalar in isostep.SCALARS:
            hashes = []
            for stale in (False, True):
                world = isostep.World(scalar)
                box = world.add_shape("box", half_extents=(1, 0.5, 2))
                body = world.create_body(type="dynamic", shape=box, position=(0, 20, 0))
                vehicle = world.add_record("vehicle", body=body, engine_torque=100, engine_inertia=1, clutch_torque=100)
                wheel = world.add_record("wheel", body=body, drive_share=1)
                copies = world.get_record("vehicle", vehicle), world.get_record("wheel", wheel)
                for _ in range(60):
                    if stale:
                        world.call("set_vehicle", vehicle, copies[0])
                        world.call("set_wheel", wheel, copies[1])
                    world.set_input("vehicle", vehicle, throttle=1)
                    world.step()
                # In the air 100 N m turn an engine and a wheel of 1 kg m^2 each for a second.
                self.assertAlmostEqual(world.get_state("vehicle", vehicle).engine_spin, 50, places=1)
                self.assertAlmostEqual(world.get_state("wheel", wheel).spin, 50, places=1)
                self.assertEqual(world.get_input("vehicle", vehicle).throttle, 1)
                hashes.append(world.hash)
            self.assertEqual(hashes[0], hashes[1], scalar)

    def test_numbers_cross_by_their_bits(self):
        world = isostep.World("q32")
        shape = world.add_shape("sphere", radius=1)
        bits = (3 << 32) + 1  # no double between 2 and 4 has this last bit's value lost: 3 + 2^-32
        body = world.create_body(type="dynamic", shape=shape, position=(isostep.Raw(bits), 0, 0))
        self.assertEqual(world.state(body).pose.position.raw("x"), bits)
        self.assertEqual(world.states()["pose"]["position"]["x"].tolist(), [bits])
        large = (1 << 40) + 1  # 2^8 + 2^-32 needs 41 bits: a double has it, a float has not
        world.set_pose(body, (isostep.Raw(large), 0, 0))
        self.assertEqual(world.state(body).pose.position.raw("x"), large)

    def test_records_and_joints(self):
        for scalar in isostep.SCALARS:
            world, body = support.crate(isostep, scalar)
            thruster = world.add_record("thruster", body=body, force=(0, 1, 0))
            self.assertEqual(tuple(world.get_record("thruster", thruster).force), (0, 1, 0))
            world.set_record("thruster", thruster, force=(0, 2, 0))
            self.assertEqual(world.get_record("thruster", thruster).body, body)
            self.assertEqual(tuple(world.get_record("thruster", thruster).force), (0, 2, 0))
            world.remove_record("thruster", thruster)
            with self.assertRaises(isostep.Refused):
                world.get_record("thruster", thruster)
            hinge = world.create_joint("hinge", a=body, frame={"position": (0, 2, 0)}, limit={"lower": -0.5, "upper": 0.5})
            self.assertEqual(world.call("joints").tolist(), [hinge])
            world.destroy_joint(hinge)
            self.assertEqual(len(world.call("joints")), 0)

    def test_a_body_that_grows_stays_on_its_ground(self):
        for scalar in isostep.SCALARS:
            world, body = support.crate(isostep, scalar)
            large = world.add_shape("box", half_extents=(1, 1, 1))
            for _ in range(120):
                world.step()
            mass, frame, hashes = world.properties(body).mass, world.save(), []
            for _ in range(2):
                world.load(frame)
                world.call("body_set_shape", body, large, None)
                self.assertEqual(world.properties(body).mass, mass)
                for _ in range(120):
                    world.step()
                self.assertAlmostEqual(world.state(body).pose.position.y, 1, places=2)
                hashes.append(world.hash)
            self.assertEqual(hashes[0], hashes[1], scalar)
            with self.assertRaises(isostep.Refused) as caught:
                world.call("body_set_shape", body, large + (1 << 32), None)  # another generation
            self.assertEqual(caught.exception.field, "shape")
            self.assertEqual(world.hash, hashes[1])

    def test_setters_of_a_hinge_drive_it(self):
        for scalar in isostep.SCALARS:
            world = isostep.World(scalar)
            box = world.add_shape("box", half_extents=(0.5, 0.5, 0.5))
            hinge = world.create_joint("hinge", a=world.create_body(type="dynamic", shape=box))
            for setters, angle in (([("motor", 1, 100)], 1), ([("limits", -1.5, 1.25)], 1.25),
                                   ([("motor", 0, 0), ("spring", 4, 1), ("target", -0.5)], -0.5)):
                for name, *numbers in setters:
                    world.call(f"joint_set_{name}", hinge, *numbers)
                for _ in range(60):
                    world.step()
                self.assertAlmostEqual(world.call("joint_get_position", hinge), angle, places=2)
            before = world.hash
            too_fast = (1 << 17 if scalar == "f64" else 1 << 14) + 1  # beyond Limits::angular_speed()
            for name, numbers, field in (("limits", (1, 0), "lower"), ("motor", (too_fast, 1), "motor_speed"),
                                         ("spring", (4, -1), "spring_damping"), ("target", (7,), "spring_target")):
                with self.assertRaises(isostep.Refused) as caught:
                    world.call(f"joint_set_{name}", hinge, *numbers)
                self.assertEqual((caught.exception.command, caught.exception.field), (f"set_joint_{name}", field))
            self.assertEqual(world.hash, before)

    def test_queries(self):
        for scalar in isostep.SCALARS:
            world, body = support.crate(isostep, scalar)
            hit = world.cast_ray((0, 5, 0), (0, -10, 0))
            self.assertEqual(hit.body, body)
            self.assertAlmostEqual(hit.point.y, 2.5, places=3)
            self.assertIsNone(world.cast_ray((0, 5, 0), (0, 10, 0)))
            floor = world.cast_ray((0, 5, 0), (0, -10, 0), ignore_all=[body])
            self.assertAlmostEqual(floor.point.y, 0, places=3)
            hits = world.cast_ray_all((0, 5, 0), (0, -10, 0))
            self.assertEqual(hits["body"].tolist(), [body, floor.body])
            self.assertEqual(world.closest_point((0, 4, 0), 3).body, body)

    def test_shapes_of_points_and_triangles(self):
        for scalar in isostep.SCALARS:
            world = isostep.World(scalar)
            hull = world.add_hull([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
            body = world.create_body(type="dynamic", shape=hull, position=(0, 3, 0))
            with isostep.Blob.mesh([(-9, 0, -9), (-9, 0, 9), (9, 0, 9), (9, 0, -9)], [(0, 1, 2), (0, 2, 3)]) as blob:
                self.assertEqual(blob.name, isostep.Blob.read(blob.write()).name)
                world.create_body(shape=world.add_blob(blob))
            for _ in range(120):
                world.step()
            self.assertAlmostEqual(world.state(body).pose.position.y, 1, places=1)


class Refusals(unittest.TestCase):
    def test_the_world_says_what_it_refuses(self):
        world, body = support.crate(isostep, "f32")
        before = world.hash
        with self.assertRaises(isostep.Refused) as caught:
            world.create_body(type="dynamic", shape=0)
        self.assertEqual((caught.exception.command, caught.exception.field), ("create_body", "shape"))
        with self.assertRaises(isostep.Refused) as caught:
            world.call("body_set_material", body, {"friction": -1})
        self.assertEqual((caught.exception.field, caught.exception.expected), ("material.friction", "0 to 16"))
        self.assertIn("0 to 16", str(caught.exception))
        with self.assertRaises(isostep.Refused):
            world.apply_impulse(body + (1 << 32), (0, 1, 0))  # another generation
        self.assertEqual(world.hash, before)

    def test_scalars_do_not_mix(self):
        world, body = support.crate(isostep, "f32")
        with self.assertRaises(isostep.WrongScalar):
            isostep.library.call("iso_q32_body_apply_impulse")(world, body, (0, 1, 0), None)
        with self.assertRaises(ValueError) as caught:
            isostep.World("q8")
        self.assertIn("f32, f64, q16, q32", str(caught.exception))

    def test_what_is_no_value_is_refused_before_the_call(self):
        world = isostep.World("q32")
        for fields in ({"type": "movable"}, {"position": (0, 0)}, {"position": (0, float("nan"), 0)}, {"shape": -1},
                       {"user_data": 1 << 64}, {"sensor": 2}, {"filter": {"mask": 1 << 32}}):
            with self.assertRaises(ValueError, msg=str(fields)):
                world.create_body(**fields)
        with self.assertRaises(AttributeError) as caught:
            world.create_body(colour="red")
        self.assertIn("no 'colour'", str(caught.exception))
        with self.assertRaises(AttributeError):
            world.call("fly")
        with self.assertRaises(TypeError):
            world.call("step", 1)
        self.assertEqual(len(world.bodies()), 0)

    def test_what_was_closed_says_so(self):
        world, _ = support.crate(isostep, "f64")
        snapshot = world.save()
        world.close()
        world.close()
        for use in (world.step, lambda: world.hash, world.save, world.bodies):
            with self.assertRaises(isostep.Error):
                use()
        other, _ = support.crate(isostep, "f64")
        other.load(snapshot)  # it outlives its world
        with self.assertRaises(isostep.Error):
            isostep.World("f32").load(snapshot)

    def test_a_library_that_is_not_there_is_named(self):
        environment = {**support.os.environ, "ISOSTEP_LIBRARY": "/nowhere/libisostep.so.0"}
        ended = subprocess.run([sys.executable, "-c", "import isostep"], env=environment, capture_output=True, text=True)
        self.assertNotEqual(ended.returncode, 0)
        self.assertIn("/nowhere/libisostep.so.0", ended.stderr)


class Views(unittest.TestCase):
    def test_states_are_an_array_of_all_bodies(self):
        for scalar in isostep.SCALARS:
            world, body = support.crate(isostep, scalar)
            for _ in range(10):
                world.step()
            states = world.states()
            self.assertEqual(len(states), 2)
            place = world.bodies().tolist().index(body)
            one = world.state(body)
            self.assertEqual(tuple(world.floats(states["pose"]["position"])[place]), tuple(one.pose.position))
            self.assertEqual(tuple(world.floats(states["pose"]["orientation"], unit=True)[place]),
                             tuple(one.pose.orientation))
            self.assertEqual(states["velocity"]["y"][place], one.velocity.raw("y"))
            self.assertEqual(states["user_data"].tolist()[place], 42)
            only = world.states([body])
            self.assertEqual(only.tobytes(), states[place:place + 1].tobytes())
            with self.assertRaises(isostep.Refused):
                world.states([body, body + (1 << 32)])
        self.assertEqual(len(isostep.World("q16").states()), 0)

    def test_poses_and_events_are_what_was_and_read_only(self):
        for scalar in isostep.SCALARS:
            world, body = support.crate(isostep, scalar, report_contacts=True)
            begun = None
            for _ in range(120):
                world.step()
                begins = world.events.contact_begins
                if len(begins):
                    begun = begins.copy()
            self.assertEqual(begun["b" if begun["a"][0] != body else "a"].tolist(), [body])
            self.assertGreater(world.floats(begun["impulse"])[0], 1)
            poses = world.poses()
            self.assertEqual(poses["body"].tolist(), [body])
            self.assertAlmostEqual(float(poses["position"][0][1]), 0.5, places=2)
            with self.assertRaises(ValueError):
                poses["position"][0][1] = 7
            with self.assertRaises(AttributeError):
                world.events.explosions
            self.assertEqual(len(world.events.woke), 0)


class Memory(unittest.TestCase):
    def test_handles_are_destroyed_by_their_whole_address(self):
        # A thread's memory lies above 4 GB, also in a Python that was linked for an address below: Debian's own.
        program = """
import threading
import isostep

def use():
    world = isostep.World("q32")
    print(world._address >> 32 > 0)
    world.close()
    isostep.World("q32").save()

thread = threading.Thread(target=use)
thread.start()
thread.join()
"""
        self.assertEqual(support.run(sys.executable, "-c", program), "True\n")

    def test_what_nobody_has_any_more_is_given_back(self):
        def use():
            world, _ = support.crate(isostep, "q32")
            world.step()
            snapshot = world.save()
            world.states()
            world.poses()
            with world.record("leak") as tape:
                world.step()
                tape.end_frame()
                isostep.Replay(tape.finish()).at(1)
            return snapshot

        for _ in range(200):
            use()
        gc.collect()
        before = support.resident()
        for _ in range(1000):
            use()
        gc.collect()
        grown = support.resident() - before
        self.assertLess(grown, 4 << 20, "1000 worlds, snapshots, tapes and replays stayed in part")


if __name__ == "__main__":
    unittest.main()
