"""perimorph params --relax-ng: by this schema an editor (here xmllint) accepts our cases and sees the mistakes of names,
types and words.

    relax_ng.py PERIMORPH MPIEXEC
"""

import pathlib
import re
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, ROOT, InFolder

BEAM = ROOT / "inputs/notched_beam/notched_beam.xml"


class RelaxNg(InFolder):
    def setUp(self):
        super().setUp()
        schema = subprocess.run([PERIMORPH, "params", "--relax-ng"], capture_output=True, text=True, timeout=60, check=True)
        (self.folder / "perimorph.rng").write_text(schema.stdout)

    def validate(self, case):
        return subprocess.run(["xmllint", "--noout", "--relaxng", self.folder / "perimorph.rng", case],
                              capture_output=True, text=True, timeout=60)

    def assert_valid(self, case):
        checked = self.validate(case)
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_all_cases_and_templates_are_valid(self):
        cases = sorted(ROOT.glob("inputs/*/*.xml")) + sorted(ROOT.glob("tools/templates/*/*.xml"))
        self.assertGreaterEqual(len(cases), 9)
        for case in cases:
            with self.subTest(case.name):
                self.assert_valid(case)

    def test_every_parameter_of_the_reference_is_valid(self):
        """With the value that stands there as default or example."""
        root = {}
        reference = subprocess.run([PERIMORPH, "params"], capture_output=True, text=True, timeout=60, check=True).stdout
        found = re.findall(r"^(/.*[^/])\n    (\S+); (?:default|required, such as|optional, such as) (.*); allowed is", reference, re.M)
        self.assertGreater(len(found), 50)
        for path, kind, value in found:
            *sections, name = path.strip("/").split("/")
            section = root
            for part in sections:
                section = section.setdefault("one" if part == "*" else part, {})
            section[name] = (kind, "" if value == '""' else value)

        def written(name, content):
            escape = lambda text: text.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")
            if isinstance(content, tuple):
                return f'<Parameter name="{escape(name)}" type="{content[0]}" value="{escape(content[1])}"/>'
            return f'<ParameterList name="{escape(name)}">' + "\n".join(written(*item) for item in content.items()) + "</ParameterList>"

        (self.folder / "all.xml").write_text(written("all", root))
        self.assert_valid(self.folder / "all.xml")

    def test_a_resolved_case_is_valid(self):
        resolved = self.folder / "case.xml"
        resolved.write_text(re.sub(r"(<Parameter )", r'\1id="1" isDefault="false" isUsed="true" docString="" ', BEAM.read_text())
                            .replace("</ParameterList>\n", "</ParameterList>\n", 1).rstrip().removesuffix("</ParameterList>")
                            + "<Validators/></ParameterList>")
        self.assert_valid(resolved)

    def test_a_case_may_name_its_schema(self):
        case = self.folder / "case.xml"
        case.write_text('<?xml version="1.0"?>\n<?xml-model href="perimorph.rng"?>\n' + BEAM.read_text())
        self.assert_valid(case)
        checked = subprocess.run([PERIMORPH, "check", case], capture_output=True, text=True, timeout=60)
        self.assertIn("notched_beam.geo", checked.stderr)  # which is not there: the case itself is in order
        self.assertNotIn("mistake", checked.stderr)

    def test_mistakes_are_seen_on_their_line(self):
        text = BEAM.read_text()
        for name, (right, wrong) in {
            "a misspelt parameter": ('name="Horizon"', 'name="Horizn"'),
            "a misspelt section": ('name="Peridynamics"', 'name="Peridynamic"'),
            "a parameter of another section": ('name="Horizon"', 'name="Increments"'),
            "a wrong type": ('name="Horizon" type="double"', 'name="Horizon" type="int"'),
            "no number": ('name="Horizon" type="double" value="', 'name="Horizon" type="double" value="a'),
            "a number with a comma": ('name="Horizon" type="double" value="1.5"', 'name="Horizon" type="double" value="1,5"'),
            "no whole number": ('name="Increments" type="int" value="', 'name="Increments" type="int" value="0.'),
            "an array without braces": ('type="Array(double)" value="{', 'type="Array(double)" value="'),
            "an unknown word": ('value="Plane Stress"', 'value="Plain Stress"'),
            "an unknown attribute": ('name="Horizon"', 'unit="mm" name="Horizon"'),
            "an unknown tag": ("<Parameter name=\"Horizon\"", "<parameter name=\"Horizon\""),
        }.items():
            with self.subTest(name):
                self.assertIn(right, text)
                case = self.folder / "case.xml"
                case.write_text(text.replace(right, wrong, 1))
                checked = self.validate(case)
                self.assertNotEqual(checked.returncode, 0)
                line = text[:text.index(right)].count("\n") + 1
                lines = [int(number) for number in re.findall(r"case\.xml:(\d+):", checked.stderr)]
                self.assertIn(line, lines, checked.stderr)


if __name__ == "__main__":
    unittest.main()
