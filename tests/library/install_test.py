#!/usr/bin/env python3
"""install_test.py BUILD WORK DRAW_MARKER CXX CC VERSION: installs the library and builds programs that know nothing but it.

The C++ example finds it through its CMake package, the C example through pkg-config, and both must find the marker.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import unittest

BUILD, WORK, DRAW_MARKER, CXX, CC, VERSION = sys.argv[1:]
HERE = pathlib.Path(__file__).resolve().parent
WORK = pathlib.Path(WORK)
PREFIX = WORK / "prefix"
STRICT = ["-Wall", "-Wextra", "-Wconversion", "-Werror"]

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(outside LANGUAGES CXX)
find_package(onestroke {version} CONFIG REQUIRED)
add_executable(example {source})
target_link_libraries(example PRIVATE onestroke::onestroke)
"""


def run(*command, **environment):
    done = subprocess.run(
        [str(word) for word in command], env=os.environ | environment, capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        raise AssertionError(f"{command} failed with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def pkg_config(*options):
    (file,) = PREFIX.rglob("onestroke.pc")
    return run("pkg-config", *options, "onestroke", PKG_CONFIG_PATH=str(file.parent)).split()


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        run("cmake", "--install", BUILD, "--prefix", PREFIX)
        run(DRAW_MARKER, WORK)
        cls.fov, cls.id, *cls.truth = (float(word) for word in (WORK / "truth.txt").read_text(encoding="utf-8").split())

    def expect_marker(self, program, **environment):
        output = run(program, WORK / "catalog.json", WORK / "picture.ppm", self.fov, **environment)
        lines = output.splitlines()
        self.assertEqual(len(lines), 1, output)
        found, name, *translation = lines[0].split()
        self.assertEqual((int(found), name), (self.id, "seven"))
        for value, true_value in zip(translation, self.truth, strict=True):
            self.assertAlmostEqual(float(value), true_value, delta=1.5)

    def library_folder(self):
        (library,) = PREFIX.rglob("libonestroke.so")
        return library.parent

    def test_a_cmake_project_finds_the_package(self):
        outside = WORK / "outside"
        outside.mkdir()
        project = PROJECT.format(version=VERSION, source=HERE / "example.cpp")
        (outside / "CMakeLists.txt").write_text(project, encoding="utf-8")
        run("cmake", "-S", outside, "-B", outside / "build", f"-DCMAKE_PREFIX_PATH={PREFIX}",
            f"-DCMAKE_CXX_COMPILER={CXX}", f"-DCMAKE_CXX_FLAGS={' '.join(STRICT)}")
        run("cmake", "--build", outside / "build")
        self.expect_marker(outside / "build/example")

    def test_a_c_program_is_built_with_pkg_config(self):
        program = WORK / "c_example"
        run(CC, "-std=c99", "-pedantic", *STRICT, HERE / "example.c", "-o", program,
            *pkg_config("--cflags", "--libs"))
        self.expect_marker(program, LD_LIBRARY_PATH=str(self.library_folder()))
        self.assertEqual(pkg_config("--modversion"), [VERSION])

    def test_a_cpp_program_is_built_with_pkg_config(self):
        program = WORK / "cpp_example"
        run(CXX, "-std=c++20", *STRICT, HERE / "example.cpp", "-o", program, *pkg_config("--cflags", "--libs"))
        self.expect_marker(program, LD_LIBRARY_PATH=str(self.library_folder()))

    def test_a_moved_prefix_still_works(self):
        moved = WORK / "moved"
        shutil.copytree(PREFIX, moved, symlinks=True)
        (file,) = moved.rglob("onestroke.pc")
        flags = run("pkg-config", "--cflags", "--libs", "onestroke", PKG_CONFIG_PATH=str(file.parent))
        for flag in flags.split():
            if flag[:2] in ("-I", "-L"):
                self.assertTrue(pathlib.Path(flag[2:]).resolve().is_relative_to(moved.resolve()), flag)

    def test_nothing_but_the_interface_is_installed(self):
        headers = sorted(file.relative_to(PREFIX / "include").as_posix() for file in PREFIX.rglob("*.h"))
        self.assertEqual(headers, ["onestroke/onestroke.h", "onestroke/onestroke_c.h"])
        programs = [file.name for file in PREFIX.rglob("*") if "bin" in file.parts]
        self.assertEqual(programs, [])

    def test_nothing_but_the_interface_is_exported(self):
        names = run("nm", "--dynamic", "--defined-only", "--demangle", "--format=posix",
                    self.library_folder() / "libonestroke.so").splitlines()
        self.assertTrue(names)
        for name in names:
            self.assertTrue(name.startswith(("onestroke_", "onestroke::MarkerTracker::")), name)
            self.assertNotIn("Impl::", name)


unittest.main(argv=sys.argv[:1])
