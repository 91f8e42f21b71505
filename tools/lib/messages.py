"""What the Python tools share: how the user's mistakes are told, and how what they need gets there."""

import difflib
import importlib
import importlib.util
import os
import shutil
import subprocess
import sys


def fail(message):
    """The user's mistake: a message and exit status 2, as the program does."""
    print(f"{os.path.basename(sys.argv[0])}: {message}", file=sys.stderr)
    sys.exit(2)


def nearest(name, known):
    """The known names, nearest first, as the end of a message."""
    close = difflib.get_close_matches(name, known, n=3, cutoff=0.5)
    if close:
        return "did you mean " + " or ".join(f'"{c}"' for c in close) + "?"
    return "there are " + ", ".join(known)


def missing(modules, programs):
    return ([module for module in modules if importlib.util.find_spec(module) is None]
            + [program for program in programs if shutil.which(program) is None])


def need(*modules, programs=(), group="view"):
    """Sees to it that Python modules and programs are there, as tools/run does: what is missing is installed."""
    if not missing(modules, programs):
        return
    subprocess.call([os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "install-dependencies"), group])
    importlib.invalidate_caches()
    left = missing(modules, programs)
    if left:
        fail(f"{', '.join(left)} missing, and tools/install-dependencies {group} has not brought it")
