#!/usr/bin/env python3
"""tidy.py BUILD_FOLDER [JOBS]: clang-tidy on the program's sources, with the flags of BUILD_FOLDER/compile_commands.json.

Most of what clang-tidy walks through is the system's headers, so it is given files that include several sources of one
module. Sources that define equal names cannot stand in one file. Where such a file is not clean, its sources are judged
one by one, and only that verdict counts. Exit code 0 where all are clean.
"""

import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
PROGRAM = tuple(os.path.join(ROOT, top, "") for top in ("app", "engine", "platform"))
MOST_SOURCES = 12
# What clang-format puts at the start of a line: types and aliases, macros, functions, and variables.
DEFINITION = re.compile(
    r"(?:struct|class|enum class|using|#define) +(\w+)|[\w>&*] [&*]?(\w+)\(|\b([a-z_]\w*)(?: =|\{|;|\[)"
)
INCLUDE = re.compile(r'^#include "(.+)"', re.MULTILINE)
NOISE = re.compile(r"^\d+ warnings?.* generated\.?$|^Suppressed |^Use -header-filter")


def names(file, private=False):
    """What FILE defines at the start of its lines; where PRIVATE, only what it keeps to itself."""
    found, hidden = set(), False
    with open(file, encoding="utf-8") as text:
        for line in text:
            if line.startswith(("namespace {", "}  // namespace\n")):
                hidden = line.startswith("namespace")
            elif re.match(r"[a-zA-Z#]", line) and not line.startswith(("namespace", "#include")):
                if hidden or not private or line.startswith(("static ", "#define ")):
                    found.update(name for match in DEFINITION.findall(line) for name in match if name)
    return found


def flags(entry):
    """The part of a compile command that decides what is included and defined."""
    words = shlex.split(entry["command"])
    kept = [words[0]]
    for word, value in zip(words[1:], words[2:] + [""]):
        if word.startswith(("-I", "-D", "-std", "-W")) and word != "-Winvalid-pch":
            kept.append(word)
        elif word == "-isystem":
            kept += [word, value]
    return tuple(kept)


def headers(file, roots, seen):
    """Adds to SEEN the program's headers that FILE includes, those included by them as well."""
    with open(file, encoding="utf-8") as text:
        for name in INCLUDE.findall(text.read()):
            for root in (os.path.dirname(file), *roots):
                header = os.path.realpath(os.path.join(root, name))
                if header not in seen and os.path.isfile(header):
                    seen.add(header)
                    headers(header, roots, seen)
    return seen


class Group:
    """Sources that are compiled alike, and the names that they keep to themselves and that their headers define."""

    def __init__(self, key):
        self.key, self.sources, self.private, self.public = key, [], set(), set()

    def takes(self, key, private, public):
        apart = not (self.private & (private | public) or self.public & private)
        return apart and key == self.key and len(self.sources) < MOST_SOURCES

    def take(self, source, private, public):
        self.sources.append(source)
        self.private |= private
        self.public |= public


def groups(entries):
    """All sources of the entries, in as few groups as their names allow."""
    made = []
    for entry in sorted(entries, key=lambda entry: entry["file"]):
        source, key = entry["file"], flags(entry)
        roots = [flag[2:] for flag in key if flag.startswith("-I")]
        found = names(source, private=True), set().union(*map(names, headers(source, roots, set())))
        group = next((group for group in made if group.takes(key, *found)), None)
        if not group:
            group = Group(key)
            made.append(group)
        group.take(source, *found)
    return made


def tidy(database, source):
    """What clang-tidy finds in SOURCE, and whether it is clean."""
    run = subprocess.run(["clang-tidy", "--quiet", "-p", database, source], stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True, errors="replace")
    lines = [line for line in run.stdout.splitlines() if not NOISE.match(line)]
    return "\n".join(lines), run.returncode == 0 and not any(lines)


def put_together(build, index, group):
    """A file that includes the group's sources, in a folder of its own with its compile command; both are returned."""
    folder = os.path.join(build, "tidy", str(index))
    os.makedirs(folder, exist_ok=True)
    file = os.path.join(folder, "sources.cpp")
    with open(file, "w", encoding="utf-8") as text:
        text.writelines(f'#include "{source}"  // NOLINT\n' for source in group.sources)
    with open(os.path.join(folder, "compile_commands.json"), "w", encoding="utf-8") as text:
        json.dump([{"directory": build, "file": file, "command": shlex.join(group.key + ("-c", file))}], text)
    return folder, file


def judge(build, index, group):
    """Lints one group; prints what is found, and returns whether its sources are clean."""
    together = ""
    if len(group.sources) > 1:
        together, clean = tidy(*put_together(build, index, group))
        if clean:
            return True
        print("tidy: not clean together, so one by one:", *(os.path.relpath(source, ROOT) for source in group.sources), flush=True)
    verdicts = [tidy(build, source) for source in group.sources]
    clean = all(clean for _, clean in verdicts)
    for found in filter(None, [together] if clean else [found for found, _ in verdicts]):
        print(found, flush=True)
    return clean


def main():
    build = os.path.realpath(sys.argv[1])
    jobs = int(sys.argv[2]) if len(sys.argv) > 2 else os.cpu_count()
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as text:
        entries = {entry["file"]: entry for entry in json.load(text) if entry["file"].startswith(PROGRAM)}
    made = sorted(groups(entries.values()), key=lambda group: -len(group.sources))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        clean = list(pool.map(lambda numbered: judge(build, *numbered), enumerate(made)))
    print(f"tidy: {len(entries)} sources in {len(made)} files")
    sys.exit(0 if entries and all(clean) else 1)


if __name__ == "__main__":
    main()
