"""Matches between Python peers over a bad network in virtual time: all agree, and C++ plays the recording again."""

# SPDX-License-Identifier: MIT
import struct
import tempfile
import unittest

import isostep
import support

FRAMES = 240
PERIOD = 1_000_000 // 60


class Pushers(isostep.Game):
    """Each player pushes a crate of its own by its input, a byte for each direction; the score is beside the world."""

    def __init__(self, scalar, players=2):
        super().__init__(isostep.World(scalar, hz=60, substeps=4), block_size=8)
        world = self.world
        world.create_body(shape=world.add_shape("box", half_extents=(50, 1, 50)), position=(0, -1, 0))
        box = world.add_shape("box", half_extents=(0.5, 0.5, 0.5))
        self.crates = [world.create_body(type="dynamic", shape=box, position=(3 * i, 1, 0), allow_sleep=False)
                       for i in range(players)]
        self.hashes, self.steps, self.rollbacks = {}, 0, 0

    def step(self, inputs):
        score = struct.unpack_from("<q", self.state)[0]
        for crate, one in zip(self.crates, inputs):
            x, z = struct.unpack("<bb", one.bytes)
            if x or z:
                self.world.apply_impulse(crate, (x / 16, 0, z / 16))
                score += abs(x) + abs(z)
        struct.pack_into("<q", self.state, 0, score)
        self.world.step()
        self.steps += 1

    def rolled_back(self, frame):
        self.rollbacks += 1

    def confirmed(self, frame, hash):
        self.hashes[frame] = hash

    @property
    def score(self):
        return struct.unpack_from("<q", self.state)[0]


def config(mode, **more):
    return dict(mode=mode, players=2, hz=60, name="pushers 1", input_text="x z", input_least=2, input_cap=2,
                neutral=bytes(2), **more)


def wanted(player, frame):
    """What a player presses: nothing most of the time, then something that nobody guesses."""
    noise = (frame * 2654435761 + player * 40503) >> 7
    return struct.pack("<bb", noise % 7 - 3, noise // 7 % 5 - 2) if frame // 8 % 3 == player else bytes(2)


def play(scalar, mode, profile, record=False):
    games = [Pushers(scalar), Pushers(scalar)]
    more = dict(window=8) if mode == "rollback" else dict(window=0)
    sessions = [isostep.Session(games[0], host=True, local_players=1, seed=0x1357924680ace, **config(mode, **more)),
                isostep.Session(games[1], **config(mode, **more))]
    if record:
        sessions[0].call("record", "world", "pushers")
    network = isostep.Network(7)
    network.add_client(profile)
    now, kinds = 0, set()
    while min(session.confirmed for session in sessions) < FRAMES and now < 60_000_000:
        for session in sessions:
            player = session.call("local_player")
            if player >= 0 and session.phase == "playing":
                session.add_input(player, wanted(player, session.current))
        network.drive(sessions, now)
        for session in sessions:
            kinds |= {event.kind for event in session.events()}
        now += PERIOD // 4
    file = sessions[0].call("recorded", "world") if record else b""
    return games, sessions, kinds, file


class Matches(unittest.TestCase):
    def test_peers_agree_and_roll_back(self):
        for scalar in isostep.SCALARS:
            games, sessions, kinds, _ = play(scalar, "rollback", "latency=60,jitter=15,loss=5")
            common = set(games[0].hashes) & set(games[1].hashes)
            self.assertGreaterEqual(len(common), FRAMES)
            self.assertTrue(all(games[0].hashes[frame] == games[1].hashes[frame] for frame in common))
            self.assertGreater(games[0].rollbacks + games[1].rollbacks, 5, "nothing was rolled back")
            self.assertGreater(games[0].steps, FRAMES)
            self.assertGreater(games[0].score, 100)
            self.assertIn("started", kinds)
            self.assertFalse(kinds & {"desync", "misuse", "outvoted", "undecided"}, kinds)
            self.assertGreater(sum(sessions[1].stats.rollbacks), 0)
            self.assertGreater(sessions[0].stats.datagrams_in, 100)

    def test_lockstep_never_rolls_back(self):
        games, _, kinds, _ = play("f32", "lockstep", "wifi")
        common = set(games[0].hashes) & set(games[1].hashes)
        self.assertGreaterEqual(len(common), FRAMES)
        self.assertTrue(all(games[0].hashes[frame] == games[1].hashes[frame] for frame in common))
        self.assertEqual(games[0].rollbacks + games[1].rollbacks, 0)
        self.assertNotIn("desync", kinds)

    def test_cpp_plays_the_recording_of_a_python_match(self):
        for scalar in isostep.SCALARS:
            _, _, _, file = play(scalar, "rollback", "latency=60,jitter=15,loss=5", record=True)
            with tempfile.NamedTemporaryFile(suffix=".replay") as replay:
                replay.write(file)
                replay.flush()
                said = support.run(support.TOOL, "verify", replay.name)
            self.assertIn("VERIFIED", said)
            opened = isostep.Replay(file)
            self.assertGreaterEqual(len(opened), FRAMES)
            self.assertEqual(opened.info.scene, "pushers")

    def test_a_game_that_forgets_something_desyncs(self):
        class Forgetful(Pushers):
            def step(self, inputs):
                super().step(inputs)
                if self.forgets and self.world.tick == 100:
                    self.world.apply_impulse(self.crates[0], (1 / 64, 0, 0))

        games = [Forgetful("q32"), Forgetful("q32")]
        games[0].forgets, games[1].forgets = False, True
        sessions = [isostep.Session(games[0], host=True, local_players=1, seed=99, **config("lockstep", window=0)),
                    isostep.Session(games[1], **config("lockstep", window=0))]
        network = isostep.Network(3)
        network.add_client("lan")
        kinds, now = set(), 0
        while sessions[0].confirmed < 200 and now < 30_000_000:
            network.drive(sessions, now)
            for session in sessions:
                kinds |= {event.kind for event in session.events()}
            now += PERIOD // 4
        self.assertTrue(kinds & {"desync", "undecided"}, kinds)

    def test_a_config_that_breaks_a_rule_is_named(self):
        game = Pushers("f32")
        for broken, named in ((dict(players=0), "players"), (dict(seed=0, host=True), "seed")):
            with self.assertRaises(ValueError) as caught:
                isostep.Session(game, **{**config("lockstep", window=0), **broken})
            self.assertIn(named, str(caught.exception))
        with self.assertRaises(ValueError):
            isostep.Session(game, **config("chess"))
        session = isostep.Session(game, host=True, local_players=1, seed=5, **config("lockstep", window=0))
        with self.assertRaises(isostep.Error):
            session.add_input(1, bytes(2))  # not a player of this machine
        session.close()
        with self.assertRaises(isostep.Error):
            session.drive(0)


class Summing(isostep.Game):
    """No world: a sum of all inputs."""

    def __init__(self):
        super().__init__(block_size=8)
        self.finals = 0

    def step(self, inputs):
        total = struct.unpack_from("<q", self.state)[0]
        struct.pack_into("<q", self.state, 0, (3 * total + 1 + sum(one.bytes[0] for one in inputs)) % 2**62)

    def confirmed(self, frame, hash):
        self.finals += 1


class Standing:
    """Machines with migration, whose host is machine 0; those that are silent take no turns."""

    def __init__(self, mode, machines):
        self.now, self.silent = 0, set()
        self.network = isostep.Network(5)
        self.peers = [isostep.Session(Summing(), mode=mode, host=n == 0, players=machines, seed=3 + n, name="sum",
                                      input_text="what", migration=1_000_000, address=str(n)) for n in range(machines)]
        for _ in range(1, machines):
            self.network.add_client("latency=20")

    def go_away(self, who):
        self.silent.add(who)
        self.network.call("set_silent", who, True)

    def play(self, seconds):
        end = self.now + seconds * 1_000_000
        while self.now < end:
            self.network.call("advance_to", self.now)
            for who, peer in enumerate(self.peers):
                if who in self.silent:
                    continue
                self.network.call("deliver", who, peer, self.now)
                player = peer.call("local_player")
                if peer.phase == "playing" and player >= 0:
                    peer.add_input(player, bytes([peer.current // 7 % 3]))
                peer.drive(self.now)
                self.network.call("dispatch", who, peer, self.now)
            self.now += 4000


class GoOn(unittest.TestCase):
    def check(self, mode, machines, left):
        match = Standing(mode, machines)
        peer = match.peers[left]
        match.play(6)
        self.assertGreater(peer.game.finals, 200)
        with self.assertRaises(isostep.Error, msg="all are here"):
            peer.go_on(match.now)
        for who in set(range(machines)) - {left}:
            match.go_away(who)
        match.play(4)
        stood = peer.game.finals
        match.play(20)
        self.assertEqual(peer.game.finals, stood, "the others may play elsewhere")
        peer.go_on(match.now)
        match.play(5)
        self.assertGreater(peer.game.finals, stood + 200)
        with self.assertRaises(isostep.Error, msg="it goes on"):
            peer.go_on(match.now)

    def test_a_match_that_stands_goes_on_with_those_who_are_here(self):
        for mode in ("lockstep", "rollback"):
            for machines, left in ((2, 1), (3, 0)):
                with self.subTest(mode=mode, machines=machines):
                    self.check(mode, machines, left)


if __name__ == "__main__":
    unittest.main()
