"""Two runs of one scene in two scalars: their energy, and how far they drift apart.

usage: energy.py A.replay B.replay [OUT.png]    prints the table; with python3-matplotlib draws it, too
"""

# SPDX-License-Identifier: MIT
import sys

import numpy

import isostep


def energy(world):
    """Kinetic and potential energy [J] of the dynamic bodies, and of their turning about the principal axes that the
    world tells inertia of."""
    gravity = numpy.array(list(world.settings.gravity))
    total = 0.0
    for body in world.bodies():
        properties, state = world.properties(body), world.state(body)
        if properties.type != "dynamic":
            continue
        velocity, centre = numpy.array(list(state.velocity)), numpy.array(list(state.centre))
        total += properties.mass * (velocity @ velocity / 2 - properties.gravity_scale * (gravity @ centre))
        spin = numpy.array(list(state.angular_velocity))
        speed = numpy.sqrt(spin @ spin)
        if speed > 1e-6:
            total += world.call("body_get_inertia", body, spin / speed) * speed**2 / 2
    return total


def energies(replay):
    """Energies after each frame; a recording of the tool begins with an empty world."""
    return numpy.array([energy(frame.world) for frame in replay])


def draw(a, b, rows, out):
    try:
        import matplotlib
    except ImportError:
        print("without python3-matplotlib nothing is drawn", file=sys.stderr)
        return
    matplotlib.use("Agg")
    from matplotlib import pyplot

    seconds = (rows["frame"] + 1) / a.info.hz
    figure, (above, below) = pyplot.subplots(2, 1, sharex=True, figsize=(8, 6), constrained_layout=True)
    above.set_title(f"{a.info.scene}: {a.info.scalar} and {b.info.scalar}")
    for replay, style in ((a, "-"), (b, "--")):
        above.plot(seconds, energies(replay)[:len(seconds)], style, label=replay.info.scalar)
    above.set_ylabel("energy [J]")
    above.legend()
    apart = numpy.where(rows["distance"] > 0, rows["distance"], numpy.nan)
    below.semilogy(seconds, apart, color="tab:red")
    below.set_ylabel("largest distance [m]")
    below.set_xlabel("time [s]")
    for axes in (above, below):
        axes.grid(True, alpha=0.3)
    figure.savefig(out, dpi=120)


def main(path_a, path_b, out=None):
    a, b = isostep.Replay(path_a), isostep.Replay(path_b)
    rows = isostep.diff(a, b)
    print(isostep.table(rows[:: max(1, len(rows) // 10)]))
    if out:
        draw(a, b, rows, out)


if __name__ == "__main__":
    main(*sys.argv[1:])
