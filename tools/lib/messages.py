"""Shared by the Python tools: error messages, and installing what a tool needs."""

import argparse
import difflib
import importlib
import importlib.util
import os
import shutil
import subprocess
import sys


def fail(message):
    """Reports a user's mistake and exits with status 2, as the program does."""
    print(f"{os.path.basename(sys.argv[0])}: {message}", file=sys.stderr)
    sys.exit(2)


def nearest(name, known):
    """The end of a message: the known names closest to this one, or else all of them."""
    close = difflib.get_close_matches(name, known, n=3, cutoff=0.5)
    if close:
        return "did you mean " + " or ".join(f'"{c}"' for c in close) + "?"
    return "there are " + ", ".join(known)


def a_name(text):
    """The type of an option that names a file or folder."""
    if not text:
        raise argparse.ArgumentTypeError('found ""; allowed is a name')
    return text


def missing(modules, programs):
    return ([module for module in modules if importlib.util.find_spec(module) is None]
            + [program for program in programs if shutil.which(program) is None])


def need(*modules, programs=(), group="view"):
    """Makes sure that Python modules and programs are available, and installs those that are missing."""
    if not missing(modules, programs):
        return
    if {"-h", "--help"} & set(sys.argv[1:]):  # to read what a tool does, nothing need be installed
        print(sys.modules["__main__"].__doc__)
        sys.exit(0)
    subprocess.call([os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "install-dependencies"), group])
    importlib.invalidate_caches()
    left = missing(modules, programs)
    if left:
        fail(f"missing: {', '.join(left)}; tools/install-dependencies {group} did not install it")
