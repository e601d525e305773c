"""The same frame and the same calls as Bench.cs and native.cpp, in Python."""

# SPDX-License-Identifier: MIT
import math
import time

import isostep

BODIES, ROUNDS, FRAMES, CALLS, READS = 1000, 5, 200, 4000, 400


def pile(scalar):
    world = isostep.World(scalar)
    ground = world.add_shape("box", half_extents=(50, 1, 50))
    world.create_body(shape=ground, position=(0, -1, 0))
    crate = world.add_shape("box", half_extents=(0.5, 0.5, 0.5))
    for i in range(BODIES):
        place = (i % 10 * 1.25 - 6, 0.75 + i // 100 * 1.5, i // 10 % 10 * 1.25 - 6)
        world.create_body(type="dynamic", shape=crate, position=place, allow_sleep=False)
    return world


def heights(world):
    return world.poses(0.5)["position"][:, 1].sum(dtype="f8")


def least(times, work, begin=lambda: None):
    """[s] of one `work()`, the least of several rounds of so many, each after `begin()`."""
    found = math.inf
    for _ in range(ROUNDS):
        begin()
        start = time.process_time()
        for _ in range(times):
            work()
        found = min(found, (time.process_time() - start) / times)
    return found


def measure(name, world):
    def frame():
        world.step()
        sums.append(heights(world))

    start, sums = world.save(), []
    print(f"{name} {least(FRAMES, frame, lambda: world.load(start)) * 1e3:.4f} ms a frame, sum {sum(sums):.6g}")
    print(f"{name} {least(READS, lambda: heights(world)) * 1e6:.4f} us for its poses")


def time_call(name, call):
    print(f"{name} {least(CALLS, call) * 1e9:.1f} ns")


def main():
    for name, scalar in (("F32", "f32"), ("Fixed32", "q32")):
        with pile(scalar) as world:
            measure(name, world)
    with isostep.World("f32") as world:
        body = world.create_body(type="dynamic", shape=world.add_shape("sphere", radius=1))
        time_call("BodyExists", lambda: world.call("body_exists", body))
        time_call("GetBodyState", lambda: world.state(body))
        time_call("ApplyImpulse", lambda: world.apply_impulse(body, (0, 0, 0)))


main()
