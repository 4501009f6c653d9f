# SPDX-License-Identifier: Apache-2.0
"""Finds the places in a Verilog file where a small fault can be planted, and plants it.

Left alone, because a fault there is of another kind or changes nothing but a width: comments, attributes, parameter
and port lists, ranges of declarations and slices, replication counts, what sizes things at elaboration (functions,
local parameters without a range, parameters of instances), generate conditions and loops, the checks of parameters,
and wires whose name says that they are unused.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

SWAPS = {
    "==": ["!="],
    "!=": ["=="],
    "<": ["<=", ">="],
    ">": [">=", "<="],
    ">=": [">", "<"],
    "<=": ["<", ">"],
    "&&": ["||"],
    "||": ["&&"],
    "&": ["|"],
    "|": ["&"],
    "^": ["|"],
    "+": ["-"],
    "-": ["+"],
    "<<": [">>"],
    ">>": ["<<"],
    "!": [""],
    "~": [""],
}
BINARY_ONLY = {"+", "-", "&", "|", "^", "<", ">", "<=", ">="}
TOKEN = re.compile(
    r"\d*'[bdho][0-9a-fA-F_]+|[A-Za-z_$`][\w$]*|\d+"
    r"|<<<|>>>|===|!==|\+:|-:|<<|>>|<=|>=|==|!=|&&|\|\||~\^|~&|~\||[-+*/%&|^~!<>?:=(){}\[\],;.@#]"
)
OPENING, CLOSING = "([{", ")]}"
BEFORE_STATEMENT = {"begin", "else", ")", ":", "end", "endcase", "endgenerate", "endmodule"}
OPERAND_END = re.compile(r"[\w$)\]}]$")


@dataclass(frozen=True)
class Mutant:
    """Replacement of text[start:end]; `before` and `after` show the lines it is in."""

    operator: str
    start: int
    end: int
    replacement: str
    line: int
    before: str
    after: str

    def apply(self, text: str) -> str:
        """Return the text with the fault in it."""
        return text[: self.start] + self.replacement + text[self.end :]


@dataclass(frozen=True)
class Token:
    """A token outside of what is left alone, with its depth within (), [] and {}."""

    text: str
    start: int
    end: int


def blank(text: str, pattern: str, flags: int = re.MULTILINE) -> str:
    """Return the text with every match of the pattern (its group 1, if it has one) replaced by spaces."""
    result = text
    for match in re.finditer(pattern, text, flags):
        start, end = match.span(1 if match.re.groups else 0)
        result = result[:start] + re.sub(r"[^\n]", " ", result[start:end]) + result[end:]
    return result


def mutable(text: str) -> str:
    """Return the text with blanks in place of everything that is left alone."""
    text = blank(text, r"//[^\n]*")
    text = blank(text, r"\(\*(?!\)).*?\*\)")
    text = blank(text, r"\bmodule\b.*?\);", re.DOTALL)
    text = blank(text, r"\bfunction\b.*?\bendfunction\b", re.DOTALL)
    text = blank(text, r"^[^\n]*\n[^\n]*\bERROR_[^\n]*$")
    text = blank(text, r"^[ \t]*(?:for\b|genvar\b|integer\b|`|reg\b|input\b|output\b|end else if \(.*begin : )[^\n]*$")
    text = blank(text, r"^[ \t]*if \([^\n]*begin : [^\n]*$")
    text = blank(text, r"^[ \t]*(?:wire|localparam)\b[^\n=]*$(?<=;)")
    text = blank(text, r"^[ \t]*localparam[ \t]+\w[^;]*;")
    text = blank(text, r"^[ \t]*wire[^\n=]*\bunused[^;]*;")
    text = blank(text, r"^[ \t]*\.[A-Z_]+[ \t]*\([^\n]*$")
    text = blank(text, r"\bunused\w*(?:\[[^\]]*\])?")
    text = blank(text, r"\b(?:wire|localparam)[ \t]+(?:signed[ \t]+)?(\[[^\]]*\])")
    text = blank(text, r"\{\s*(\([^()]*\)|\w+)\s*(?=\{)")
    return blank(text, r"\[([^\[\]:]*(?<![+-]):[^\[\]]*)\]")


def tokens(text: str) -> list[Token]:
    """Return the tokens of what may be changed."""
    return [Token(match.group(), *match.span()) for match in TOKEN.finditer(mutable(text))]


def assignments(found: list[Token]) -> Iterator[tuple[int, int, int]]:
    """Yield (first token of the left side, `<=`, `;`) of every nonblocking assignment."""
    depth, first, declared = 0, 0, False
    operator: int | None = None
    for index, token in enumerate(found):
        if token.text in OPENING:
            depth += 1
        elif token.text in CLOSING:
            depth -= 1
        if depth == 0 and token.text == "<=" and not declared and operator is None:
            operator = index
        elif token.text == ";":
            if operator is not None:
                yield first, operator, index
            first, operator, declared = index + 1, None, False
        elif operator is None and depth == 0:
            if token.text in ("wire", "assign", "localparam", "="):
                declared = True
            elif token.text in BEFORE_STATEMENT:
                first = index + 1


def literal_neighbours(text: str) -> list[str]:
    """Return the literals one above and one below, where the width holds them."""
    if "'" not in text:
        value = int(text)
        return [str(value + 1)] + ([str(value - 1)] if value else [])
    size, base, digits = re.fullmatch(r"(\d*)'([bdho])(\w+)", text).groups()
    radix = {"b": 2, "o": 8, "d": 10, "h": 16}[base]
    value = int(digits.replace("_", ""), radix)
    form = {"b": "b", "o": "o", "d": "d", "h": "x"}[base]
    limit = 1 << int(size or 32)
    return [f"{size}'{base}{other:{form}}" for other in (value + 1, value - 1) if 0 <= other < limit]


def close(found: list[Token], index: int) -> int:
    """Return the index of the bracket that closes the one at index."""
    depth = 0
    for position in range(index, len(found)):
        depth += (found[position].text in OPENING) - (found[position].text in CLOSING)
        if depth == 0:
            return position
    raise ValueError(f"no bracket closes token {found[index]}")


def ternary_end(found: list[Token], index: int) -> tuple[int, int] | None:
    """Return the indices of the `:` that belongs to the `?` at index and of the token after its last operand."""
    depth = nested = 0
    colon = None
    for position in range(index + 1, len(found)):
        text = found[position].text
        if depth == 0 and (text in CLOSING or text in ",;"):
            return (colon, position) if colon is not None else None
        depth += (text in OPENING) - (text in CLOSING)
        if depth == 0 and text == "?":
            nested += 1
        elif depth == 0 and text == ":" and colon is None:
            if nested == 0:
                colon = position
            nested = max(0, nested - 1)
    return None


def edits(text: str) -> Iterator[tuple[str, int, int, str]]:
    """Yield (operator, start, end, replacement) of every fault that can be planted."""
    found = tokens(text)
    nonblocking = set()
    for first, operator, last in assignments(found):
        nonblocking.add(operator)
        yield "drop assignment", found[first].start, found[last].end, "begin end"
    for index, token in enumerate(found):
        before = found[index - 1] if index else None
        if token.text in SWAPS and index not in nonblocking:
            operand = before is not None and OPERAND_END.search(before.text) and before.text not in ("if", "case")
            if token.text in BINARY_ONLY and not operand:
                continue
            for other in SWAPS[token.text]:
                yield f"{token.text} to {other or 'nothing'}", token.start, token.end, other
        elif re.fullmatch(r"\d+|\d*'[bdho]\w+", token.text):
            for other in literal_neighbours(token.text):
                yield "constant", token.start, token.end, other
        elif token.text == "if" and index + 1 < len(found) and found[index + 1].text == "(":
            end = close(found, index + 1)
            start, stop = found[index + 1].start, found[end].end
            if re.search(r"[a-z]", re.sub(r"'[bdho]", "", text[start:stop])):
                for other in ("(1'b1)", "(1'b0)", f"(!{text[start:stop]})"):
                    yield "condition", start, stop, other
        elif token.text == "?":
            ends = ternary_end(found, index)
            if ends is not None:
                colon, last = ends
                one = text[token.end : found[colon].start].strip()
                other = text[found[colon].end : found[last].start].strip()
                yield "swap operands", token.end, found[last].start, f" {other} : {one}"
        elif token.text == "posedge":
            yield "edge", token.start, token.end, "negedge"


def shown(text: str) -> str:
    """Return a piece of source in one line without its comments."""
    return re.sub(r"\s+", " ", re.sub(r"//[^\n]*", "", text)).strip()


def mutants(text: str) -> list[Mutant]:
    """Return every fault that can be planted into the text of one file."""
    result = []
    for operator, start, end, replacement in edits(text):
        left = text.rfind("\n", 0, start) + 1
        right = text.find("\n", end)
        before = shown(text[left:right])
        after = shown(text[left:start] + replacement + text[end:right])
        result.append(Mutant(operator, start, end, replacement, text.count("\n", 0, start) + 1, before, after))
    return result
