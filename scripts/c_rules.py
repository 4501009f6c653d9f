# SPDX-License-Identifier: Apache-2.0
"""Rules for the firmware's C that no compiler checks; which rule is checked where stands in docs/rules.md.

It reads text, not C: it is as good as the formatting of the project's sources, which is the same everywhere.
"""

import re
from collections.abc import Iterator
from pathlib import Path

from scripts.errors import ArgumentParser, UserError, run_main

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("core", "board", "generated")

_NOISE = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'", re.DOTALL)
_FORBIDDEN = {
    r"\bgoto\b|\b_?(?:setjmp|longjmp)\b": "a jump that is not structured",
    r"\b(?:malloc|calloc|realloc|free|alloca)\s*\(": "heap, or stack of a size that is not constant",
    r"\*\s*(?:const\s*)?\*\s*\w+\s*[;,)=\[]|->\w+->\w+->": "more than two levels of pointers",
    r"##|\.\.\.|\b__VA_ARGS__\b": "a macro that pastes, or takes any number of arguments",
    r"^[ \t]*#[ \t]*(?:if|ifdef|elif|else)\b": "code that is compiled under a condition",
}
_FUNCTION = re.compile(
    r"^(?!typedef\b|return\b|else\b)((?:(?:static|inline|extern|const|struct|enum|unsigned|_Noreturn) )*\w+ \**)(\w+)\("
    r"(?=[^;{}]*\)\s*[;{])",
    re.MULTILINE,
)
_STATED = re.compile(r"\b(?:Bounded|Endless): \S")


def without_noise(text: str) -> str:
    """The same text, comments and contents of strings blank: every character keeps its place."""
    return _NOISE.sub(lambda match: re.sub(r"[^\n\"]", " ", match[0]), text)


def closing(code: str, start: int) -> int:
    """Place of the bracket that closes the one at `start`; the end when there is none."""
    pairs = {"(": ")", "{": "}"}
    depth = 0
    for place in range(start, len(code)):
        if code[place] == code[start]:
            depth += 1
        elif code[place] == pairs[code[start]]:
            depth -= 1
            if depth == 0:
                return place
    return len(code)


def comment_at(text: str, place: int) -> str:
    """The comment behind a place on its line, and the one in the lines just above."""
    lines = text[:place].count("\n")
    rows = text.splitlines()
    found = [match[0] for match in _NOISE.finditer(rows[lines]) if match[0].startswith("/")]
    for row in reversed(rows[:lines]):
        if not row.lstrip().startswith("//"):
            break
        found.append(row)
    return " ".join(reversed(found))


def is_counted(head: str, body: str) -> bool:
    """A `for` with a variable that its step moves, its condition compares, and its body leaves alone."""
    parts = [part.strip() for part in head.split(";")]
    step = re.fullmatch(r"(\w+)(?:\+\+|--| [+-]= .+)", parts[2]) if len(parts) == 3 else None
    if step is None:
        return False
    name = step[1]
    compared = "||" not in parts[1] and re.search(rf"(?<![\w.>]){name}(?: \+ \w+)? [<>]=? |[<>]=? {name}\b", parts[1])
    moved = re.search(
        rf"(?<![\w.>]){name}\s*(?:[-+*/%&|^]|<<|>>)?=(?!=)|(?<![\w.>]){name}(?:\+\+|--)|(?:\+\+|--|&){name}\b", body
    )
    return bool(compared) and moved is None


def loops(text: str, code: str) -> Iterator[tuple[int, str]]:
    """(place, what is wrong) of each loop whose bound is neither in its head nor stated."""
    for match in re.finditer(r"\b(for|while|do)\b", code):
        word, start = match[1], code.find("(", match.end())
        end = closing(code, start) if word != "do" else match.end()
        if word == "while" and re.match(r"\s*;", code[end + 1 :]) and code[: match.start()].rstrip().endswith("}"):
            continue  # the end of a `do`
        if word == "for":
            opening = re.match(r"\s*\{", code[end + 1 :])
            last = closing(code, end + opening.end()) if opening else code.find(";", end)
            if is_counted(code[start + 1 : end], code[end + 1 : last]):
                continue
        if not _STATED.search(comment_at(text, match.start())):
            yield (
                match.start(),
                "a loop that does not count to a limit; say `// Bounded: ...` or `// Endless: ...` above",
            )


def dropped(code: str, names: set[str]) -> Iterator[tuple[int, str]]:
    """(place, what is wrong) of each call whose value nobody looks at."""
    for match in re.finditer(r"[;{}]\s*(\w+)\(", code):
        end = closing(code, match.end() - 1)
        if match[1] in names and re.match(r"\s*;", code[end + 1 :]):
            yield match.start(1), f"what {match[1]} returns is dropped; look at it or write (void)"


def valued(codes: list[str]) -> set[str]:
    """Names of the functions that return something; a name that also belongs to one that does not is left out."""
    found: dict[str, set[bool]] = {}
    for code in codes:
        for match in _FUNCTION.finditer(code):
            kind = re.sub(r"\b(?:static|inline|extern|_Noreturn) ", "", match[1]).strip()
            found.setdefault(match[2], set()).add(kind != "void")
    return {name for name, kinds in found.items() if kinds == {True}}


def check(texts: dict[str, str]) -> list[str]:
    """What is wrong in some sources, `file:line: what` each.

    Args:
        texts: C source by file name.
    """
    codes = {name: without_noise(text) for name, text in texts.items()}
    names = valued(list(codes.values()))
    found = []
    for name, code in codes.items():
        text = texts[name]
        places = [
            (match.start(), what) for pattern, what in _FORBIDDEN.items() for match in re.finditer(pattern, code, re.M)
        ]
        places += [*loops(text, code), *dropped(code, names)]
        found += [f"{name}:{text[:place].count(chr(10)) + 1}: {what}" for place, what in sorted(places)]
    return found


def main() -> int:
    """Entry point: files, or all of the firmware that runs on the board."""
    parser = ArgumentParser(prog="python -m scripts.c_rules", description=__doc__)
    parser.add_argument(
        "files", nargs="*", type=Path, help="C sources; all of firmware/ that runs on the board if none"
    )
    files = parser.parse_args().files
    files = files or sorted(path for folder in FOLDERS for path in (ROOT / "firmware" / folder).glob("*.[ch]"))
    if absent := [str(path) for path in files if not path.is_file()]:
        raise UserError(f"{absent[0]} is not a file.")
    found = check(
        {str(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path): path.read_text() for path in files}
    )
    print("\n".join(found) if found else f"{len(files)} files keep the rules")
    return 1 if found else 0


if __name__ == "__main__":
    run_main(main)
