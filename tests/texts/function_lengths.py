#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""function_lengths.py SOURCE: checks that no function of lib/ and filter_wscvt/ has more than 80 lines.

A function counts from the first line of its signature to its last brace. Functions inside a function
(lambdas, local classes) belong to it. `python3 function_lengths.py --self` checks the measuring itself.
"""
import pathlib
import re
import sys

MOST = 80
# Comments, literals and preprocessor lines. Their line breaks stay.
SKIPPED = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![\w])\'(?:\\.|[^\'\\\n])+\''
                     r'|^[ \t]*#(?:\\\n|[^\n])*', re.S | re.M)
SCOPE = re.compile(r"\s*(?:template\s*<.*>\s*)?(?:inline\s+)?(?:namespace|class|struct|union|enum|extern)\b", re.S)


def blank(match):
    return re.sub(r"[^\n]", " ", match.group(0))


def functions(text):
    """First line, number of lines and signature of each function."""
    text = SKIPPED.sub(blank, text)
    start = 0  # of the declaration that is read
    body = None  # start of the function whose body is read
    depth = 0
    stack = []
    for place, sign in enumerate(text):
        if sign == "{":
            head = text[start:place]
            if body is not None:
                depth += 1
            elif SCOPE.match(head) and "(" not in re.sub(r"alignas\([^)]*\)", "", head):
                stack.append(place)
                start = place + 1
            elif "(" in head and not re.search(r"=\s*$", head):
                # A member's initializer in braces is no body: more of the signature follows.
                body, depth = start, 1
            else:
                body, depth = None, 0
                stack.append(None)
        elif sign == "}":
            if body is not None:
                depth -= 1
                rest = text[place + 1:place + 400].lstrip()
                if depth == 0 and rest[:1] not in (",", "{"):
                    first = body + len(text[body:]) - len(text[body:].lstrip())
                    yield (text.count("\n", 0, first) + 1, text.count("\n", first, place) + 1,
                           " ".join(text[first:first + 90].split()))
                    body, start = None, place + 1
                elif depth == 0:
                    # The end of an initializer.
                    depth = 0 if rest[:1] == "{" else depth
            else:
                if stack:
                    stack.pop()
                start = place + 1
        elif sign == ";" and body is None:
            start = place + 1
        elif sign == ":" and body is None and re.search(r"(public|private|protected)\s*$", text[start:place]):
            start = place + 1


def check_itself():
    text = ('namespace a {\nclass B : C {\n public:\n  B() : x_{1}, y_{2} {\n    f();\n  }\n\n'
            '  int g() const { return 1; }\n  int x_{3};\n};\n// {\nvoid h(const char* c = "}") {\n'
            "  const auto k = [] { return '{'; };\n}\n}  // namespace a\n")
    found = [(first, count) for first, count, _ in functions(text)]
    assert found == [(4, 3), (8, 1), (12, 3)], found


def main():
    check_itself()
    if sys.argv[1] == "--self":
        return
    root = pathlib.Path(sys.argv[1])
    long = []
    for folder in ("lib", "filter_wscvt"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".cpp", ".h"):
                continue
            for first, count, signature in functions(path.read_text(encoding="utf-8")):
                if count > MOST:
                    long.append(f"{path.relative_to(root)}:{first}: {count} lines: {signature}")
    if long:
        sys.exit(f"Functions with more than {MOST} lines. Split them:\n" + "\n".join(long))


if __name__ == "__main__":
    main()
