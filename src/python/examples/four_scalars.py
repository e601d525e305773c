"""The crate of hello.cpp in every scalar that the library has; prints what four_scalars.c prints."""

# SPDX-License-Identifier: MIT
import isostep


def play(scalar):
    world = isostep.World(scalar, hz=60, substeps=8, gravity=(0, -10, 0))
    ground = world.add_shape("box", half_extents=(50, 1, 50))
    world.create_body(shape=ground, position=(0, -1, 0))
    crate = world.add_shape("box", half_extents=(0.5, 0.5, 0.5))
    body = world.create_body(type="dynamic", shape=crate, position=(0, 2, 0), user_data=42)
    world.apply_impulse(body, (0, 3, 0))
    frame, hashes = world.save(), []
    for _ in range(2):
        world.load(frame)
        for _ in range(120):
            world.step()
        hashes.append(world.hash)
    return hashes


for scalar in isostep.SCALARS:
    first, again = play(scalar)
    print(f"{scalar} {first:016x} {'equal' if first == again else 'DIFFERENT'}")
    if first != again:
        raise SystemExit(1)
