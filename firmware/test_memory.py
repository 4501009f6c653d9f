# SPDX-License-Identifier: Apache-2.0
"""How the result ring reaches the processor unharmed: barriers in the ELF, and the MMU's table on QEMU's Zynq."""

import re
import subprocess
from collections.abc import Iterator
from typing import NamedTuple

import pytest

from firmware.library import BUILD, make
from firmware.qemu_board import Board, running
from golden.generated.landing_regs import HEADER_DTYPE

ELF = BUILD / "touchdown.elf"
MB = 1 << 20
FAULT, SECTION = 0b00, 0b10
NORMAL_CACHED, NORMAL_UNCACHED, DEVICE = (1, 1, 1), (1, 0, 0), (0, 0, 1)
"""TEX, C and B of a section, as the ARMv7-A manual has them."""


class Instruction(NamedTuple):
    """One of a listing: its name, and what it works on."""

    name: str
    operands: str


@pytest.fixture(scope="module")
def copy() -> list[Instruction]:
    """What the compiler made of record_copy_from_ring."""
    make("elf")
    command = ["arm-none-eabi-objdump", "-d", "--no-show-raw-insn", "--disassemble=record_copy_from_ring", str(ELF)]
    listing = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    found = re.findall(r"^ +[0-9a-f]+:\t(\S+)(?:\t(.*))?$", listing, re.MULTILINE)
    assert found, listing
    return [Instruction(name, operands.split("\t@")[0].strip()) for name, operands in found]


def test_a_barrier_stands_before_and_after_the_copy(copy: list[Instruction]) -> None:
    """Number, barrier, copy, barrier, number: the ring is memory to the processor, which else reads in any order."""
    offset = HEADER_DTYPE.fields["frame_number"][1]
    kept = [one.operands.split(", ") for one in copy if one.name == "mov"]
    # The buffer's address comes in r1 and may be kept elsewhere.
    numbered = tuple(f"[{base}, #{offset}]" for base in ["r1", *(to for to, origin in kept if origin == "r1")])
    barriers = [index for index, one in enumerate(copy) if one.name == "dmb"]
    loads = [index for index, one in enumerate(copy) if one.name.startswith("ld") or one.name.startswith("vld")]
    numbers = [index for index in loads if copy[index].operands.endswith(numbered)]
    assert len(numbers) == len(barriers) >= 2, copy
    assert loads[0] == numbers[0] < barriers[0] < loads[1], "the first number is read first, then comes a barrier"
    calls = [index for index, one in enumerate(copy) if one.name == "bl"]
    assert all(barriers[0] < index < barriers[1] for index in calls), "what is copied is copied between the barriers"
    for index in numbers[1:]:
        # On each way out: all reads of the copy stand before the barrier, none between it and the number.
        assert copy[index - 1].name == "dmb", copy[index - 3 : index + 1]
    assert {copy[index].operands for index in barriers} <= {"ish", "sy"}


@pytest.fixture(scope="module")
def board(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Board]:
    with running(tmp_path_factory.mktemp("board")) as one:
        one.wait_for("HEARTBEAT", "")
        yield one


def variables() -> dict[str, range]:
    """Addresses of the ELF's variables that are 0 at the start."""
    listing = subprocess.run(["arm-none-eabi-nm", "-S", str(ELF)], capture_output=True, text=True, check=True).stdout
    found = re.findall(r"^([0-9a-f]+) ([0-9a-f]+) [bB] (\w+)$", listing, re.MULTILINE)
    return {name: range(int(start, 16), int(start, 16) + int(size, 16)) for start, size, name in found}


def attributes(board: Board, address: int) -> tuple[int, int, int] | None:
    """TEX, C and B of the megabyte that holds an address; None where nothing is mapped."""
    word = board.word(variables()["table"].start + 4 * (address // MB))
    if word & 0b11 == FAULT:
        return None
    assert word & 0b11 == SECTION
    assert word // MB == address // MB, "not mapped onto itself"
    return word >> 12 & 0b111, word >> 3 & 1, word >> 2 & 1


@pytest.mark.parametrize("name", ["ring", "keep"])
def test_what_is_not_the_processors_alone_is_not_cached(board: Board, name: str) -> None:
    """The HP port writes past the caches; and a reset does not write them back."""
    place = variables()[name]
    assert place.start // MB == (place.stop - 1) // MB, "it has more than the megabyte that is not cached"
    assert attributes(board, place.start) == NORMAL_UNCACHED


@pytest.mark.parametrize(
    ("address", "expected"),
    [
        (0x0000_0000, None),
        (0x0010_0000, NORMAL_CACHED),
        (0x01F0_0000, NORMAL_CACHED),
        (0x0210_0000, None),
        (0x43C0_0000, DEVICE),
        (0x8000_0000, None),
        (0xE000_0000, DEVICE),
        (0xF800_0000, DEVICE),
        (0xF8F0_0000, DEVICE),
        (0xFFF0_0000, None),
    ],
)
def test_the_rest_of_the_table(board: Board, address: int, expected: tuple[int, int, int] | None) -> None:
    assert attributes(board, address) == expected
