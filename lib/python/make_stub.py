# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the stub of the module beside it, with every option and its type.

    make_stub.py TEMPLATE STUB
"""
import pathlib
import sys

template, stub = map(pathlib.Path, sys.argv[1:])
sys.path.insert(0, str(stub.parent.parent))
import wscvt  # noqa: E402: the one that was built

choices = wscvt._wscvt._choices()


def annotation(name, default):
    if name in choices:
        # Any case is accepted. The stub has the module's names and the paper's names.
        names = choices[name] + [choice.upper() for choice in choices[name] if choice.startswith("wscvt-")]
        return "Literal[" + ", ".join(f'"{choice}"' for choice in names) + "]"
    return type(default).__name__


both = {**wscvt.options(), **wscvt.options("as-published")}
lines = {name: f"    {name}: {annotation(name, default)} = ...,\n" for name, default in both.items()}
text = template.read_text()
for function in ("create", "convex"):
    text = text.replace(f"    # options of {function}\n",
                        "".join(lines[name] for name in wscvt._wscvt._option_help(function)))
del lines["nodes"]
stub.write_text(text.replace("    # options but nodes\n", "".join(lines.values())))
