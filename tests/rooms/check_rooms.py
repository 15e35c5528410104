#!/usr/bin/env python3
"""Checks that every file includes only what its part of the project may include.

usage: check_rooms.py REPOSITORY PARTS_JSON

PARTS_JSON is the table that CMake writes from the calls of thermedge_room, thermedge_library,
thermedge_part and thermedge_tests, lowest part first. Prints one line per fault and ends with 1
where there is one.
"""

import json
import re
import sys
from pathlib import Path

FOLDERS = ("include", "src", "sim", "eval", "figures", "cli", "bench", "tests")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]', re.MULTILINE)
# What a public header may include beside the standard library and the public headers.
OUTSIDE_IN_PUBLIC = {"tl/expected.hpp"}
# CMake writes these into the build folder; every part may include them.
GENERATED = {"thermedge/version.hpp"}


class Part:
    """A room, a library, a program or a folder of tests, as CMake declares it."""

    def __init__(self, entry, place):
        self.name = entry["name"]
        self.kind = entry["kind"]
        self.place = place  # in the order of the layers, lowest first
        self.folder = entry["folder"]
        self.include = entry["include"]
        self.private = entry["private"]
        self.sources = entry["sources"]
        self.headers = ["thermedge/" + header for header in entry["headers"]]
        self.rooms = entry["rooms"]
        self.libraries = entry["libraries"]


class Tree:
    """The parts and the files of a repository."""

    def __init__(self, root, entries):
        self.root = Path(root)
        self.parts = [Part(entry, place) for place, entry in enumerate(entries)]
        self.by_name = {part.name: part for part in self.parts}
        self.faults = []
        self.files = sorted(
            path.relative_to(self.root).as_posix()
            for folder in FOLDERS
            for path in (self.root / folder).rglob("*")
            if path.suffix in (".hpp", ".h", ".cpp", ".cc")
        )
        self.public = self._public_headers()
        self.owners = {file: self._owner(file) for file in self.files}
        self.private = self._private_headers()

    def fault(self, file, text):
        self.faults.append(f"{file}: {text}")

    def _public_headers(self):
        """File of each public header -> (name in an #include, part)."""
        found = {}
        for part in self.parts:
            for name in part.headers:
                file = f"{part.include}/{name}"
                if file in found:
                    other = found[file][1].name
                    self.fault(file, f"is in HEADERS of {other} and of {part.name}")
                found[file] = (name, part)
                if not (self.root / file).is_file():
                    self.fault(file, f"is in HEADERS of {part.name}, but there is no such file")
        return found

    def _owner(self, file):
        if file in self.public:
            return self.public[file][1]
        inside = [part for part in self.parts if file.startswith(part.folder + "/")]
        return max(inside, key=lambda part: len(part.folder), default=None)

    def _private_headers(self):
        """Name in an #include -> files."""
        found = {}
        for file, part in self.owners.items():
            if part and is_header(file) and not self.is_public(file):
                name = file.removeprefix(part.private + "/")
                found.setdefault(name, []).append(file)
        return found

    def is_public(self, file):
        """Whether the file lies where programs that use the library find it."""
        return file.startswith("include/") or "/include/thermedge/" in file

    def includes(self, file):
        """The pairs (bracket or quote, name) of a file."""
        text = (self.root / file).read_text(encoding="utf-8")
        return [match.groups() for match in INCLUDE.finditer(text)]

    def resolve(self, file, name):
        """The file that `file` gets by #include "name", or None."""
        for public, (public_name, _) in self.public.items():
            if public_name == name:
                return public
        beside = (Path(file).parent / name).as_posix()
        parts = []
        for step in beside.split("/"):
            parts = parts[:-1] if step == ".." else parts + [step]
        if "/".join(parts) in self.owners:
            return "/".join(parts)
        files = self.private.get(name, [])
        own = [found for found in files if self.owners[found] is self.owners[file]]
        return (own or files or [None])[0]

    def published(self, libraries):
        """The parts whose public headers come with these libraries."""
        found = set()
        for library in libraries:
            if library == "thermedge":
                found |= {part.name for part in self.parts if part.kind == "room"}
            name = library.removeprefix("thermedge_")
            if library != name and name in self.by_name and name not in found:
                found |= {name} | self.published(self.by_name[name].libraries)
        return found


def is_header(file):
    return file.endswith((".hpp", ".h"))


def check_files(tree):
    """Every file is in a part, every source in its part's list, every public header in one."""
    for file, part in tree.owners.items():
        if tree.is_public(file) and file not in tree.public:
            tree.fault(file, "is in HEADERS of no room or library")
        elif part is None and file.startswith("src/"):
            tree.fault(file, "is in no room")
        elif part and part.sources and not is_header(file):
            if file.removeprefix(part.folder + "/") not in part.sources:
                tree.fault(file, f"is not in SOURCES of {part.name}")
    for name, files in tree.private.items():
        if len(files) > 1:
            tree.fault(files[0], f"has the same name as {' and '.join(files[1:])}")


def check_arrows(tree):
    """Declared arrows point down, so that there is no circle, and each is used."""
    used = {part.name: set() for part in tree.parts}
    for file, part in tree.owners.items():
        if part:
            targets = (tree.resolve(file, name) for _, name in tree.includes(file))
            used[part.name] |= {owner.name for t in targets if (owner := tree.owners.get(t))}
    for part in tree.parts:
        for name in part.rooms + sorted(tree.published(part.libraries)):
            if name not in tree.by_name:
                tree.fault(part.folder, f"names {name}, which is no room, library or program")
            elif tree.by_name[name].place >= part.place:
                tree.fault(part.folder, f"{part.name} names {name}: the arrow runs upwards")
            elif part.kind == "room" and name not in used[part.name]:
                tree.fault(part.folder, f"{part.name} names {name} and includes nothing of it")


def check_public_header(tree, file):
    for bracket, name in tree.includes(file):
        if bracket == "<" and not name.startswith("thermedge/"):
            if re.search(r"[./]", name) and name not in OUTSIDE_IN_PUBLIC:
                tree.fault(file, f"public header includes <{name}>, which users need not have")
        elif (found := tree.resolve(file, name)) and not tree.is_public(found):
            tree.fault(file, f"public header includes the private header {found}")


def check_include(tree, file, name):
    part = tree.owners[file]
    found = tree.resolve(file, name)
    target = tree.owners.get(found)
    if target is None:
        tree.fault(file, f'includes "{name}": no part has this header')
        return
    allowed = {part.name} | set(part.rooms)
    if tree.is_public(found):
        allowed |= tree.published(part.libraries)
    if target.name in allowed:
        return
    which = "public" if tree.is_public(found) else "private"
    if target.place > part.place:
        reason = f"and the arrow from {part.name} to {target.name} would run upwards"
    else:
        reason = f"which {part.name} does not name"
    tree.fault(file, f'includes "{name}", a {which} header of {target.name}, {reason}')


def check_includes(tree):
    for file, part in tree.owners.items():
        if part is None:
            continue
        if tree.is_public(file):
            check_public_header(tree, file)
        for bracket, name in tree.includes(file):
            if name not in GENERATED and (bracket == '"' or name.startswith("thermedge/")):
                check_include(tree, file, name)


def faults_of(root, entries):
    tree = Tree(root, entries)
    check_files(tree)
    check_arrows(tree)
    check_includes(tree)
    return tree.faults


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    entries = json.loads(Path(sys.argv[2]).read_text(encoding="utf-8"))
    faults = faults_of(sys.argv[1], entries)
    print("\n".join(faults) or f"{len(entries)} parts: every include is one that its part names")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
