#!/usr/bin/env python3
"""Compiles every header of the project alone, with the include path of its part.

usage: compile_headers.py REPOSITORY PARTS_JSON COMPILE_COMMANDS_JSON [JOBS]

The flags are those of a source that includes the header, of its own part where there is one.
Headers that need a library which is not here (OpenCV) are left out and counted.
"""

import json
import os
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True
from check_rooms import Tree, is_header  # noqa: E402


def flags_of(command):
    """A compile command without compiler launcher, source and output."""
    words = shlex.split(command)
    if Path(words[0]).name in ("ccache", "sccache", "distcc"):
        words = words[1:]
    at = words.index("-o")
    words = words[:at] + words[at + 2 :]
    return [word for word in words[: words.index("-c")] if not word.startswith("-M")]


def commands_by_file(tree, database):
    root = tree.root.resolve()
    found = {}
    for entry in json.loads(Path(database).read_text(encoding="utf-8")):
        path = Path(entry["directory"], entry["file"]).resolve()
        if path.is_relative_to(root) and "arguments" not in entry:
            found[path.relative_to(root).as_posix()] = flags_of(entry["command"])
    return found


def best_flags(tree, header, includers, commands):
    """Flags of a source of the header's part, best one that includes it, or of any that does."""
    part = tree.owners[header]
    sources = [file for file in commands if tree.owners.get(file) is part]
    direct = [file for file in includers.get(header, []) if file in commands]
    own = [file for file in direct if file in sources]
    return next((commands[file] for file in own + sources + direct), None)


def needs_opencv(tree, file):
    names = tree.includes(file)
    return any(name.startswith("opencv2/") for _, name in names) or any(
        needs_opencv(tree, found) for _, name in names if (found := tree.resolve(file, name))
    )


def compile_alone(root, header, flags):
    """None, or what the compiler says."""
    command = [*flags, "-fsyntax-only", "-x", "c++", "-"]
    done = subprocess.run(
        command, input=f'#include "{root / header}"\n', capture_output=True, text=True, check=False
    )
    return None if done.returncode == 0 else f"{header} does not compile alone:\n{done.stderr}"


def jobs_of(tree, commands):
    """The headers with their flags, and those that are left out."""
    includers = {}
    for file in tree.files:
        for _, name in tree.includes(file):
            if found := tree.resolve(file, name):
                includers.setdefault(found, []).append(file)
    jobs, left_out = [], []
    for header in filter(is_header, tree.files):
        flags = tree.owners[header] and best_flags(tree, header, includers, commands)
        opencv = any("opencv" in word for word in flags or [])
        if flags and (opencv or not needs_opencv(tree, header)):
            jobs.append((header, flags))
        else:
            left_out.append(header)
    return jobs, left_out


def main():
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    tree = Tree(sys.argv[1], json.loads(Path(sys.argv[2]).read_text(encoding="utf-8")))
    jobs, left_out = jobs_of(tree, commands_by_file(tree, sys.argv[3]))
    workers = int(sys.argv[4]) if len(sys.argv) == 5 else os.cpu_count()
    with ThreadPoolExecutor(workers) as pool:
        results = list(pool.map(lambda job: compile_alone(tree.root.resolve(), *job), jobs))
    faults = [result for result in results if result]
    print("\n".join(faults) or f"{len(jobs)} headers compile alone")
    if left_out:
        print(f"left out, as nothing built here includes them: {' '.join(left_out)}")
    sys.exit(1 if faults or not jobs else 0)


if __name__ == "__main__":
    main()
