"""Every header compiles by itself: a source includes it before anything else, or else it is compiled here.

    headers.py SOURCE_FOLDER BUILD_FOLDER
"""

import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import unittest
from concurrent.futures import ThreadPoolExecutor

SOURCE, BUILD = (pathlib.Path(folder).resolve() for folder in sys.argv[1:3])
del sys.argv[1:]
FOLDERS = ["packages", "tests"]


def files(pattern):
    return sorted(file for folder in FOLDERS for file in (SOURCE / folder).rglob(pattern))


def first_include(source):
    """The header that a source includes first, if it is one of ours."""
    found = re.search(r'^#include "([^"]+)"|^#include <', source.read_text(), re.MULTILINE)
    if not found or not found.group(1):
        return None
    name = found.group(1)
    packages = [SOURCE / "packages" / name.split("/")[1] / "include"] if name.startswith("perimorph/") else []
    places = [folder / name for folder in [source.parent, SOURCE / "tests", *packages]]
    return next((place for place in places if place.is_file()), None)


def compile_commands():
    """{source: command} of all that this build compiles, without what is precompiled: a header has its includes itself."""
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    return {pathlib.Path(entry["file"]): re.sub(r" -include \S*cmake_pch\.hxx", "", entry["command"]) for entry in entries
            if entry["file"].endswith(".cpp")}


def command_for(header, commands):
    """That of the source that has most folders in common with the header, and of those one that may include most."""
    alike = lambda source: (len(os.path.commonpath([source, header])), len(commands[source]))
    source = max(commands, key=alike)
    words = shlex.split(commands[source])
    words = words[:words.index("-o")] + words[words.index("-o") + 2:]
    return [word for word in words if word not in ("-c", str(source))]


def messages(text, command):
    """The compiler's, about this text: none if it compiles."""
    done = subprocess.run([*command, "-fsyntax-only", "-x", "c++", "-"], input=text, capture_output=True, text=True, timeout=300)
    return "" if done.returncode == 0 else done.stderr or "failed"


class Headers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.commands = compile_commands()

    def test_compile_by_themselves(self):
        first = {first_include(source) for source in files("*.cpp")}
        alone = [header for header in files("*.hpp") if header not in first]
        self.assertGreater(len(files("*.hpp")), len(alone) + 50)
        with ThreadPoolExecutor(2) as pool:
            found = pool.map(lambda header: messages(f'#include "{header}"\n', command_for(header, self.commands)), alone)
            failed = [f"{header}\n{message}" for header, message in zip(alone, found) if message]
        self.assertFalse(failed, "\n".join(failed))

    def test_one_that_lacks_an_include_is_found(self):
        command = command_for(SOURCE / "packages/base/include/perimorph/base/algebra.hpp", self.commands)
        self.assertIn("vector", messages("std::vector<int> squares();\n", command))
        self.assertEqual(messages("#include <vector>\nstd::vector<int> squares();\n", command), "")


if __name__ == "__main__":
    unittest.main()
