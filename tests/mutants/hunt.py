#!/usr/bin/env python3
"""Runs the tests against each mutant that plant.py planted, the nearest first, until one of them fails.

hunt.py BUILD TREE [--minutes 6] [--jobs 2]

Writes TREE/hunted.json after each mutant and goes on from there when it is called again. Typed tests run in their first
scalar, float. A test that takes four times as long as without a mutant, and ten seconds, counts as failed.
"""
# SPDX-License-Identifier: MIT
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import time

# The tests that are nearest to a file, by its path; the first pattern that is found in it.
NEAREST = [
    (r"/particles/", "unit_particles"), (r"/session/", "unit_session|session_.*"), (r"/collision/", "unit_collision"),
    (r"^src/c/", "c|c_.*|python_.*"), (r"^scalar/", "unit_scalar.*|unit_lanes.*|unit_exact.*"),
    (r"/state/", "unit_state|reject"), (r"/book/", "unit_book"), (r"/geometry/", "unit_geometry"),
    (r"/math/", "unit_math"), (r"/core/", "unit_core"), (r"/(effects|fracture)/", "unit_effects"),
    (r"/(dynamics|articulation)/", "unit_dynamics"), (r"", "unit_world"),
]
# Then all of these. What compares hashes alone comes last: it finds that something changed, not what is wrong.
AFTER = ["laws", "reject", "unit_.*", "determinism", "session_.*", "c|c_.*", "python_.*", "range|prover|readme_launcher",
         "determinism_(allocation|hostile|portable|goldens)"]
FLOAT_ALONE = "-*/1.*:*/2.*:*/3.*"


class Tests:
    def __init__(self, build):
        self.build = build
        listed = subprocess.run(["ctest", "-N"], cwd=build, capture_output=True, text=True, check=True).stdout
        self.names = re.findall(r"Test +#\d+: (\S+)", listed)
        self.usual = {}  # [s] by name, of those that pass without a mutant

    def order(self, path):
        nearest = next(tests for pattern, tests in NEAREST if re.search(pattern, path))
        found = []
        for pattern in [nearest] + AFTER:
            found += [n for n in sorted(self.names, key=lambda n: self.usual.get(n, 0))
                      if re.fullmatch(pattern, n) and n not in found]
        return found

    def run(self, name, mutant, limit):
        """Returns (passed, seconds)."""
        env = dict(os.environ, ISOSTEP_MUTANT=str(mutant), GTEST_FILTER=FLOAT_ALONE, GTEST_FAIL_FAST="1")
        begin = time.monotonic()
        ended = subprocess.run(["ctest", "-R", f"^{name}$", "--timeout", str(max(1, int(limit)))], cwd=self.build,
                               env=env, capture_output=True)
        return ended.returncode == 0, time.monotonic() - begin

    def measure(self, kept):
        if kept.exists():
            self.usual = json.loads(kept.read_text())
            return
        for name in self.order(""):
            passed, seconds = self.run(name, 0, 1500)
            if passed:
                self.usual[name] = seconds
            else:
                print(f"{name} fails without a mutant: left out", flush=True)
        kept.write_text(json.dumps(self.usual, indent=1))


def hunt(tests, mutant, seconds):
    begin = time.monotonic()
    for name in tests.order(mutant["file"]):
        left = seconds - (time.monotonic() - begin)
        if left <= 0:
            break
        if name not in tests.usual:
            continue
        patience = 4 * tests.usual[name] + 10
        passed, took = tests.run(name, mutant["id"], min(left, patience))
        if not passed and (took < left - 1 or took >= patience):
            return {"killed_by": name, "seconds": round(time.monotonic() - begin, 1)}
    return {"killed_by": None, "seconds": round(time.monotonic() - begin, 1)}


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("build", type=pathlib.Path)
    words.add_argument("tree", type=pathlib.Path)
    words.add_argument("--minutes", type=float, default=6)
    words.add_argument("--jobs", type=int, default=2)
    given = words.parse_args()
    mutants = json.loads((given.tree / "mutants.json").read_text())
    kept = given.tree / "hunted.json"
    hunted = json.loads(kept.read_text()) if kept.exists() else {}
    tests = Tests(given.build)
    tests.measure(given.tree / "usual.json")
    todo = [m for m in mutants if str(m["id"]) not in hunted]
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        runs = {pool.submit(hunt, tests, m, given.minutes * 60): m for m in todo}
        for run in concurrent.futures.as_completed(runs):
            mutant = runs[run]
            hunted[str(mutant["id"])] = run.result()
            kept.write_text(json.dumps(hunted, indent=1))
            by = run.result()["killed_by"] or "SURVIVES"
            print(f'{mutant["id"]:3} {by:24} {run.result()["seconds"]:6.1f} s  {mutant["file"]}:{mutant["line"]}', flush=True)
    killed = sum(1 for h in hunted.values() if h["killed_by"])
    print(f"{killed} of {len(mutants)} killed")


if __name__ == "__main__":
    main()
