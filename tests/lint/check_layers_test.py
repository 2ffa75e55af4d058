#!/usr/bin/env python3
"""Gives check_layers.py small trees with one fault each, and one without."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).with_name("check_layers.py")


def check(files):
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = pathlib.Path(root) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, CHECK, root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


class CheckLayers(unittest.TestCase):
    def expect_fault(self, name, text, message):
        code, output = check({name: text})
        self.assertEqual(code, 1, output)
        self.assertIn(message, output)

    def test_a_sound_tree_passes(self):
        code, output = check(
            {
                "engine/marker/a.cpp": '#include "core/pose.h"\n#include <vector>\n',
                "engine/tracking/b.cpp": '#include "marker/a.h"\n#include <opencv2/core.hpp>\n#include <Eigen/Core>\n',
                "platform/display/c.cpp": "#include <GLFW/glfw3.h>\n#include <vulkan/vulkan.h>\n",
                "app/d.cpp": '#include "tracking/b.h"\n#include "render/e.h"\n',
            }
        )
        self.assertEqual(code, 0, output)

    def test_tracking_and_render_never_meet(self):
        self.expect_fault("engine/tracking/a.cpp", '#include "render/b.h"\n', "engine/tracking must not include render/b.h")
        self.expect_fault("engine/render/a.h", '#include "tracking/b.h"\n', "engine/render must not include")

    def test_nothing_includes_upwards(self):
        self.expect_fault("engine/core/a.h", '#include "marker/b.h"\n', "a.h:1: engine/core must not include marker/b.h")
        self.expect_fault("engine/scene/a.h", '\n#include "camera/b.h"\n', "a.h:2: engine/scene must not include")
        self.expect_fault("platform/camera/a.h", '#include "app/b.h"\n', "platform/camera must not include")

    def test_large_libraries_stay_in_their_rooms(self):
        self.expect_fault("engine/scene/a.cpp", "#include <opencv2/core.hpp>\n", "OpenCV does not belong")
        self.expect_fault("app/a.cpp", "#  include <Eigen/Core>\n", "Eigen does not belong")
        self.expect_fault("engine/tracking/a.cpp", "#include <glm/vec3.hpp>\n", "GLM does not belong")
        self.expect_fault("engine/scene/a.cpp", "#include <vulkan/vulkan.hpp>\n", "Vulkan does not belong")
        self.expect_fault("engine/render/a.cpp", "#include <GLFW/glfw3.h>\n", "GLFW does not belong")
        self.expect_fault("app/a.cpp", "#include <openxr/openxr.h>\n", "OpenXR does not belong")

    def test_the_library_knows_the_tracker_and_nothing_above(self):
        sound = {"engine/library/a.cpp": '#include "tracking/tracker.h"\n#include "library/onestroke.h"\n'}
        self.assertEqual(check(sound)[0], 0)
        self.expect_fault("engine/library/a.cpp", '#include "camera/b.h"\n', "engine/library must not include camera/b.h")
        self.expect_fault("engine/tracking/a.cpp", '#include "library/b.h"\n', "engine/tracking must not include")
        self.expect_fault("engine/library/a.cpp", "#include <opencv2/core.hpp>\n", "OpenCV does not belong")

    def test_installed_headers_stand_alone(self):
        for name in ("engine/library/onestroke.h", "engine/library/onestroke_c.h"):
            self.assertEqual(check({name: "#include <stdint.h>\n"})[0], 0)
            self.expect_fault(name, '#include "core/pose.h"\n', "an installed header must not include core/pose.h")
            self.expect_fault(name, '#include "export.h"\n', "an installed header must not include export.h")

    def test_paths_out_of_the_folder_are_faults(self):
        self.expect_fault("engine/core/a.cpp", '#include "../marker/b.h"\n', "leaves the folder")

    def test_long_files_are_faults(self):
        self.expect_fault("tests/unit/core/a.cpp", "\n" * 401, "401 lines")
        self.assertEqual(check({"tests/unit/core/a.cpp": "\n" * 400})[0], 0)

    def test_an_empty_tree_is_a_fault(self):
        self.assertNotEqual(check({})[0], 0)


unittest.main()
