#!/usr/bin/env python3
"""Every JSON that the program writes against its schema, and the examples of docs/output.md.

usage: check_outputs.py PROGRAM SCHEMA_DIRECTORY OUTPUT_MD
Exit code 77 where Python's jsonschema (Debian: python3-jsonschema) is missing.
"""
import copy
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    SYSTEM_PYTHON = "/usr/bin/python3"
    if os.path.exists(SYSTEM_PYTHON) and "THERMEDGE_CHECK_AGAIN" not in os.environ:
        os.environ["THERMEDGE_CHECK_AGAIN"] = "1"
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])
    print("skipped: Python has no jsonschema (Debian: python3-jsonschema)")
    sys.exit(77)

SMALL = "'sim:desk?width=96&height=72&frames=3'"
ALL_POINTS = "--points position,normal,strength,sigma --all-edges"

# Shell commands; the schema of each, and the file with the JSON; none: standard output.
OUTPUTS = [
    ("frame", f"thermedge detect {SMALL} -o -", None),
    ("frame", f"thermedge detect {SMALL} -o x.jsonl {ALL_POINTS} --keep 5", "x.jsonl"),
    ("frame", f"thermedge detect {SMALL} --preset fast -o - --points position --min-contrast 5sigma", None),
    ("frame", f"thermedge detect {SMALL} --preset paper -o - {ALL_POINTS} --set selection.keep_edges=3", None),
    ("frame", "thermedge detect 'sim:empty?width=64&height=48&sigma=0' -o one.json", "one.json"),
    ("frame", f"thermedge detect {SMALL} --sigma 4 --denoise none -o d --write json,mask --all-edges",
     "d/json/desk_0002.json"),
    ("frame", "thermedge trace d/mask/desk_0000.png -o - " + ALL_POINTS, None),
    ("frame", "thermedge trace d/mask/desk_0000.png --preset paper -o -", None),
    ("frame", "thermedge denoise 'sim:desk?width=96&height=72' -o f.npy --quiet && "
              "thermedge detect f.npy -o -", None),
    ("frame", f"thermedge track {SMALL} -o -", None),
    ("frame", "thermedge track 'sim:corridor?width=96&height=72&frames=9&freeze_every=3&freeze_frames=2' -o t.jsonl",
     "t.jsonl"),
    ("scale", f"thermedge scale {SMALL} --stable -o v", "v/scale.jsonl"),
    ("truth", "thermedge simulate office -o s --frames 6 --set width=96 --set height=72 "
              "--set shutter_every=3 --set shutter_frames=2", "s/truth.jsonl"),
    ("truth", "thermedge simulate desk -o t --frames 6 --set width=96 --set height=72 --set box=1 "
              "--set freeze_every=3 --set freeze_frames=1 --set drop_every=4 --set drop_frames=1",
     "t/truth.jsonl"),
    ("probe", f"thermedge probe {SMALL} --json", None),
    ("probe", f"thermedge probe {SMALL} --preset paper --camera lepton --json", None),
    ("probe", "thermedge probe d/mask/desk_0000.png --json", None),
    ("bench", f"thermedge bench {SMALL} --seconds 0 --json", None),
    ("evaluation", f"thermedge detect {SMALL} -o e --write strength --quiet && "
                   "thermedge evaluate e/strength d/mask --json", None),
    ("evaluation", "thermedge evaluate d/mask d/mask -o e.json", "e.json"),
    ("evaluation", "thermedge evaluate x.jsonl --json", None),
    ("evaluation", "thermedge detect 'sim:office?camera=pi450&path=hand&width=96&height=72&frames=6' "
                   "-o y.jsonl --quiet && thermedge evaluate y.jsonl s/truth.jsonl --json", None),
    ("evaluation", "thermedge evaluate --tracks y.jsonl s/truth.jsonl --least-frames 1 --json", None),
    ("evaluation", "thermedge evaluate --tracks y.jsonl --json", None),
    ("log", f"thermedge detect missing.png {SMALL} -o q --json-log 2>&1", None),
    ("log", "thermedge scale 'sim:desk?width=96&height=72' -o w.png --gain 3 --json-log 2>&1", None),
]


def strict(schema):
    """The schema without room for fields that it does not name."""
    if isinstance(schema, dict):
        made = {key: strict(value) for key, value in schema.items()}
        if "properties" in made:
            made.setdefault("additionalProperties", False)
        return made
    return [strict(item) for item in schema] if isinstance(schema, list) else schema


class Checker:
    def __init__(self, program, schema_directory, work):
        self.work = pathlib.Path(work)
        self.path = os.path.dirname(os.path.abspath(program)) + os.pathsep + os.environ["PATH"]
        self.validators = {}
        self.failures = []
        for path in sorted(pathlib.Path(schema_directory).glob("*.schema.json")):
            schema = json.loads(path.read_text())
            jsonschema.Draft202012Validator.check_schema(schema)
            self.validators[path.name.split(".")[0]] = jsonschema.Draft202012Validator(strict(schema))

    def run(self, command):
        done = subprocess.run(["bash", "-c", command], cwd=self.work, stdout=subprocess.PIPE,
                              env={**os.environ, "PATH": self.path}, text=True, check=False)
        return done.stdout

    def fail(self, what):
        self.failures.append(what)
        print("FAILED:", what)

    def check(self, schema, command, file):
        text = self.run(command)
        if file:
            text = (self.work / file).read_text()
        lines = text.splitlines()
        if not lines:
            self.fail(f"{command}: wrote nothing")
        documents = []
        for line in lines:
            document = json.loads(line)
            documents.append(document)
            for error in self.validators[schema].iter_errors(document):
                place = "/".join(map(str, error.absolute_path))
                self.fail(f"{command}: {place}: {error.message[:200]}")
        return documents

    def check_that_it_can_fail(self, schema, document):
        """A field that is missing, extra, or of another type is refused."""
        validator = self.validators[schema]
        required = validator.schema.get("required", [])
        broken = []
        for key in document:
            other = copy.deepcopy(document)
            other[key] = {"of another": "type"}
            broken.append((key + " of another type", other))
            if key in required:
                broken.append((key + " missing", {k: v for k, v in document.items() if k != key}))
        broken.append(("an extra field", {**document, "extra": 1}))
        for what, other in broken:
            if validator.is_valid(other):
                self.fail(f"the schema {schema} accepts {what}")

    def check_lengths(self, frame):
        """What a schema cannot say: lists of one length, indices within them."""
        dropped = frame.get("dropped_edges", [])
        edges = frame["edges"] + dropped
        for edge in edges:
            count = len(edge["points"])
            for key in ("normals", "strength_counts_per_px", "position_sigma_px"):
                if edge.get(key) is not None and len(edge[key]) != count:
                    self.fail(f"{frame['source']}: {key} has another length than points")
            if any(corner >= count for corner in edge["corners"]):
                self.fail(f"{frame['source']}: a corner is none of the points")
        if "dropped_edges" in frame:
            if len(edges) != frame["stats"]["edges_found"]:
                self.fail(f"{frame['source']}: not all edges are there")
            for reason, count in frame["stats"]["edges_dropped"].items():
                if sum(edge["reason"] == reason for edge in dropped) != count:
                    self.fail(f"{frame['source']}: not {count} edges are {reason}")

    def check_example(self, command, wanted, is_json):
        found = self.run(command)
        if is_json:
            good = matches(json.loads(wanted), json.loads(found))
        else:
            good = found.strip() == wanted.strip()
        if not good:
            self.fail(f"docs/output.md: {command} gives\n{found[:3000]}")


def matches(wanted, found):
    """"..." stands for anything, at the end of a list for any number of items."""
    if wanted == "...":
        return True
    if isinstance(wanted, dict):
        return (isinstance(found, dict) and wanted.keys() == found.keys() and
                all(matches(wanted[key], found[key]) for key in wanted))
    if isinstance(wanted, list) and isinstance(found, list):
        if wanted and wanted[-1] == "...":
            wanted = wanted[:-1]
            found = found[:len(wanted)]
        return len(wanted) == len(found) and all(map(matches, wanted, found))
    return type(wanted) is type(found) and wanted == found


def examples(page):
    """Pairs of a command and what it prints."""
    pattern = r"```sh\n(thermedge [^`]*?)\n```\n+```(json|text)\n(.*?)\n```"
    return re.findall(pattern, page, re.DOTALL)


def main():
    program, schema_directory, page = sys.argv[1:]
    with tempfile.TemporaryDirectory() as work:
        checker = Checker(program, schema_directory, work)
        seen = {}
        for schema, command, file in OUTPUTS:
            for document in checker.check(schema, command, file):
                seen.setdefault(schema, document)
                if schema == "frame":
                    checker.check_lengths(document)
        for schema in checker.validators:
            if schema not in seen:
                checker.fail(f"no output was checked against the schema {schema}")
            else:
                checker.check_that_it_can_fail(schema, seen[schema])
        found = examples(pathlib.Path(page).read_text())
        if len(found) < 3:
            checker.fail(f"{page}: holds {len(found)} examples")
        for command, kind, text in found:
            checker.check_example(command, text, kind == "json")
        print(f"{len(OUTPUTS)} outputs and {len(found)} examples checked, "
              f"{len(checker.failures)} failures")
        return 1 if checker.failures else 0


if __name__ == "__main__":
    sys.exit(main())
