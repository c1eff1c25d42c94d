#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""retired_words.py SOURCE: checks that no text for users contains a word that GLOSSARY.md retired.

It reads the literals of lib/, filter_wscvt/ and of the Python module (labels, messages, helps, keys of JSON
and CSV), the documents, and the identifiers of the installed headers. It does not read comments. `python3 retired_words.py --self`
checks that it finds each word in a sentence made for it.
"""
import pathlib
import re
import sys

# Word forms, and the term of GLOSSARY.md that takes their place.
RETIRED = {
    r"mend(s|ed|ing)?": "repair",
    r"(un)?fold(s|ed|ing)?": "overhang (or back-to-back for faces)",
    r"undercuts?": "overhang",
    r"sheets? beyond": "overhang",
    r"envelopes?": "shrink-wrap",
    r"misfits?": "rms distance",
    r"closeness": "rms distance",
    r"originals?": "scan",
    r"sites?": "seed",
    r"least[- ]squares": "fitted",
    r"shares?": "fraction",
    r"meetings?": "intersection",
    r"fitted surface": "SH surface",
}

# Words that only identifiers had.
RETIRED_IDENTIFIERS = {**RETIRED, r"even(ed|er|ing|s)?": "equalization"}

# File, and why it may hold such words.
EXCEPTIONS = {
    "tests/figures/study": "the paper's own words, and programs of the study",
    "tests/figures/benchmarks": "other programs' words",
}

# Where such a word is allowed: in file names, code, and other senses.
ALLOWED = re.compile(
    r"`[^`]*`"                      # code in documents
    r"|\"[^\" ]*\.(h|cpp)\"?"       # included files
    r"|https?://\S+"
    r"|[\w/]*wscvt/[\w/]+\.h"
    r"|Website|unsigned|FoldLimit|MendLimit"
)

LITERAL_OR_NAME = re.compile(
    r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|(?P<name>\b[A-Za-z_]\w*)", re.S)
LITERAL = re.compile(r"//[^\n]*|/\*.*?\*/|#include[^\n]*|'(?:\\.|[^'\\\n])'|\"((?:\\.|[^\"\\\n])*)\"",
                     re.S)


def literals(text):
    """Line and content of each literal of C++."""
    for match in LITERAL.finditer(text):
        if match.group(1) is not None:
            yield text.count("\n", 0, match.start()) + 1, match.group(1)


def lines_of(text):
    """Line and content of a document, without blocks of commands and code."""
    fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            fenced = not fenced
        elif not fenced and not line.startswith("    "):
            yield number, line


def installed_headers(source):
    """The headers that lib/CMakeLists.txt installs."""
    text = (source / "lib/CMakeLists.txt").read_text(encoding="utf-8")
    return [source / "lib" / name for name in re.findall(r"^\s+((?:wscvt|toolbox)/[\w/]+\.h)$", text, re.M)]


def identifiers_of(text):
    """Line and name of each identifier of C++."""
    for match in LITERAL_OR_NAME.finditer(text):
        if match.group("name"):
            yield text.count("\n", 0, match.start()) + 1, match.group("name")


def words_in_identifier(name):
    """The retired words of an identifier such as `mended_area` or `MendedArea`."""
    for part in re.findall(r"[A-Z]?[a-z]+", name):
        for word, term in RETIRED_IDENTIFIERS.items():
            if re.fullmatch(word, part, re.I):
                yield part, term


def words_in(line):
    """The retired words of a line, each with what to write."""
    line = ALLOWED.sub(" ", line)
    # A key of JSON is words joined by lines; so is an option.
    line = line.replace("_", " ")
    for word, term in RETIRED.items():
        found = re.search(r"(?<![\w-])" + word + r"(?![\w-])", line, re.I)
        if found:
            yield found.group(0), term


def faults_of(source):
    files = [path for folder in ("lib", "filter_wscvt") for path in sorted((source / folder).rglob("*"))
             if path.suffix in (".cpp", ".h")]
    documents = [path for path in sorted(source.rglob("*.md")) if "build" not in path.parts]
    for path in files + documents:
        name = path.relative_to(source).as_posix()
        if any(name == one or name.startswith(one + "/") for one in EXCEPTIONS):
            continue
        text = path.read_text(encoding="utf-8")
        for number, line in literals(text) if path.suffix != ".md" else lines_of(text):
            for word, term in words_in(line):
                yield f"{name}:{number}: \"{word}\"; GLOSSARY.md has: {term}"


    for path in installed_headers(source):
        for number, name in identifiers_of(path.read_text(encoding="utf-8")):
            for word, term in words_in_identifier(name):
                yield (f"{path.relative_to(source).as_posix()}:{number}: {name}: \"{word}\"; GLOSSARY.md has: "
                       f"{term}")


def check_itself():
    for word in RETIRED:
        plain = re.sub(r"\(un\)\?|\([^)]*\)\?|s\?", "", word).replace("[- ]", " ")
        assert list(words_in(f"A sentence with {plain} in it.")), plain
    assert list(words_in("mended_area")) and not list(words_in("a manifold, `mended_area`, recommend"))
    assert list(words_in_identifier("mended_area")) and list(words_in_identifier("EveningReport"))
    assert not list(words_in_identifier("manifold_edges"))
    assert [name for _, name in identifiers_of('f("a b"); // c')] == ["f"]
    assert [n for n, _ in literals('// "fold"\nf("a", \'"\');\n#include "fold.h"\n')] == [2]


def main():
    check_itself()
    if sys.argv[1] == "--self":
        return
    faults = list(faults_of(pathlib.Path(sys.argv[1])))
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
