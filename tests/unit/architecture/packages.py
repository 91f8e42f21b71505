"""The packages depend on each other one way only, in the order of PERIMORPH_PACKAGES, libraries stay where they belong, and none
of the packages grows at the cost of the others.

    packages.py SOURCE_FOLDER     checks the source, then that every rule finds a planted violation in a copy of it
"""

import pathlib
import re
import shutil
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop()) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[3]

LINEAR_ALGEBRA = re.compile(r"(Tpetra|Belos|MueLu|Ifpack2|Amesos2)")
# Where headers of linear algebra may stand; a list names the only ones.
LINEAR_ALGEBRA_IN = {
    "discretization": None,
    "operators": None,
    "solvers": None,
}
# Packages that only some of those after them may know: all others compute without a case file.
KNOWN_ONLY_TO = {
    "input": ["cases", "application"],
    "cases": ["output", "application"],
}
PUGIXML = re.compile(r"pugixml")
PUGIXML_IN = {"input": None}
EXODUS = re.compile(r"(exodusII|netcdf|hdf5)")
EXODUS_IN = {"io": None, "mesh_files": ["exodusII"]}
MOST_OF_ALL_LINES = 0.2  # in one package
MOST_LINES = {"fracture": 1000}  # the loop reads as a whole
MOST_LINES_OF_A_FILE = 500


def ordered_packages(source):
    text = (source / "packages/CMakeLists.txt").read_text()
    return re.search(r"set\(PERIMORPH_PACKAGES ([^)]*)\)", text).group(1).split()


def includes(file):
    """(line number, header) of each #include."""
    for number, line in enumerate(file.read_text().splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if found:
            yield number, found.group(1)


def code_of(folder):
    return sorted(f for f in folder.rglob("*") if f.suffix in {".hpp", ".cpp", ".h", ".c", ".cc"})


def include_violations(source):
    order = ordered_packages(source)
    for package in order:
        allowed = order[: order.index(package) + 1]
        for file in code_of(source / "packages" / package):
            for line, header in includes(file):
                parts = header.split("/")
                if parts[0] == "perimorph" and parts[1] not in allowed:
                    yield f"{file}:{line}: {package} includes {header}, which does not stand before it"
                elif ".." in parts:
                    yield f"{file}:{line}: {header} goes round the packages' include folders"


def depends_violations(source):
    order = ordered_packages(source)
    for package in order:
        file = source / "packages" / package / "CMakeLists.txt"
        text = re.sub(r"#.*", "", file.read_text())
        depends = re.search(r"\bDEPENDS\b([^)]*?)(\bLIBRARIES\b|\bSOURCES\b|\))", text)
        for other in depends.group(1).split() if depends else []:
            if other not in order[: order.index(package)]:
                yield f"{file}: {package} depends on {other}, which does not stand before it"
        for other in re.findall(r"\bperimorph_(\w+)", text):
            if other in order and other != package:
                yield f"{file}: {package} links perimorph_{other} past DEPENDS"


def undeclared_violations(source):
    """What a package includes, it DEPENDS on."""
    for package in ordered_packages(source):
        text = (source / "packages" / package / "CMakeLists.txt").read_text()
        depends = re.search(r"\bDEPENDS\b([^)]*?)(\bLIBRARIES\b|\bSOURCES\b|\))", text)
        declared = (depends.group(1).split() if depends else []) + [package]
        for file in code_of(source / "packages" / package):
            for line, header in includes(file):
                parts = header.split("/")
                if parts[0] == "perimorph" and parts[1] not in declared:
                    yield f"{file}:{line}: {header} is included, but {package} does not DEPEND on {parts[1]}"


def secret_violations(source):
    for package in ordered_packages(source):
        for file in code_of(source / "packages" / package):
            for line, header in includes(file):
                known = header.split("/")[1] if header.startswith("perimorph/") else ""
                if known in KNOWN_ONLY_TO and package not in [known, *KNOWN_ONLY_TO[known]]:
                    yield f"{file}:{line}: {package} must not know {known}"


def library_violations(source, headers, homes):
    for package in ordered_packages(source):
        for file in code_of(source / "packages" / package):
            for line, header in includes(file):
                if not headers.match(header):
                    continue
                only = homes.get(package, [])
                stem = header.rsplit(".", 1)[0].removesuffix("_fwd").removesuffix("_decl")
                if only is not None and stem not in only:
                    yield f"{file}:{line}: {header} does not belong into {package}"


def folder_violations(source):
    order = ordered_packages(source)
    for folder in sorted(p for p in (source / "packages").iterdir() if p.is_dir()):
        if folder.name not in order:
            yield f"{folder}: not named in PERIMORPH_PACKAGES"
    for package in order:
        folder = source / "packages" / package
        for part in ["README.md", "CMakeLists.txt", f"include/perimorph/{package}", "src"]:
            if not (folder / part).exists():
                yield f"{folder}: has no {part}"


def unit_test_violations(source):
    """tests/unit has a folder for each package that has tests of its own."""
    for folder in sorted(p for p in (source / "tests/unit").iterdir() if p.is_dir()):
        if folder.name not in [*ordered_packages(source), "architecture"]:
            yield f"{folder}: there is no package of that name, and its tests are not built"


def n_lines(file):
    return len(file.read_text().splitlines())


def size_violations(source):
    files = {package: code_of(source / "packages" / package) for package in ordered_packages(source)}
    sizes = {package: sum(map(n_lines, own)) for package, own in files.items()}
    for package, size in sizes.items():
        most = min(int(MOST_OF_ALL_LINES * sum(sizes.values())), MOST_LINES.get(package, size))
        if size > most:
            yield f"{source / 'packages' / package}: has {size} lines; allowed are {most}"
        for file in files[package]:
            if n_lines(file) > MOST_LINES_OF_A_FILE:
                yield f"{file}: has {n_lines(file)} lines; allowed are {MOST_LINES_OF_A_FILE}"


def violations(source):
    return [
        *include_violations(source),
        *depends_violations(source),
        *undeclared_violations(source),
        *secret_violations(source),
        *library_violations(source, LINEAR_ALGEBRA, LINEAR_ALGEBRA_IN),
        *library_violations(source, EXODUS, EXODUS_IN),
        *library_violations(source, PUGIXML, PUGIXML_IN),
        *folder_violations(source),
        *unit_test_violations(source),
        *size_violations(source),
    ]


class Packages(unittest.TestCase):
    def test_depend_one_way_and_keep_libraries_where_they_belong(self):
        found = violations(SOURCE)
        self.assertFalse(found, "\n" + "\n".join(found))

    def test_have_code_to_check(self):
        self.assertGreaterEqual(len(ordered_packages(SOURCE)), 12)
        self.assertGreaterEqual(sum(1 for _ in code_of(SOURCE / "packages")), 50)


class PlantedViolations(unittest.TestCase):
    """Each rule finds what is planted in a copy of the source, and nothing else is found there."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.copy = pathlib.Path(self.folder.name)
        for part in ["packages", "tests/unit"]:
            shutil.copytree(SOURCE / part, self.copy / part)
        self.before = set(violations(self.copy))

    def append(self, path, line):
        file = self.copy / "packages" / path
        file.write_text(file.read_text() + line + "\n")

    def replace(self, path, old, new):
        file = self.copy / "packages" / path
        text = file.read_text()
        self.assertIn(old, text)
        file.write_text(text.replace(old, new))

    def assert_found(self, *pieces):
        new = set(violations(self.copy)) - self.before
        self.assertTrue(new, "nothing was found")
        self.assertTrue(any(all(piece in text for piece in pieces) for text in new), new)

    def test_an_include_against_the_order(self):
        self.append("bonds/src/visibility.cpp", '#include "perimorph/operators/fields.hpp"')
        self.assert_found("visibility.cpp", "bonds includes perimorph/operators/fields.hpp")

    def test_an_include_against_the_order_in_angle_brackets(self):
        self.append("mesh/include/perimorph/mesh/mesh.hpp", "  #  include <perimorph/elements/strain.hpp>")
        self.assert_found("mesh.hpp", "mesh includes perimorph/elements/strain.hpp")

    def test_an_include_of_a_folder_that_is_no_package(self):
        self.append("io/src/history.cpp", '#include "perimorph/nowhere/strain.hpp"')
        self.assert_found("history.cpp", "nowhere")

    def test_an_include_round_the_include_folders(self):
        self.append("io/src/history.cpp", '#include "../../input/src/xml_tree.hpp"')
        self.assert_found("history.cpp", "goes round")

    def test_a_dependency_against_the_order(self):
        self.replace("elements/CMakeLists.txt", "DEPENDS base mesh", "DEPENDS base mesh solvers")
        self.assert_found("elements depends on solvers")

    def test_a_link_past_depends(self):
        self.replace("elements/CMakeLists.txt", "DEPENDS base mesh", "DEPENDS base mesh LIBRARIES perimorph_solvers")
        self.assert_found("links perimorph_solvers")

    def test_an_undeclared_dependency(self):
        self.append("solvers/src/multigrid.cpp", '#include "perimorph/mesh/mesh.hpp"')
        self.assert_found("solvers does not DEPEND on mesh")

    def test_a_package_that_knows_the_case_file(self):
        self.append("model/src/problem.cpp", '#include "perimorph/input/mistakes.hpp"')
        self.assert_found("model must not know input")

    def test_linear_algebra_outside_its_packages(self):
        self.append("bonds/src/visibility.cpp", "#include <Tpetra_CrsMatrix.hpp>")
        self.assert_found("Tpetra_CrsMatrix.hpp does not belong into bonds")

    def test_linear_algebra_in_the_loop(self):
        self.append("fracture/src/body.cpp", "#include <BelosTypes.hpp>")
        self.append("fracture/include/perimorph/fracture/body.hpp", "#include <Tpetra_Vector_fwd.hpp>")
        self.assert_found("BelosTypes.hpp does not belong into fracture")
        self.assert_found("Tpetra_Vector_fwd.hpp does not belong into fracture")

    def test_exodus_outside_mesh_files_and_io(self):
        self.append("mesh/src/mesh.cpp", "#include <exodusII.h>")
        self.assert_found("exodusII.h does not belong into mesh")

    def test_pugixml_outside_input(self):
        self.append("cases/src/case.cpp", "#include <pugixml.hpp>")
        self.assert_found("pugixml.hpp does not belong into cases")

    def test_a_package_with_more_than_a_fifth_of_all_lines(self):
        for number in range(20):
            (self.copy / f"packages/model/src/part_{number}.cpp").write_text("//\n" * 490)
        self.assert_found("packages/model: has")

    def test_a_loop_of_more_than_a_thousand_lines(self):
        for number in range(2):
            (self.copy / f"packages/fracture/src/part_{number}.cpp").write_text("//\n" * 490)
        self.assert_found("packages/fracture: has", "allowed are 1000")

    def test_a_long_file(self):
        self.append("bonds/src/visibility.cpp", "\n" * 500)
        self.assert_found("visibility.cpp: has")

    def test_unit_tests_of_no_package(self):
        (self.copy / "tests/unit/nowhere").mkdir()
        self.assert_found("tests/unit/nowhere: there is no package of that name")

    def test_a_package_without_readme(self):
        readme = self.copy / "packages/bonds/README.md"
        readme.unlink(missing_ok=True)
        self.before -= {f"{readme.parent}: has no README.md"}
        self.assert_found("bonds: has no README.md")

    def test_a_package_that_is_not_named(self):
        (self.copy / "packages/stray").mkdir()
        self.assert_found("stray: not named")


if __name__ == "__main__":
    unittest.main()
