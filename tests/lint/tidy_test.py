#!/usr/bin/env python3
"""Asks tidy.py which of a few small sources it puts together."""

import pathlib
import tempfile
import unittest

import tidy

SOUND = """namespace onestroke {
namespace {

int twice(int x) {
  return 2 * x;
}

}  // namespace
}  // namespace onestroke
"""


class Groups(unittest.TestCase):
    def groups(self, files, flags=lambda name: "-I."):
        with tempfile.TemporaryDirectory() as root:
            for name, text in files.items():
                (pathlib.Path(root) / name).write_text(text, encoding="utf-8")
            entries = [
                {"file": f"{root}/{name}", "command": f"c++ -I{root} {flags(name)} -O2 -c {name}"}
                for name in files
                if name.endswith(".cpp")
            ]
            return [sorted(pathlib.Path(source).name for source in group.sources) for group in tidy.groups(entries)]

    def test_sources_that_do_not_meet_stand_together(self):
        other = SOUND.replace("twice", "thrice")
        self.assertEqual(self.groups({"a.cpp": SOUND, "b.cpp": other}), [["a.cpp", "b.cpp"]])

    def test_equal_private_names_stand_apart(self):
        for text in ("int twice = 2;", "struct twice {", "using twice = int;", "constexpr int one = 1, twice = 2;"):
            other = SOUND.replace("int twice(int x) {\n  return 2 * x;\n}", text)
            self.assertEqual(self.groups({"a.cpp": SOUND, "b.cpp": other}), [["a.cpp"], ["b.cpp"]], text)

    def test_a_name_of_a_header_further_in_stands_apart(self):
        files = {
            "a.cpp": SOUND,
            "b.cpp": '#include "b.h"\n',
            "b.h": '#include "c.h"\n',
            "c.h": "namespace onestroke {\nint twice(int x);\n}  // namespace onestroke\n",
        }
        self.assertEqual(self.groups(files), [["a.cpp"], ["b.cpp"]])

    def test_other_definitions_stand_apart(self):
        flags = {"a.cpp": "-DONE", "b.cpp": "-DTWO"}.get
        self.assertEqual(self.groups({"a.cpp": "", "b.cpp": ""}, flags), [["a.cpp"], ["b.cpp"]])

    def test_optimisation_does_not_matter(self):
        flags = {"a.cpp": "-O3 -fno-math-errno", "b.cpp": "-fPIC"}.get
        self.assertEqual(self.groups({"a.cpp": "", "b.cpp": ""}, flags), [["a.cpp", "b.cpp"]])

    def test_no_group_is_too_large(self):
        files = {f"{index}.cpp": "" for index in range(tidy.MOST_SOURCES + 1)}
        self.assertEqual(sorted(map(len, self.groups(files))), [1, tidy.MOST_SOURCES])


if __name__ == "__main__":
    unittest.main()
