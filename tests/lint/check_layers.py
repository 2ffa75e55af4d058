#!/usr/bin/env python3
"""check_layers.py ROOT: says where an include goes against the layers, or a source file is too long.

Exit code 0 where all is well, 1 with one line a fault.
"""

import pathlib
import re
import sys

LONGEST = 400

# Which modules a module may include; the arrows of the design.
ARROWS = {
    "engine/core": {"core"},
    "engine/marker": {"core", "marker"},
    "engine/tracking": {"core", "marker", "tracking"},
    "engine/library": {"core", "marker", "tracking", "library"},
    "engine/scene": {"core", "scene"},
    "engine/render": {"core", "scene", "render", "shaders"},
    "platform/camera": {"core", "marker", "camera"},
    "platform/display": {"core", "scene", "render", "display"},
    "shaders": {"shaders"},
    "app": {"core", "marker", "tracking", "scene", "render", "camera", "display", "app"},
}
MODULES = set().union(*ARROWS.values())

# Headers that are installed alone: they include nothing but the language's own.
INSTALLED = {"engine/library/onestroke.h", "engine/library/onestroke_c.h"}

# Where the headers of a large library may appear.
ROOMS = {
    "OpenCV": (re.compile(r"opencv2?/"), {"engine/tracking", "platform/camera", "platform/display"}),
    "Eigen": (re.compile(r"Eigen/"), {"engine/tracking", "platform/camera", "platform/display"}),
    "GLM": (re.compile(r"glm/"), {"engine/scene", "engine/render", "shaders", "app"}),
    "Vulkan": (re.compile(r"vulkan/"), {"engine/render", "platform/display"}),
    "Dear ImGui": (re.compile(r"imgui(_internal)?\.h"), {"engine/render", "app"}),
    "Assimp": (re.compile(r"assimp/"), {"engine/scene"}),
    "meshoptimizer": (re.compile(r"meshoptimizer"), {"engine/scene"}),
    "GLFW": (re.compile(r"GLFW/"), {"platform/display"}),
    "OpenXR": (re.compile(r"openxr/"), {"platform/display"}),
}

SOURCES = {".h", ".hpp", ".cpp", ".c", ".glsl", ".vert", ".frag", ".comp", ".py"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def folder_of(path):
    return next((folder for folder in ARROWS if path.startswith(folder + "/")), None)


def faults_of(path, lines):
    if len(lines) > LONGEST:
        yield f"{path}: {len(lines)} lines, {LONGEST} is the most"
    folder = folder_of(path)
    if folder is None:
        return
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        header = match.group(1)
        module = header.split("/")[0]
        if "/" in header and module in MODULES and module not in ARROWS[folder]:
            yield f"{path}:{number}: {folder} must not include {header}"
        if path in INSTALLED and ("/" in header or '"' in line):
            yield f"{path}:{number}: an installed header must not include {header}"
        if header.startswith("../"):
            yield f"{path}:{number}: {header} leaves the folder; include it as <module>/<file>"
        for name, (pattern, rooms) in ROOMS.items():
            if pattern.match(header) and folder not in rooms:
                yield f"{path}:{number}: {name} does not belong in {folder}"


def main():
    root = pathlib.Path(sys.argv[1])
    faults, count = [], 0
    for top in ("app", "engine", "platform", "shaders", "tests", "assets"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in SOURCES or not file.is_file():
                continue
            count += 1
            faults += faults_of(file.relative_to(root).as_posix(), file.read_text(encoding="utf-8").splitlines())
    print("\n".join(faults) if faults else f"{count} files in their layers")
    if count == 0:
        sys.exit(f"{root}: no sources found")
    sys.exit(1 if faults else 0)


main()
