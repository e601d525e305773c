"""What the tests of the Python package share: the tool, the C++ example, replays of named scenes."""

# SPDX-License-Identifier: MIT
import functools
import json
import os
import subprocess
import sys
import tempfile

TOOL = os.environ["ISOSTEP_TOOL"]
FOUR_SCALARS = os.environ["ISOSTEP_FOUR_SCALARS"]
_folder = tempfile.TemporaryDirectory()


def run(*command, **options):
    """What it prints; it must succeed."""
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


@functools.lru_cache
def recorded(scene, scalar, frames):
    """(path of the replay, what `isostep run --json` says of the run)"""
    path = os.path.join(_folder.name, f"{scene}.{scalar}.{frames}.replay")
    said = run(TOOL, "run", scene, "--scalar", scalar, "--frames", str(frames), "--record", path, "--json")
    return path, json.loads(said)


@functools.lru_cache
def cpp_hashes():
    """{family: [hash after each of 120 steps]} as C++ computes them."""
    hashes = {}
    for line in run(FOUR_SCALARS, "frames").splitlines():
        family, frame, digits = line.split()
        hashes.setdefault(family, {})[int(frame)] = int(digits, 16)
    return {family: [by_frame[i] for i in range(120)] for family, by_frame in hashes.items()}


def crate(isostep, scalar, **own):
    """The world of hello.cpp and its crate."""
    world = isostep.World(scalar, hz=60, substeps=8, gravity=(0, -10, 0))
    world.create_body(shape=world.add_shape("box", half_extents=(50, 1, 50)), position=(0, -1, 0))
    body = world.create_body(type="dynamic", shape=world.add_shape("box", half_extents=(0.5, 0.5, 0.5)),
                             position=(0, 2, 0), user_data=42, **own)
    world.apply_impulse(body, (0, 3, 0))
    return world, body


def resident():
    """[bytes] of this process in memory."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
