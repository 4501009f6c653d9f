# SPDX-License-Identifier: Apache-2.0
"""The ELF's stacks suffice, and the tool that says so finds what it is for. Replay: python -m scripts.stack_bound."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from firmware.library import BUILD, ROOT, make
from scripts import stack_bound
from scripts.errors import UserError
from scripts.stack_bound import Program, addresses_taken, check
from scripts.stack_frames import FRAME_LIMIT_BYTES, Instruction, taken_bytes

HEAP = re.compile(r"malloc|calloc|realloc|^_*free(_r)?$|sbrk")

TABLE = {
    "margin_percent": 25,
    "vectors": ["vectors"],
    "stacks": {
        "system": {"bottom": "low", "top": "high", "runs": ["start"], "interrupted_by": ["interrupt"]},
    },
    "pointers": {"interrupt": ["handler"]},
}
VECTORS = ["b {start}", "b {interrupt}"]
SOUND = {
    "vectors": VECTORS,
    "start": ["ldr sp, [pc, #4]", "bl {main}", "wfi"],
    "main": ["push {{r4, lr}}", "sub sp, sp, #16", "bl {leaf}", "add sp, sp, #16", "pop {{r4, pc}}"],
    "leaf": ["cmp r0, #0", "bxeq lr", "vpush {{d8-d10}}", "vpop {{d8-d10}}", "bx lr"],
    "interrupt": ["srsdb sp!, #31", "blx r3", "rfeia sp!"],
    "handler": ["str lr, [sp, #-4]!", "ldr pc, [sp], #4"],
}


def program(changes: dict[str, list[str]] | None = None, size: int = 200, **table: object) -> Program:
    """A program as objdump prints it, four bytes an instruction, functions 0x100 apart."""
    bodies = {**SOUND, **(changes or {})}
    places = {name: 0x1000 + 0x100 * index for index, name in enumerate(bodies)}
    shown = {name: f"{place:x} <{name}>" for name, place in places.items()}
    lines = []
    for name, body in bodies.items():
        lines.append(f"\n{places[name]:08x} <{name}>:")
        for index, text in enumerate(body):
            mnemonic, _, operands = text.format(**shown, here=f"{places[name]:x} <{name}>").partition(" ")
            lines.append(f"  {places[name] + 4 * index:x}:\t{mnemonic}\t{operands}")
    usage = [("main", 24, "static"), ("leaf", 24, "static"), ("handler", 4, "static")]
    return Program("\n".join(lines), {"low": 0, "high": size}, {}, usage, {"handler", "main_data"}, {**TABLE, **table})


def test_the_firmware_fits() -> None:
    """The bound of each stack, with the compiler's figure for every function of ours and its own for the library."""
    make("elf")
    command = [sys.executable, "-m", "scripts.stack_bound"]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    print(run.stdout)
    for stack in ("system", "abort", "undefined"):
        assert re.search(rf"^{stack}: \d+ of \d+ bytes", run.stdout, re.MULTILINE), run.stdout
    assert "main " in run.stdout
    assert re.search(r"\d{3} of them as -fstack-usage says", run.stdout), run.stdout


def test_there_is_no_heap() -> None:
    make("elf")
    names = set(stack_bound.output_of("nm", str(BUILD / "touchdown.elf")).split())
    assert "main" in names
    assert not [name for name in names if HEAP.search(name)]


def test_a_heap_would_be_seen() -> None:
    for name in ("malloc", "_malloc_r", "calloc", "realloc", "free", "_free_r", "_sbrk", "sbrk", "__malloc_free_list"):
        assert HEAP.search(name), name


def test_a_sound_program_is_added_up() -> None:
    lines = check(program())
    assert lines[0] == "system: 60 of 200 bytes (30.0 %)"
    assert lines[1] == "  48: start 0 > main 24 > leaf 24"
    assert lines[2] == "  12: interrupt 8 > handler 4"
    assert lines[3] == "5 functions, 3 of them as -fstack-usage says; no recursion"


def test_a_jump_table_and_code_before_a_label_are_followed() -> None:
    leaf = ["ldrls pc, [pc, ip, lsl #2]", "bx lr", ".word 0x1314", "nop", "nop", "sub sp, #24", "b {main_tail}"]
    lines = check(
        program({"leaf": [text.replace("{main_tail}", "1320 <leaf+0x20>") for text in leaf] + ["nop", "bx lr"]})
    )
    assert lines[1] == "  48: start 0 > main 24 > leaf 24"


FAULTS = {
    "recursion: main > leaf > main": {"leaf": ["vpush {{d8-d10}}", "bl {main}", "vpop {{d8-d10}}", "bx lr"]},
    "recursion: leaf > leaf": {"leaf": ["vpush {{d8-d10}}", "bl {leaf}", "vpop {{d8-d10}}", "bx lr"]},
    "leaf (in leaf, 1304) calls through a pointer": {"leaf": ["vpush {{d8-d10}}", "blx r3", "bx lr"]},
    "leaf (in leaf, 1300) calls through a pointer": {"leaf": ["bx r3"]},
    "takes stack by an amount that is not known": {"leaf": ["sub sp, sp, r0", "bx lr"]},
    "mov sp, r7 at 1300": {"leaf": ["mov sp, r7", "bx lr"]},
    "leaf takes stack in a loop": {"leaf": ["sub sp, sp, #64", "bne {leaf}", "bx lr"]},
    "leaf computes where it jumps": {"leaf": ["add pc, pc, r3", "bx lr"]},
    "leaf takes 28 bytes by its code, [24] by the compiler's word": {"leaf": ["vpush {{d8-d10}}", "push {{lr}}"]},
    "may need 188": {"main": ["sub sp, sp, #152", "bl {leaf}"]},
    "nothing is seen to call leaf": {"main": ["push {{r4, lr}}", "sub sp, sp, #16", "pop {{r4, pc}}"]},
    "handler lets interrupts in": {"handler": ["str lr, [sp, #-4]!", "cpsie i", "ldr pc, [sp], #4"]},
    "the vectors lead to leaf": {"vectors": [*VECTORS, "b {leaf}"]},
    "a call goes to 9000": {"leaf": ["bl 9000 <nowhere>"]},
    "lists a pointer call of interrupt, which makes none": {"interrupt": ["bl {handler}"]},
}


@pytest.mark.parametrize("sentence", FAULTS)
def test_a_fault_is_found(sentence: str) -> None:
    with pytest.raises(UserError, match=re.escape(sentence)):
        check(program(FAULTS[sentence]))


def test_a_frame_the_compiler_cannot_tell_is_found() -> None:
    planted = program()
    planted.usage.append(("other", 16, "dynamic,bounded"))
    with pytest.raises(UserError, match="other takes 16 bytes and more"):
        check(planted)


def test_an_address_that_is_taken_and_not_listed_is_found() -> None:
    planted = program()
    planted.taken.add("leaf")
    with pytest.raises(UserError, match="the address of leaf is taken"):
        check(planted)
    planted.taken.clear()
    with pytest.raises(UserError, match="lists handler under a pointer, but nothing takes its address"):
        check(planted)


def test_addresses_are_read_from_relocations() -> None:
    listing = """
main.o:     file format elf32-littlearm

SYMBOL TABLE:
00000000 l     F .text.static	00000018 static
00000000 g     F .text.main	00000018 main
00000000         *UND*	00000000 taken
00000000         *UND*	00000000 keep

RELOCATION RECORDS FOR [.text.main]:
OFFSET   TYPE              VALUE
00000008 R_ARM_CALL        called
00000048 R_ARM_MOVW_ABS_NC taken
00000048 R_ARM_MOVW_ABS_NC keep
0000004c R_ARM_ABS32       .text.static+0x00000001
00000050 R_ARM_ABS32       .text.main

RELOCATION RECORDS FOR [.debug_info]:
00000010 R_ARM_ABS32       .text.called

other.o:     file format elf32-littlearm

SYMBOL TABLE:
00000000 l     F .text.keep	00000018 keep
00000000 g     F .text.taken	00000018 taken
00000000 g     F .text.called	00000018 called
"""
    assert addresses_taken(listing) == {"taken", "static"}


def test_a_function_that_is_listed_and_absent_is_found() -> None:
    with pytest.raises(UserError, match="names gone, which the ELF does not have"):
        check(program(pointers={"interrupt": ["gone"]}))


@pytest.mark.parametrize(
    ("text", "taken"),
    [
        ("push {r4, r5, lr}", 12),
        ("vpop {d8-d15}", -64),
        ("stmdb.w sp!, {r4, lr}", 8),
        ("ldmia.w sp!, {r4, r5, pc}", -12),
        ("strd r4, r5, [sp, #-16]!", 16),
        ("ldr.w r4, [sp], #4", -4),
        ("subw sp, sp, #812", 812),
        ("addeq.w sp, sp, #8", -8),
        ("add r3, sp, #16", 0),
        ("stm sp, {r0, r1}", 0),
        ("str r0, [sp, #16]", 0),
        ("cmp sp, r0", 0),
        ("ldr sp, [pc, #220]", None),
    ],
)
def test_an_instruction_moves_the_stack(text: str, taken: int | None) -> None:
    mnemonic, _, operands = text.partition(" ")
    assert taken_bytes(Instruction(0, mnemonic, operands)) == taken


@pytest.mark.parametrize("text", ["ldr r4, [sp], r3", "and sp, sp, #4", "ldm r0, {r4, sp}", "strb r4, [sp, r2]!"])
def test_an_instruction_that_moves_it_by_who_knows_what_is_found(text: str) -> None:
    mnemonic, _, operands = text.partition(" ")
    with pytest.raises(UserError, match="not known"):
        taken_bytes(Instruction(0, mnemonic, operands))


def test_a_frame_of_one_array_is_no_loop() -> None:
    big = FRAME_LIMIT_BYTES // 2
    planted = program({"leaf": [f"sub sp, sp, #{big}", f"add sp, sp, #{big}", "bx lr"]}, size=4 * big)
    planted.usage[1] = ("leaf", big, "static")
    assert f"leaf {big}" in check(planted)[1]


@pytest.mark.parametrize("arguments", [["--elf", "no/such.elf"], ["--elf"], ["--nonsense"]])
def test_a_mistake_is_one_sentence(arguments: list[str], tmp_path: Path) -> None:
    command = [sys.executable, "-m", "scripts.stack_bound", *arguments]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert len(run.stderr.splitlines()) == 1
    assert run.stderr.startswith("touchdown: ")
