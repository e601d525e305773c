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
FORMS = {
    "return": re.compile(r"^(\s+)return ([^{}]+);$"),
    "assign": re.compile(r"^(\s+)(" + LVALUE + r" [-+*|&]?= )([^={};][^{};]*);$"),
    "declare": re.compile(r"^(\s+(?:const )?[A-Za-z_][\w:<>]* \w+ = )([^{};]+);$"),
    "if": re.compile(r"^(\s+(?:\} else )?if \()([^{};]+)(\)(?: \{| [^{}]*;)?)$"),
    "drop": re.compile(r"^(\s+)(" + LVALUE + r"(?: [-+*|&]?= [^{};]+|\([^{};]*\)));$"),
}


def balanced(text):
    depth = 0
    for c in text:
        depth += (c in "([") - (c in ")]")
        if depth < 0:
            return False
    return depth == 0


def sites_of(path, text):
    """Yields (line number, form, match) for each statement of one line that is not a macro's."""
    before = "{"
    for number, line in enumerate(text.split("\n")):
        bare = re.sub(r"\s*//.*$", "", line)
        begins = before.endswith((";", "{", "}", ":", ")", "else")) and not before.startswith("#")
        if begins and not bare.endswith("\\") and "ISO_ASSERT" not in bare and "static_assert" not in bare:
            for form, pattern in FORMS.items():
                found = pattern.match(bare)
                if found and all(balanced(part) for part in found.groups()[1 if form != "declare" else 0:] if form != "if") \
                        and (form != "if" or balanced(found.group(2))) and "constexpr" not in bare:
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
    on = f"isostep::mutant({id})"
    if form == "drop":
        indent, statement = found.groups()
        return "dropped line", f"{indent}{{ if (!{on}) {statement}; }}", ""
    expression = found.groups()[-1] if form in ("return", "assign", "declare") else found.group(2)
    made = changed(expression, draw)
    if made is None or (form == "declare" and not one_value(expression)):
        return None
    kind, other = made
    if form == "return":
        return kind, f"{found.group(1)}{{ if ({on}) return {other}; return {expression}; }}", f"return {other};"
    if form == "assign":
        indent, to = found.group(1), found.group(2)
        return kind, f"{indent}{{ if ({on}) {to}{other}; else {to}{expression}; }}", f"{to}{other};"
    if form == "declare":
        return kind, f"{found.group(1)}{on} ? ({other}) : ({expression});", f"{found.group(1).strip()} {other};"
    return kind, f"{found.group(1)}{on} ? ({other}) : ({expression}){found.group(3)}", f"if ({other})"


def one_value(expression):
    """Returns false for `a = 1, b = 2`: a comma outside of brackets."""
    depth = 0
    for c in expression:
        depth += (c in "([") - (c in ")]")
        if c == "," and depth <= 0:
            return False
    return True


def drawn(tree, seed, count, without):
    files = sorted(p for folder in FOLDERS for p in (tree / folder).rglob("*")
                   if p.suffix in (".hpp", ".inl", ".cpp") and not re.search(r"describe/|lanes_(wasm|neon)", str(p)))
    sites = [(p, *site) for p in files for site in sites_of(p, p.read_text())]
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
