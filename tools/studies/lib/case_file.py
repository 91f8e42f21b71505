"""Case files from nested dictionaries, a dictionary for each parameter list."""

import os
import xml.etree.ElementTree as ElementTree
from xml.sax.saxutils import quoteattr

KINDS = {bool: "bool", int: "int", float: "double", str: "string"}
WHOLE_NUMBERS = ("Bonds",)  # the lists of them


def kind_of(name, value):
    if not isinstance(value, list):
        return KINDS[type(value)]
    return f"Array({'string' if isinstance(value[0], str) else 'int' if name in WHOLE_NUMBERS else 'double'})"


def text_of(name, value):
    """A parameter, or a list of them."""
    if isinstance(value, dict):
        inner = "".join(text_of(*item) for item in value.items())
        return f"<ParameterList name={quoteattr(name)}>\n{inner}</ParameterList>\n"
    kind = kind_of(name, value)
    if isinstance(value, list):
        value = "{" + ", ".join(str(float(item) if "double" in kind else item) for item in value) + "}"
    value = str(value).lower() if kind == "bool" else str(value)
    return f'<Parameter name={quoteattr(name)} type="{kind}" value={quoteattr(value)}/>\n'


def write_case(file, case):
    """A case file, whose outermost list has its name."""
    with open(file, "w", encoding="utf-8") as out:
        out.write(text_of(os.path.splitext(os.path.basename(file))[0], case))


def value_of(kind, text):
    if kind.startswith("Array"):
        return [value_of(kind[len("Array("):-1], item.strip()) for item in text.strip("{} ").split(",") if item.strip()]
    return {"bool": lambda one: one == "true", "int": int, "double": float, "string": str}[kind](text)


def read_case(file):
    """What write_case has written, or a case of inputs/; what is not given there is not here."""
    def listing(element):
        return {child.get("name"): listing(child) if child.tag == "ParameterList" else value_of(child.get("type"), child.get("value"))
                for child in element}

    return {"Dimension": 2, **listing(ElementTree.parse(file).getroot())}
