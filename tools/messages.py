"""What the Python tools share: how the user's mistakes are told."""

import difflib
import os
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


def need(*modules):
    """Checks that Debian's packages of these Python modules are there."""
    import importlib.util

    missing = [module for module in modules if importlib.util.find_spec(module) is None]
    if missing:
        fail(f"the Python modules {', '.join(missing)} are missing: tools/install-dependencies view installs them")
