"""What READMEs, comments and messages name is there: files, folders and tools of the repository, and links between pages.

    mentions.py SOURCE_FOLDER
"""

import pathlib
import re
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop()).resolve() if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[3]
PARTS = ["drivers", "inputs", "packages", "tests", "tools"]
NAMED = re.compile(r"(?<![\w./-])(?:" + "|".join(PARTS) + r")/[\w./*-]*[\w*]")
LINK = re.compile(r"\]\(([^)#: ]+)(?:#[^)]*)?\)")
ENDINGS = {".md", ".py", ".cpp", ".hpp", ".cmake", ".txt", ""}
SOURCE_FILE = re.compile(r"`(?:[\w.-]+/)*([\w-]+\.(?:cpp|hpp|py))`")
# Made by the tutorial, by a test, by cmake --install.
MADE_LATER = ("inputs/bracket", "inputs/stopped", "tools/lib/program")


def texts(source):
    """All but this folder's, which make up names."""
    pages = [file for file in source.iterdir() if file.is_file()]
    below = [file for part in PARTS for file in (source / part).rglob("*") if file.is_file() and "__pycache__" not in file.parts]
    for file in sorted(pages + below):
        if file.suffix in ENDINGS and not {"corpus", "architecture"} & set(file.parts):
            yield file, file.read_text()


def missing(source):
    names = {file.name for part in PARTS for file in (source / part).rglob("*")}
    for file, text in texts(source):
        for number, line in enumerate(text.splitlines(), 1):
            for name in NAMED.findall(line):
                if not name.startswith(MADE_LATER) and not any(source.glob(name)):
                    yield f"{file.relative_to(source)}:{number}: there is no {name}"
            if file.suffix != ".md":
                continue
            for name in SOURCE_FILE.findall(line):
                if name not in names:
                    yield f"{file.relative_to(source)}:{number}: there is no {name}"
            for link in LINK.findall(line):
                if not (file.parent / link).exists():
                    yield f"{file.relative_to(source)}:{number}: the link leads to no file: {link}"


class Mentions(unittest.TestCase):
    def test_name_what_is_there(self):
        found = list(missing(SOURCE))
        self.assertFalse(found, "\n" + "\n".join(found))

    def test_of_what_is_gone_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder)
            for part in PARTS:
                (source / part).mkdir()
            (source / "README.md").write_text("`tools/gone --help`, `tools`, `src/gone.cpp`, [page](gone.md)\n")
            self.assertEqual(list(missing(source)), ["README.md:1: there is no tools/gone", "README.md:1: there is no gone.cpp",
                                                     "README.md:1: the link leads to no file: gone.md"])


if __name__ == "__main__":
    unittest.main()
