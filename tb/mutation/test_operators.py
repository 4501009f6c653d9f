# SPDX-License-Identifier: Apache-2.0
"""Which faults are planted, and where none are."""

import pytest

from tb.mutation.operators import mutants

HEAD = "module m #(parameter W = 8) (input wire clk, output reg [W-1:0] q);\n"


def changes(body: str) -> set[str]:
    """Return the lines that mutants of a module with this body have in place of those that were there."""
    return {mutant.after for mutant in mutants(f"{HEAD}{body}\nendmodule\n")}


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("assign a = b == c;", {"assign a = b != c;"}),
        ("assign a = b <= c;", {"assign a = b < c;", "assign a = b > c;"}),
        ("assign a = !b && c;", {"assign a = b && c;", "assign a = !b || c;"}),
        ("assign a = b - 8'd1;", {"assign a = b + 8'd1;", "assign a = b - 8'd2;", "assign a = b - 8'd0;"}),
        ("assign a = b[3];", {"assign a = b[4];", "assign a = b[2];"}),
        ("assign a = c ? x : y;", {"assign a = c ? y : x;"}),
        ("always @(posedge clk) q <= a;", {"always @(negedge clk) q <= a;", "always @(posedge clk) begin end"}),
        ("assign a = 1'b1;", {"assign a = 1'b0;"}),
    ],
)
def test_faults_of_a_line(line: str, expected: set[str]) -> None:
    assert changes(line) == expected


def test_conditions_are_forced_and_negated() -> None:
    found = changes("always @* begin\nif (go) a = b;\nend")
    assert found == {"if (1'b1) a = b;", "if (1'b0) a = b;", "if (!(go)) a = b;"}


def test_an_assignment_below_a_condition_is_dropped() -> None:
    assert "if (rst) begin end" in changes("always @* begin\nif (rst) q <= 0;\nend")
    assert "DONE: begin end" in changes("always @* case (s)\nDONE: q <= a;\nendcase")


@pytest.mark.parametrize(
    "line",
    [
        "// a == b",
        "(* keep = 1 *)",
        "reg [7:0] a;",
        "wire [W-1:0] a;",
        "localparam BITS = W + 1;",
        "wire unused = &{1'b0, a};",
        "assign a = b[W-1:0];",
        ".WIDTH(W + 1)",
        "function integer f; input integer n; f = n + 1; endfunction",
        "if (W < 1) begin : g_w\nERROR_w instance();\nend",
    ],
)
def test_what_is_left_alone(line: str) -> None:
    assert changes(line) == set()


def test_a_mutant_changes_only_its_place() -> None:
    text = f"{HEAD}assign a = b == c;\nassign d = e;\nendmodule\n"
    (mutant,) = mutants(text)
    assert mutant.apply(text) == text.replace("==", "!=")
    assert mutant.line == 2
