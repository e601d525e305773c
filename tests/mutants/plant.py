#!/usr/bin/env python3
"""Plants mutants into a copy of the sources: small faults that a variable of the environment switches on, one at a time.

plant.py TREE [--seed N] [--count N] [--without ID,...]

TREE is a checkout that is thrown away afterwards; the files in it are changed. One build has all mutants, and a test
that runs with ISOSTEP_MUTANT=7 runs with the seventh. TREE/mutants.json lists them. A mutant that does not compile is
named to --without: another one takes its place, and the others stay.
"""
# SPDX-License-Identifier: MIT
import argparse
import json
import pathlib
import random
import re

FOLDERS = ["include", "scalar", "src/isostep", "src/c"]
SWITCH = "isostep/scalar/mutant.hpp"
SWITCH_TEXT = """#pragma once
#include <type_traits>
namespace isostep {
extern const int mutant_in_use;  // 0: none
constexpr bool mutant(int id) { return !std::is_constant_evaluated() && mutant_in_use == id; }
}  // namespace isostep
"""
SWITCH_BODY = """
#include <cstdlib>
namespace isostep {
const int mutant_in_use = std::getenv("ISOSTEP_MUTANT") == nullptr ? 0 : std::atoi(std::getenv("ISOSTEP_MUTANT"));
}  // namespace isostep
"""

# What a mutant makes of an expression: the kind, where it applies, and what stands there afterwards.
CHANGES = [
    ("bound", r" < ", " <= "), ("bound", r" <= ", " < "), ("bound", r" > ", " >= "), ("bound", r" >= ", " > "),
    ("operator", r" == ", " != "), ("operator", r" != ", " == "), ("operator", r" && ", " || "),
    ("operator", r" \|\| ", " && "), ("operator", r" \+ ", " - "), ("operator", r" - ", " + "),
    ("operator", r"\bmin\(", "max("), ("operator", r"\bmax\(", "min("), ("operator", r"\btrue\b", "false"),
    ("operator", r"\bfalse\b", "true"), ("sign", r"(?<=[(,=] )-(?=[a-z])|(?<=[({])-(?=[a-z])", ""),
    ("sign", r"(?<=[( ])!(?=[a-z])", ""), ("bound", r"\b0\b(?![.xu])", "1"), ("bound", r"\b1\b(?![.xu])", "2"),
    ("bound", r"\b2\b(?![.xu])", "3"),
]
LVALUE = r"[A-Za-z_][\w.\->\[\]]*(?:\([\w, ]*\)[\w.\->\[\]]*)*"
# Statements of one line; `what` is the part that changes.
FORMS = {
    "return": re.compile(r"^(?P<before>\s+)return (?P<what>[^{}]+);$"),
    "assign": re.compile(r"^(?P<before>\s+)(?P<to>" + LVALUE + r" [-+*|&]?= )(?P<what>[^={};][^{};]*);$"),
    "declare": re.compile(r"^(?P<before>\s+(?:const )?[A-Za-z_][\w:<>]* \w+ = )(?P<what>[^{};]+);$"),
    "if": re.compile(r"^(?P<before>\s+(?:\} else )?if \()(?P<what>[^{};]+)(?P<after>\)(?: \{| [^{}]*;)?)$"),
    "drop": re.compile(r"^(?P<before>\s+)(?P<what>" + LVALUE + r"(?: [-+*|&]?= [^{};]+|\([^{};]*\)));$"),
}


def depths(text):
    """Yields each character and how many brackets are open after it."""
    depth = 0
    for c in text:
        depth += (c in "([") - (c in ")]")
        yield c, depth


def balanced(text):
    open_after = [depth for _, depth in depths(text)]
    return min(open_after) >= 0 and open_after[-1] == 0


def one_value(expression):
    """Returns false for `a = 1, b = 2`: a comma outside of brackets."""
    return all(c != "," or depth > 0 for c, depth in depths(expression))


def sites_of(text):
    """Yields (line number, form, match) for each statement of one line that is not a macro's."""
    before = "{"
    for number, line in enumerate(text.split("\n")):
        bare = re.sub(r"\s*//.*$", "", line)
        begins = before.endswith((";", "{", "}", ":", ")", "else")) and not before.startswith("#")
        if begins and not re.search(r"\\$|ISO_ASSERT|static_assert|constexpr", bare):
            for form, pattern in FORMS.items():
                found = pattern.match(bare)
                if found and balanced(found["what"]):
                    yield number, form, found
        if bare.strip():
            before = bare.strip()


def changed(expression, draw):
    """Returns (kind, changed expression), or None if nothing applies."""
    places = [(kind, m, to) for kind, what, to in CHANGES for m in re.finditer(what, expression)]
    if not places:
        return None
    kind, place, to = draw.choice(places)
    return kind, expression[:place.start()] + to + expression[place.end():]


def mutant_at(form, found, id, draw):
    """Returns (kind, line with the switch, statement that the mutant has), or None."""
    on, before, what = f"isostep::mutant({id})", found["before"], found["what"]
    if form == "drop":
        return "dropped line", f"{before}{{ if (!{on}) {what}; }}", ""
    made = changed(what, draw)
    if made is None or (form == "declare" and not one_value(what)):
        return None
    kind, other = made
    if form == "return":
        return kind, f"{before}{{ if ({on}) return {other}; return {what}; }}", f"return {other};"
    if form == "assign":
        return kind, f"{before}{{ if ({on}) {found['to']}{other}; else {found['to']}{what}; }}", f"{found['to']}{other};"
    if form == "declare":
        return kind, f"{before}{on} ? ({other}) : ({what});", f"{before.strip()} {other};"
    return kind, f"{before}{on} ? ({other}) : ({what}){found['after']}", f"if ({other})"


def drawn(tree, seed, count, without):
    files = sorted(p for folder in FOLDERS for p in (tree / folder).rglob("*")
                   if p.suffix in (".hpp", ".inl", ".cpp") and not re.search(r"describe/|lanes_(wasm|neon)", str(p)))
    sites = [(p, *site) for p in files for site in sites_of(p.read_text())]
    draw = random.Random(seed)
    draw.shuffle(sites)
    mutants, taken, candidate = [], set(), 0
    for path, number, form, found in sites:
        if len(mutants) == count:
            break
        made = mutant_at(form, found, candidate + 1, random.Random(f"{seed} {path.name} {number}"))
        if made is None or (path, number) in taken:
            continue
        taken.add((path, number))
        candidate += 1
        if candidate in without:
            continue
        kind, line, statement = made
        mutants.append({"id": candidate, "file": str(path.relative_to(tree)), "line": number + 1, "kind": kind,
                        "was": found.string.strip(), "is": statement, "planted": line})
    return mutants


def plant(tree, mutants):
    by_file = {}
    for mutant in mutants:
        by_file.setdefault(tree / mutant["file"], []).append(mutant)
    for path, planted in by_file.items():
        lines = path.read_text().split("\n")
        for mutant in planted:
            lines[mutant["line"] - 1] = mutant["planted"]
        first = next(i for i, line in enumerate(lines) if line.startswith(("#pragma once", "#include")))
        lines.insert(first + lines[first].startswith("#pragma"), f'#include "{SWITCH}"')
        path.write_text("\n".join(lines))
    (tree / "scalar/include" / SWITCH).write_text(SWITCH_TEXT)
    body = tree / "scalar/src/environment.cpp"
    body.write_text(f'#include "{SWITCH}"\n' + body.read_text() + SWITCH_BODY)
    (tree / "mutants.json").write_text(json.dumps(mutants, indent=1))


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("tree", type=pathlib.Path)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--count", type=int, default=60)
    words.add_argument("--without", default="", help="identifiers, with commas between them")
    given = words.parse_args()
    mutants = drawn(given.tree, given.seed, given.count, {int(i) for i in given.without.split(",") if i})
    plant(given.tree, mutants)
    for m in mutants:
        print(f'{m["id"]:3} {m["kind"]:12} {m["file"]}:{m["line"]}\n      {m["was"]}\n      {m["is"]}')


if __name__ == "__main__":
    main()
