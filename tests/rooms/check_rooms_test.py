#!/usr/bin/env python3
"""check_rooms.py finds every kind of fault in a made-up tree, and none where there is none."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
from check_rooms import faults_of  # noqa: E402


def part(name, kind="room", **fields):
    folder = fields.get("folder", f"src/{name}")
    defaults = {"folder": folder, "include": "include", "private": folder}
    lists = {"sources": [f"{name}.cpp"], "headers": [f"{name}.hpp"], "rooms": [], "libraries": []}
    return {"name": name, "kind": kind, **defaults, **lists, **fields}


def lines(*names):
    return "".join(f'#include "{name}"\n' for name in names)


FILES = {
    "include/thermedge/low.hpp": "#include <vector>\n#include <tl/expected.hpp>\n",
    "include/thermedge/mid.hpp": lines("thermedge/low.hpp"),
    "include/thermedge/high.hpp": lines("thermedge/mid.hpp"),
    "src/low/low.cpp": '#include "thermedge/low.hpp"\n#include <hwy/highway.h>\n',
    "src/low/low_rows.hpp": "",
    "src/mid/mid.cpp": lines("thermedge/mid.hpp", "low_rows.hpp", "deep/mid_sums.hpp"),
    "src/mid/deep/mid_sums.hpp": "",
    "src/high/high.cpp": lines("thermedge/high.hpp"),
    "sim/include/thermedge/tool.hpp": "",
    "cli/main.cpp": lines("thermedge/tool.hpp", "thermedge/low.hpp"),
    "tests/mid/mid_test.cpp": lines("low_rows.hpp"),
}


def parts():
    return [
        part("low"),
        part("mid", rooms=["low"]),
        part("high", rooms=["mid"]),
        part("tool", "library", folder="sim", include="sim/include", private="sim/src",
             sources=[], libraries=["thermedge", "png"]),
        part("cli", "program", folder="cli", sources=["main.cpp"], headers=[],
             libraries=["thermedge_tool"]),
        part("tests_mid", "tests", folder="tests/mid", sources=[], headers=[], rooms=["low"],
             libraries=["thermedge"]),
    ]


class CheckRooms(unittest.TestCase):
    def faults(self, changed_files=None, **changed_parts):
        """Faults of the tree with files added, or removed by None, and parts' fields replaced."""
        entries = parts()
        for entry in entries:
            entry.update(changed_parts.get(entry["name"], {}))
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**FILES, **(changed_files or {})}.items():
                if text is not None:
                    path = Path(folder, name)
                    path.parent.mkdir(parents=True, exist_ok=True)
                    path.write_text(text, encoding="utf-8")
            return faults_of(folder, entries)

    def expect_one(self, file, text, faults):
        self.assertEqual(len(faults), 1, faults)
        self.assertTrue(faults[0].startswith(file + ": "), faults[0])
        self.assertIn(text, faults[0])

    def test_a_tree_in_order_has_no_fault(self):
        self.assertEqual(self.faults(), [])

    def test_public_header_of_a_room_that_is_not_named(self):
        faults = self.faults({"src/high/high.cpp": lines("thermedge/mid.hpp", "thermedge/low.hpp")})
        self.expect_one("src/high/high.cpp", "public header of low, which high does not", faults)

    def test_private_header_of_a_room_that_is_not_named(self):
        faults = self.faults({"src/high/high.cpp": lines("low_rows.hpp")})
        self.expect_one("src/high/high.cpp", "a private header of low, which high does not", faults)

    def test_a_path_around_the_include_path_is_seen_too(self):
        faults = self.faults({"src/high/high.cpp": '  #  include "../low/low_rows.hpp"\n'})
        self.expect_one("src/high/high.cpp", "a private header of low, which high does not", faults)

    def test_libraries_give_public_headers_only(self):
        faults = self.faults({"cli/main.cpp": lines("low_rows.hpp")})
        self.expect_one("cli/main.cpp", "a private header of low, which cli does not name", faults)

    def test_a_private_header_may_not_reach_out_either(self):
        faults = self.faults({"src/low/low_rows.hpp": lines("thermedge/mid.hpp")})
        self.expect_one("src/low/low_rows.hpp", "from low to mid would run upwards", faults)

    def test_include_that_runs_upwards(self):
        faults = self.faults({"include/thermedge/low.hpp": "#include <thermedge/high.hpp>\n"})
        self.expect_one("include/thermedge/low.hpp", "from low to high would run upwards", faults)

    def test_declared_arrow_that_runs_upwards_or_in_a_circle(self):
        upwards = {"src/low/low.cpp": lines("thermedge/mid.hpp")}
        faults = self.faults(upwards, low={"rooms": ["mid"]})
        self.expect_one("src/low", "low names mid: the arrow runs upwards", faults)
        faults = self.faults(low={"rooms": ["low"]})
        self.expect_one("src/low", "low names low: the arrow runs", faults)

    def test_declared_arrow_that_nothing_needs(self):
        faults = self.faults(high={"rooms": ["mid", "low"]})
        self.expect_one("src/high", "high names low and includes nothing of it", faults)

    def test_declared_room_that_is_none(self):
        self.expect_one("src/high", "names attic", self.faults(high={"rooms": ["mid", "attic"]}))

    def test_public_header_that_includes_a_private_one(self):
        faults = self.faults({"include/thermedge/mid.hpp": lines("deep/mid_sums.hpp")})
        self.expect_one("include/thermedge/mid.hpp", "header src/mid/deep/mid_sums.hpp", faults)

    def test_public_header_that_shows_another_library(self):
        for name in ("hwy/highway.h", "png.h", "nlohmann/json.hpp", "toml++/toml.h", "tbb/tbb.h"):
            faults = self.faults({"include/thermedge/low.hpp": f"#include <{name}>\n"})
            self.expect_one("include/thermedge/low.hpp", f"<{name}>", faults)

    def test_two_private_headers_of_one_name(self):
        faults = self.faults({"src/high/deep/mid_sums.hpp": ""})
        self.expect_one(
            "src/high/deep/mid_sums.hpp", "same name as src/mid/deep/mid_sums.hpp", faults
        )

    def test_files_that_belong_to_nothing(self):
        faults = self.faults({"src/attic/old.hpp": ""})
        self.expect_one("src/attic/old.hpp", "is in no room", faults)
        faults = self.faults({"src/mid/new.cpp": ""})
        self.expect_one("src/mid/new.cpp", "not in SOURCES of mid", faults)
        faults = self.faults({"include/thermedge/new.hpp": ""})
        self.expect_one("include/thermedge/new.hpp", "is in HEADERS of no room", faults)

    def test_public_header_of_two_rooms_or_of_none_on_disk(self):
        faults = self.faults(high={"headers": ["high.hpp", "mid.hpp"]})
        self.assertTrue(any("is in HEADERS of mid and of high" in fault for fault in faults))
        faults = self.faults(mid={"headers": ["mid.hpp", "gone.hpp"]})
        self.expect_one("include/thermedge/gone.hpp", "there is no such file", faults)

    def test_header_that_is_nowhere(self):
        faults = self.faults({"src/high/high.cpp": lines("thermedge/mid.hpp", "gone.hpp")})
        self.expect_one("src/high/high.cpp", 'includes "gone.hpp": no part has this header', faults)


if __name__ == "__main__":
    unittest.main()
