"""Makes mr/_tools.py, the tools as functions with types; usage: mr --json | python3 describe.py MAN >_tools.py

MAN is the folder of the pages, whose first paragraphs become docstrings.
"""
import json
import keyword
import pathlib
import re
import sys
import textwrap

# What each form of operands is in Python: parameters, and what the function returns.
OPERANDS = {
    "[FILE...]": ("source: Frames", "Frames"),
    "[FILE...] [OUT.mrs]": ("*files: Path", "Iterator[Frame]"),
    "SHAPE [OUT.mrs]": ("shape: str", "Frame"),
    "[FILE...] OUT": ("source: Frames, out: Path", "bytes"),
    "[FILE...] OUT.png": ("source: Frames, out: Path", "bytes"),
    "PAGE.html [FILE...]": ("source: Frames, page: Path", "bytes"),
    "[FILE] REFERENCE | --all [FILE]": ("source: Frames, reference: Stream | None = None", "Frames"),
    "[[FILE_A] FILE_B]": ("source: Frames, other: Stream | None = None", "Frames"),
}
TYPES = {"flag": "bool", "count": "int", "real": "float", "share": "Number", "length": "Number", "range": "Vector",
         "vector": "Vector", "size": "str", "text": "Text"}
ELSEWHERE = {"help", "describe", "version", "output", "input", "json"}  # what Python does by other ways
RESULTS = {"bytes": "What is written to - comes as bytes.", "Report": "A report is a dict, of several frames a list."}

HEAD = """\
\"\"\"The tools of mr as functions: made of `mr --json` by describe.py.\"\"\"
from __future__ import annotations

from typing import Iterator, Literal

from .stream import Frame
from .tools import Frames, Number, Path, Report, Stream, Text, Vector, tool

__all__ = {names}

"""


def identifier(name):
    name = name.replace("-", "_")
    return name + "_" * keyword.iskeyword(name)


def parameter(option):
    kind = option["kind"]
    hint = f"Literal{option['choices']}" if kind == "choice" else TYPES[kind]
    if "|" in option.get("argument", "") and hint == "float":
        hint = "Number"
    if option.get("repeats") and kind == "text":
        hint = "dict | Vector | Text"
    default = option.get("default", False if kind == "flag" else None)
    return f"{identifier(option['name'])}: {hint}{' | None' * (default is None)} = {default!r}"


def line(option):
    bounds = f", {option['min']:g} to {option['max']:g}" if "min" in option else ""
    text = f"{identifier(option['name'])}: {option['help']}{bounds}"
    return textwrap.fill(text, 112, initial_indent="    ", subsequent_indent="        ")


def description(page, tool):
    """The first paragraph of a page, without its macros."""
    text = re.search(r"^\.Sh DESCRIPTION\n(.*?)^\.(?:Pp|Sh|Bl|Bd)", page, re.S | re.M)[1]
    text = re.sub(r"^\.Nm$", tool, text, flags=re.M)
    text = re.sub(r"^\.Xr (\S+) (\d)", r"\1(\2)", text, flags=re.M)
    text = re.sub(r"^\.[A-Z][a-z]\b ?", "", re.sub(r"\bFl -", "Fl --", text), flags=re.M)
    text = re.sub(r" Ns | (?:Ar|Va|Cm)(?= )", "", text)
    text = re.sub(r"\\[&]", "", text).replace("\\-", "-").replace("\\e", "/")
    return textwrap.fill(re.sub(r" ([.,:;)])(?=\s|$)", r"\1", " ".join(text.split())), 116, initial_indent="    ",
                         subsequent_indent="    ")


def function(tool, pages):
    name = tool["name"]
    operands, result = OPERANDS[tool["operands"]]
    if any(o["name"] == "json" for o in tool["options"]):
        result = "Report"
    if name == "mr-cat":
        operands += ", *more: Stream"
    options = [[o for o in tool[which] if o["name"] not in ELSEWHERE] for which in ("options", "common")]
    parameters = [*operands.split(", "), *["/", "*"] * ("*" not in operands), *map(parameter, options[0] + options[1])]
    summary = tool["summary"]
    return "\n".join([
        f'@tool("{name}")',
        f"def {identifier(name[3:])}(",
        *[f"    {p}," for p in parameters],
        f") -> {result}:",
        f'    """{summary[0].upper()}{summary[1:]}.', "",
        description((pages / f"{name}.1").read_text(encoding="utf-8"), name), "",
        *map(line, options[0]), *[""] * bool(options[0]), "    As of all tools:", *map(line, options[1]),
        *(["", f"    {RESULTS[result]}"] if result in RESULTS else []),
        '    """', "    raise NotImplementedError", "", ""])


def main():
    tools = json.load(sys.stdin)
    names = [identifier(tool["name"][3:]) for tool in tools]
    print(HEAD.format(names=textwrap.fill(str(sorted(names)), 118, subsequent_indent="           ")))
    print("\n".join(function(tool, pathlib.Path(sys.argv[1])) for tool in tools), end="")


if __name__ == "__main__":
    main()
