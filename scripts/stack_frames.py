# SPDX-License-Identifier: Apache-2.0
"""How deep the stack is at each call of each function, from the disassembly of an ARM ELF (`objdump -d`).

Both instruction sets are read, since newlib is Thumb. A function is followed from its first instruction along every
branch, so that a frame which only one path takes counts at the calls of that path alone.
"""

import re
from dataclasses import dataclass, field

from scripts.errors import UserError

FRAME_LIMIT_BYTES = 64 * 1024
"""A function that comes this deep takes stack in a loop."""

_COND = "eq|ne|cs|cc|mi|pl|vs|vc|hi|ls|ge|lt|gt|le"
_HEADER = re.compile(r"^([0-9a-f]+) <(.+)>:$")
_LINE = re.compile(r"^\s*([0-9a-f]+):\t(\S+)(?:\t([^@;]*))?")
_BRANCH = re.compile(rf"(blx|bl|bx|b)({_COND})?(?:\.[nw])?")
_MOVES = re.compile(
    r"(push|pop|vpush|vpop|stmdb|vstmdb|ldmia|ldm|vldmia|srsdb|rfeia|sub|subw|add|addw|ldr|str|strd|mov|cmp|tst)"
    rf"s?({_COND})?(?:\.[nw])?"
)
_PLACE = re.compile(r"([0-9a-f]+) <")


@dataclass(frozen=True)
class Instruction:
    """One line of a disassembly: `operands` is without the comment."""

    address: int
    mnemonic: str
    operands: str


@dataclass
class Function:
    """One function of the ELF.

    Attributes:
        frame_bytes: the deepest that its own frame comes.
        calls: (address of the callee, bytes of the frame then); a jump into another function is a call too.
        indirect: (address of the instruction, bytes of the frame then) of each call through a pointer.
        unmasks: it lets interrupts in (`cpsie`).
    """

    name: str
    address: int
    frame_bytes: int = 0
    calls: list[tuple[int, int]] = field(default_factory=list)
    indirect: list[tuple[int, int]] = field(default_factory=list)
    unmasks: bool = False


def parse(disassembly: str) -> dict[int, tuple[str, list[Instruction]]]:
    """Name and instructions of everything that has a label, by address."""
    found: dict[int, tuple[str, list[Instruction]]] = {}
    body: list[Instruction] = []
    for line in disassembly.splitlines():
        if (header := _HEADER.match(line)) is not None:
            body = []
            found[int(header[1], 16)] = (header[2], body)
        elif (match := _LINE.match(line)) is not None:
            body.append(Instruction(int(match[1], 16), match[2], (match[3] or "").strip()))
    return found


def _list_bytes(operands: str) -> int:
    """Bytes that a register list such as `{r4, lr}` or `{d8-d10}` takes."""
    total = 0
    for item in operands[operands.index("{") + 1 : operands.index("}")].split(","):
        first, _, last = item.strip().partition("-")
        count = int(last[1:]) - int(first[1:]) + 1 if last else 1
        total += count * (8 if first.startswith("d") else 4)
    return total


def taken_bytes(instruction: Instruction, register_bytes: int = 0) -> int | None:
    """Bytes by which an instruction moves sp down; negative is up, None is to the top of a stack.

    Args:
        instruction: what to look at.
        register_bytes: the most that `sub sp, sp, rN` takes in this function; 0: it must not occur.

    Raises:
        UserError: it moves sp by an amount that is not known before it runs.
    """
    match = _MOVES.fullmatch(instruction.mnemonic)
    base, operands = match[1] if match else "", instruction.operands
    if base in ("push", "vpush", "pop", "vpop"):
        return _list_bytes(operands) * (1 if "push" in base else -1)
    if base in ("srsdb", "rfeia") and operands.startswith("sp!"):
        return 8 if base == "srsdb" else -8
    if base in ("stmdb", "vstmdb", "ldmia", "ldm", "vldmia") and operands.startswith("sp!"):
        return _list_bytes(operands) * (1 if "db" in base else -1)
    if (write_back := re.search(r"\[sp, #(-?\d+)\]!|\[sp\], #(-?\d+)", operands)) is not None:
        return -int(write_back[1] or write_back[2])
    if base == "ldr" and operands.startswith("sp, [pc"):
        return None
    if base.startswith(("sub", "add")) and (amount := re.fullmatch(r"sp, (?:sp, )?(?:#(\d+)|r\d+)", operands)):
        taken = int(amount[1]) if amount[1] else register_bytes or None
        if taken is not None:
            return taken if base.startswith("sub") else -taken
    writes = re.match(r"sp\s*,", operands) and base not in ("cmp", "tst", "str") and "{" not in operands
    listed = base.startswith("ldm") and re.search(r"\{.*\bsp\b", operands)
    if writes or listed or "sp!" in operands or re.search(r"\[sp[^\]]*\]!|\[sp\],", operands):
        raise UserError(
            f"{instruction.mnemonic} {operands} at {instruction.address:x} takes stack by an amount that is not known; "
            "an array of constant size is wanted in place of alloca() or a variable-length array."
        )
    return 0


def _conditional(instruction: Instruction) -> bool:
    match = _BRANCH.fullmatch(instruction.mnemonic) or _MOVES.fullmatch(instruction.mnemonic)
    return match is not None and match[2] is not None


def _leaves(instruction: Instruction) -> str:
    """How an instruction leaves the straight line; empty: it does not.

    One of `return`, `table`, `pointer`, `jump`, `call`, `veneer` and `within`.
    `veneer` jumps to the word behind it, as the linker lets ARM code reach Thumb code; `within` is a jump that is
    computed, as hand-written code of the library has it.
    """
    operands = instruction.operands
    match = _BRANCH.fullmatch(instruction.mnemonic)
    if match is not None and (match[1] == "b" or _PLACE.match(operands)):
        return "jump" if match[1] in ("b", "bx") else "call"
    if match is not None:
        return "return" if operands == "lr" and match[1] == "bx" else "pointer"
    if instruction.mnemonic in ("cbz", "cbnz"):
        return "jump"
    if instruction.mnemonic.startswith("rfe") or re.search(r"\{.*\bpc\b", operands) or operands.startswith("pc, [sp]"):
        return "return"
    if re.match(r"pc\b", operands) or instruction.mnemonic.startswith(("tbb", "tbh")):
        if operands == "pc, lr":
            return "return"
        if re.fullmatch(r"pc, \[pc, \w+, lsl #2\]", operands):
            return "table"
        return "veneer" if operands == "pc, [pc, #-4]" else "within"
    return ""


def _table(body: list[Instruction], index: int) -> list[int]:
    """Places in the jump table behind instruction `index`."""
    places = []
    for entry in body[index + 1 :]:
        if entry.mnemonic == ".word":
            places.append(int(entry.operands, 16))
        elif places:
            break
    return places


def _piece(body: list[Instruction], index: int) -> list[int]:
    """Places behind instruction `index`, as far as nothing moves sp: an unrolled loop that is entered somewhere."""
    places = []
    for entry in body[index + 1 :]:
        places.append(entry.address)
        if taken_bytes(entry) != 0 or _leaves(entry) == "return":
            break
    return places


def function(
    name: str, body: list[Instruction], next_address: int, register_bytes: int = 0, jumps_within: bool = False
) -> Function:
    """Follow a function along every branch; where two paths meet, the deeper one counts.

    Args:
        name: its label.
        body: its instructions, the first one first.
        next_address: what lies behind it, which it may run into.
        register_bytes: see `taken_bytes`.
        jumps_within: its computed jumps enter the piece behind them; otherwise they are errors.

    Raises:
        UserError: the frame is not known before it runs, grows in a loop, or a jump goes to a place not known.
    """
    found = Function(name, body[0].address)
    index_of = {instruction.address: index for index, instruction in enumerate(body)}
    depth_at: dict[int, int] = {}
    calls: dict[tuple[int, int], int] = {}
    indirect: dict[int, int] = {}
    waiting = [(0, body[0].address, 0)]
    while waiting:
        origin, address, depth = waiting.pop()
        if address not in index_of:
            calls[(origin, address)] = max(depth, calls.get((origin, address), 0))
            continue
        if depth <= depth_at.get(address, -1):
            continue
        if depth > FRAME_LIMIT_BYTES:
            raise UserError(f"{name} takes stack in a loop; an array of constant size is wanted in place of alloca().")
        depth_at[address] = depth
        index = index_of[address]
        instruction = body[index]
        if instruction.mnemonic == ".word":
            continue
        taken = taken_bytes(instruction, register_bytes)
        # What is given back under a condition may still be held behind it.
        held = depth if taken is not None and taken < 0 and _conditional(instruction) else max(depth + (taken or 0), 0)
        after = 0 if taken is None else held
        found.frame_bytes = max(found.frame_bytes, after)
        found.unmasks |= instruction.mnemonic.startswith("cpsie")
        following = body[index + 1].address if index + 1 < len(body) else next_address
        leaves = _leaves(instruction)
        place = _PLACE.search(instruction.operands)
        if leaves == "call" and place is not None:
            calls[(address, int(place[1], 16))] = after
        elif leaves == "pointer":
            indirect[address] = after
        elif leaves == "jump" and place is not None:
            waiting.append((address, int(place[1], 16), after))
        elif leaves == "table":
            waiting += [(address, target, after) for target in _table(body, index)]
        elif leaves == "veneer":
            waiting.append((address, _table(body, index)[0] & ~1, after))
        elif leaves == "within":
            if not jumps_within:
                raise UserError(
                    f"{name} computes where it jumps at {address:x}, and firmware/stack.toml does not list it."
                )
            waiting += [(address, target, after) for target in _piece(body, index)]
        ends = leaves in ("return", "table", "jump", "veneer", "within") or (
            leaves == "pointer" and instruction.mnemonic.startswith("bx")
        )
        # A jump table is left under a condition as well: what it does not hold runs on.
        if not ends or _conditional(instruction) or instruction.mnemonic in ("cbz", "cbnz"):
            waiting.append((address, following, after))
    found.calls = [(target, depth) for (_, target), depth in calls.items()]
    found.indirect = list(indirect.items())
    return found
