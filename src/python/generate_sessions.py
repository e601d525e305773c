"""Reads sessions and networks from isostep.h, where they are written by hand, into isostep/sessions.json: structs,
enumerations and functions in the form of interface.json.

usage: generate_sessions.py ISOSTEP_H [OUT]    without OUT: to standard output
"""

# SPDX-License-Identifier: MIT
import json
import re
import sys

_SIZES = {"uint8_t": 1, "char": 1, "uint16_t": 2, "uint32_t": 4, "int32_t": 4, "uint64_t": 8, "int64_t": 8}
_KINDS = {"uint8_t": "u8", "char": "char", "uint16_t": "u16", "uint32_t": "u32", "int32_t": "i32", "uint64_t": "u64",
          "int64_t": "i64"}
# What the names of an enumeration begin with, where it is more than ISO_.
_PREFIXES = {"iso_event_kind": "ISO_EVENT_", "iso_phase": "ISO_PHASE_", "iso_proposal": "ISO_VOTE_",
             "iso_recording": "ISO_RECORD_"}


def enums_of(text):
    made = []
    for name, body in re.findall(r"typedef uint32_t (iso_\w+);\s*enum \{([^}]*)\}", text):
        values, number = [], 0
        for item in filter(None, (one.strip() for one in body.split(","))):
            word, _, told = (part.strip() for part in item.partition("="))
            number = int(told, 0) if told else number
            prefix = _PREFIXES.get(name, "ISO_")
            base = word.removeprefix(prefix if word.startswith(prefix) else "ISO_").lower()
            values.append({"name": word, "base": base, "value": number})
            number += 1
        made.append({"name": name, "flags": False, "values": values})
    return made


def structs_of(text, enums):
    made = []
    for name, body in re.findall(r"typedef struct (iso_\w+) \{([^}]*)\} \w+;", text):
        if "(*" in body:  # callbacks: session.py
            continue
        members, end, align = [], 0, 1
        for c_type, member, count in re.findall(r"(\w+)\s+(\w+)(?:\[(\d+)\])?;", body):
            size = 4 if c_type in enums else _SIZES[c_type]
            end += -end % size
            align = max(align, size)
            one = {"name": member, "kind": "enum" if c_type in enums else _KINDS[c_type]}
            if c_type in enums:
                one["of"] = c_type
            if count:
                one["count"] = int(count)
            members.append({**one, "offset": end, "size": size * int(count or 1)})
            end += size * int(count or 1)
        sized = members[0]["name"] == "size" and members[0]["kind"] == "u32"
        made.append({"name": name, "base": name.removeprefix("iso_"), "family": "", "sized": sized,
                     "size": end + -end % align, "align": align, "members": members})
    return made


def functions_of(text):
    made = []
    for returns, name, arguments in re.findall(r"ISO_API ([\w\s*]+?)(iso_\w+)\(([^;]*)\);", text):
        listed = []
        for argument in arguments.split(","):
            c_type, argument_name = re.fullmatch(r"(.*?)(\w+)", " ".join(argument.split())).groups()
            listed.append({"name": argument_name, "type": c_type.strip()})
        made.append({"name": name, "returns": returns.strip(), "family": "", "arguments": listed})
    return made


def describe(header):
    """The description of the part of isostep.h between its marks."""
    text = re.search(r"/\* Sessions \*/(.*)/\* End of sessions \*/", header, re.S).group(1)
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    enums = enums_of(text)
    structs = structs_of(text, {one["name"] for one in enums})
    return {"enums": enums, "structs": structs, "functions": functions_of(text)}


def rows(values):
    return ",\n".join(json.dumps(value) for value in values)


def main(header, out=None):
    with open(header, encoding="utf-8") as file:
        described = describe(file.read())
    text = "{\n" + ",\n".join(f'"{key}": [\n{rows(values)}\n]' for key, values in described.items()) + "\n}\n"
    with open(out, "w", encoding="utf-8") if out else sys.stdout as file:
        file.write(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
