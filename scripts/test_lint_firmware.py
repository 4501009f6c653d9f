# SPDX-License-Identifier: Apache-2.0
"""Each check of the firmware's C finds what it is for, and accepts what is right."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from scripts import lint_firmware, lint_run
from scripts.c_rules import check
from scripts.errors import UserError

SOUND = "int sum(const int *values, int count);\nint sum(const int *values, int count)\n{\n    int total = 0;\n\n" + (
    "    for (int i = 0; i < count; i++) {\n        total += values[i];\n    }\n    return total;\n}\n"
)
LONG = "".join(f"    total += {line};\n    total *= total;\n" for line in range(31))
FAULTS = {
    "no prototype": ("clang", "int sum(int a)\n{\n    return a;\n}\n", "-Wmissing-prototypes"),
    "a path without a value": (
        "clang",
        "int f(int a);\nint f(int a)\n{\n    int b;\n    return a + b;\n}\n",
        "-Wuninitialized",
    ),
    "lost bits": ("clang", "char f(int a);\nchar f(int a)\n{\n    return a;\n}\n", "-Wimplicit-int-conversion"),
    "recursion": ("tidy", "int f(int a);\nint f(int a)\n{\n    return a > 0 ? f(a - 1) : 0;\n}\n", "misc-no-recursion"),
    "a long function": (
        "tidy",
        f"unsigned f(unsigned total);\nunsigned f(unsigned total)\n{{\n{LONG}    return total;\n}}\n",
        "readability-function-size",
    ),
    "division by nought": (
        "tidy",
        "int f(int a);\nint f(int a)\n{\n    const int b = 0;\n\n    return a > 2 ? a / b : 1;\n}\n",
        "clang-analyzer-core.DivideZero",
    ),
    "past the end": (
        "cppcheck",
        "int f(void);\nint f(void)\n{\n    const int a[4] = {0};\n\n    return a[4];\n}\n",
        "arrayIndexOutOfBounds",
    ),
    "too wide a scope": (
        "cppcheck",
        "int f(int a);\nint f(int a)\n{\n    int b;\n\n    if (a > 0) {\n        b = a * a;\n        return b;\n    }\n"
        "    return 0;\n}\n",
        "variableScope",
    ),
}


def lint(target: str, source: Path) -> subprocess.CompletedProcess[str]:
    """Run one check over one file."""
    command = lint_firmware.command(target, source)
    return subprocess.run(command, cwd=lint_run.ROOT, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_found(tmp_path: Path, fault: str) -> None:
    target, text, name = FAULTS[fault]
    source = tmp_path / "planted.c"
    source.write_text(text)
    result = lint(target, source)
    assert result.returncode != 0
    assert name in result.stdout + result.stderr


@pytest.mark.parametrize("target", lint_firmware.TOOLS)
def test_what_is_right_is_accepted(tmp_path: Path, target: str) -> None:
    source = tmp_path / "sound.c"
    source.write_text(SOUND)
    result = lint(target, source)
    assert result.returncode == 0, result.stdout + result.stderr


def test_an_absent_tool_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(lint_firmware.TOOLS, "clang", "touchdown-no-such-tool")
    with pytest.raises(UserError, match="touchdown-no-such-tool is not installed"):
        lint_firmware.command("clang")


RULES = {
    "while (busy()) {\n}\n": "a loop that does not count",
    "for (;;) {\n}\n": "a loop that does not count",
    "do {\n    a();\n} while (b);\n": "a loop that does not count",
    "for (int i = 0; ready; i++) {\n}\n": "a loop that does not count",
    "for (int i = 0; i < 8 || ready; i++) {\n}\n": "a loop that does not count",
    "for (int i = 0; i < 8; i++) {\n    i = 0;\n}\n": "a loop that does not count",
    "for (int i = 0; i < 8; i++) {\n    take(&i);\n}\n": "a loop that does not count",
    "for (int i = 0; i < 8; i += 1)\n    i -= 1;\n": "a loop that does not count",
    "// Bounded:\nwhile (busy()) {\n}\n": "a loop that does not count",
    "goto out;\n": "a jump that is not structured",
    "if (setjmp(place) != 0) {\n}\n": "a jump that is not structured",
    "p = malloc(8);\n": "heap, or stack",
    "int **p;\n": "more than two levels of pointers",
    "a = b->c->d->e;\n": "more than two levels of pointers",
    "#define JOIN(a, b) a##b\n": "a macro that pastes",
    "#define SAY(...) f(__VA_ARGS__)\n": "a macro that pastes",
    "#ifdef DEBUG\n#endif\n": "code that is compiled under a condition",
    "int told(int a);\nvoid f(void)\n{\n    told(3);\n}\n": "what told returns is dropped",
    "enum x told(int *a,\n    int b)\n{\n}\nint f(void)\n{\n    told(&a,\n    3);\n}": "what told returns is dropped",
}


@pytest.mark.parametrize("text", RULES)
def test_a_broken_rule_is_found(text: str) -> None:
    found = check({"x.c": "\n" + text})
    assert any(RULES[text] in line for line in found), found
    assert all(line.startswith("x.c:") for line in found)


@pytest.mark.parametrize(
    "text",
    [
        SOUND,
        "// Endless: it is the main loop,\n// which ends never.\nfor (;;) {\n}\n",
        "while (busy()) { // Bounded: 8 are there\n}\n",
        "for (; place >= gap && last[place] > 3; place -= gap) {\n}\n",
        "for (size_t i = 0; i + 1U < sizeof a && b[i] != 0; i++) {\n    c.i = 1;\n    if (i == 3) {\n    }\n}\n",
        '// goto, malloc(3) and **p;\nsay("while (1) goto malloc(3)");\n',
        "int told(int a);\nvoid f(void)\n{\n    (void)told(3);\n    a = told(3);\n    if (told(3)) {\n    }\n}\n",
        "void untold(int a);\nvoid f(void)\n{\n    untold(3);\n}\n",
        "#ifndef GUARD_H\n#define GUARD_H\n#endif\n",
    ],
)
def test_what_keeps_the_rules_is_accepted(text: str) -> None:
    assert check({"x.c": text}) == []


def test_an_absent_file_is_one_sentence() -> None:
    command = [sys.executable, "-m", "scripts.c_rules", "no/such.c"]
    result = subprocess.run(command, cwd=lint_run.ROOT, capture_output=True, text=True, check=False)
    assert (result.returncode, result.stderr) == (1, "touchdown: no/such.c is not a file.\n")


def test_a_value_is_missed_across_files() -> None:
    assert check({"a.h": "bool told(void);\n", "b.c": "void f(void)\n{\n    told();\n}\n"}) == [
        "b.c:3: what told returns is dropped; look at it or write (void)"
    ]


def test_the_table_of_rules_names_what_there_is() -> None:
    text = (lint_run.ROOT / "docs" / "rules.md").read_text()
    tests = "".join(
        path.read_text() for folder in ("scripts", "firmware") for path in (lint_run.ROOT / folder).glob("test_*.py")
    )
    checks = (lint_run.ROOT / "firmware" / ".clang-tidy").read_text()
    assert [line.split(".")[0] for line in text.splitlines() if re.match(r"\| \d+\.", line)] == [
        f"| {n}" for n in range(1, 11)
    ]
    for name in re.findall(r"`(test_\w+)`", text):
        assert f"def {name}(" in tests, name
    for name in re.findall(r"`scripts\.(\w+)`", text):
        assert (lint_run.ROOT / "scripts" / f"{name}.py").is_file(), name
    for name in re.findall(r"`((?:cert|bugprone|misc|readability)-[\w-]+)", text):
        assert f"  -{name}" not in checks, name
