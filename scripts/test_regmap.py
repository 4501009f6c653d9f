# SPDX-License-Identifier: Apache-2.0
"""The generated files are those of the source, and C, Python and Verilog agree on every offset."""

import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from golden.generated import display_regs
from golden.generated import landing_regs as regs
from golden.registers import Register
from scripts.errors import UserError
from scripts.regmap.generate import EXPORTERS, LANDING, write_all
from scripts.regmap.model import Source, load

ROOT = Path(__file__).resolve().parents[1]
STRUCTS = {"landing_result_header": regs.HEADER_DTYPE, "landing_object": regs.OBJECT_DTYPE}


def test_generated_files_are_current(tmp_path: Path) -> None:
    """Regenerating changes nothing."""
    write_all(ROOT, tmp_path)
    old = [name for name in EXPORTERS if (ROOT / name).read_text() != (tmp_path / name).read_text()]
    assert not old, f"{', '.join(old)} differ from their .rdl; run make regmap and commit"


def test_the_command_names_files_as_the_project_does(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "scripts.regmap", "--out"]
    for out, prefix in ((tmp_path, f"{tmp_path}/"), (ROOT / "build/regmap", "build/regmap/")):
        run = subprocess.run([*command, str(out)], cwd=ROOT, check=True, capture_output=True, text=True)
        assert run.stdout.splitlines() == [prefix + name for name in EXPORTERS]


def named(prefix: str, registers: Sequence[Register]) -> dict[str, int]:
    """The constants of C for these registers, with the values that Python has."""
    constants = {}
    for register in registers:
        constants[f"{prefix}_REG_{register.name}_OFFSET"] = register.offset
        for field in register.fields:
            name = f"{prefix}_REG_{register.name}_{field.name.upper()}"
            constants[f"{name}_MASK"] = ((1 << field.width) - 1) << field.lsb
            constants[f"{name}_SHIFT"] = field.lsb
            if field.access != "ro":
                constants[f"{name}_RESET"] = field.reset
    return constants


def test_c_and_python_agree(tmp_path: Path) -> None:
    """A C program prints offsets, sizes, masks and constants; each equals the Python one."""
    expected = named("LANDING", regs.REGISTERS) | named("DISPLAY", display_regs.REGISTERS)
    for struct, dtype in STRUCTS.items():
        expected[f"sizeof(struct {struct})"] = dtype.itemsize
        for name in dtype.names:
            member, offset = dtype.fields[name][:2]
            expected[f"offsetof(struct {struct}, {name})"] = offset
            expected[f"sizeof(((struct {struct} *)0)->{name})"] = member.itemsize
    expected |= {
        "sizeof(struct landing_record)": regs.RECORD_DTYPE.itemsize,
        "offsetof(struct landing_record, objects)": regs.RECORD_DTYPE.fields["objects"][1],
        "LANDING_RING_BUFFERS": regs.RING_BUFFERS,
        "LANDING_RING_STRIDE_BYTES": regs.RING_STRIDE_BYTES,
        "LANDING_RECORD_MAX_OBJECTS": regs.RECORD_MAX_OBJECTS,
        "LANDING_HEADER_ID_VERSION_RESET": regs.HEADER_ID_VERSION,
        "LANDING_HEADER_ID_MAGIC_RESET": regs.HEADER_ID_MAGIC,
        "LANDING_HEADER_FLAGS_THRESHOLDS_MISSING_MASK": regs.HEADER_FLAGS_THRESHOLDS_MISSING_MASK,
        "LANDING_HEADER_FLAGS_THRESHOLDS_STALE_MASK": regs.HEADER_FLAGS_THRESHOLDS_STALE_MASK,
        "LANDING_HEADER_FLAGS_OBJECTS_OVERFLOW_MASK": regs.HEADER_FLAGS_OBJECTS_OVERFLOW_MASK,
        "LANDING_HEADER_FLAGS_ALTITUDE_VALID_MASK": regs.HEADER_FLAGS_ALTITUDE_VALID_MASK,
    }
    prints = "\n".join(f'    printf("%lu\\n", (unsigned long)({expression}));' for expression in expected)
    source = tmp_path / "print.c"
    headers = "".join(f"#include {name}\n" for name in ('"display_regs.h"', '"landing_regs.h"', "<stdio.h>"))
    source.write_text(f"{headers}int main(void)\n{{\n{prints}\n    return 0;\n}}\n")
    program = tmp_path / "print"
    include = f"-I{ROOT / 'firmware/generated'}"
    subprocess.run(["gcc", "-std=c11", "-Wall", "-Wextra", "-Werror", include, source, "-o", program], check=True)
    printed = subprocess.run([program], check=True, capture_output=True, text=True).stdout.split()
    got = dict(zip(expected, map(int, printed), strict=True))
    wrong = {name: (expected[name], got[name]) for name in expected if expected[name] != got[name]}
    assert not wrong, f"(Python, C) differ: {wrong}"


def test_verilog_and_python_agree() -> None:
    """The bit positions of the Verilog header are the byte offsets of the numpy dtypes."""
    text = (ROOT / "rtl/generated/result_record.vh").read_text()
    constants = {name: int(value) for name, value in re.findall(r"integer (\w+) = (\d+);", text)}
    for prefix, dtype in (("HEADER", regs.HEADER_DTYPE), ("OBJECT", regs.OBJECT_DTYPE)):
        assert constants[f"{prefix}_BYTES"] == dtype.itemsize
        for name in dtype.names:
            member, offset = dtype.fields[name][:2]
            assert constants[f"{prefix}_{name.upper()}_LSB"] == 8 * offset, name
            assert constants[f"{prefix}_{name.upper()}_WIDTH"] == 8 * member.itemsize, name
    assert constants["RING_BUFFERS"] == regs.RING_BUFFERS
    assert constants["RING_STRIDE"] == regs.RING_STRIDE_BYTES
    assert constants["RECORD_MAX_OBJECTS"] == regs.RECORD_MAX_OBJECTS
    assert constants["RECORD_OBJECTS_OFFSET"] == regs.RECORD_DTYPE.fields["objects"][1]
    assert constants["HEADER_FLAGS_ALTITUDE_VALID_LSB"] == 8 * 4 + 3
    for flag in ("THRESHOLDS_MISSING", "THRESHOLDS_STALE", "OBJECTS_OVERFLOW", "ALTITUDE_VALID"):
        bit = constants[f"HEADER_FLAGS_{flag}_LSB"] - constants["HEADER_FLAGS_LSB"]
        assert getattr(regs, f"HEADER_FLAGS_{flag}_MASK") == 1 << bit, flag


def test_names_of_registers_and_bits_match_status_and_enable() -> None:
    """An interrupt has the same name and place in IRQ_STATUS and IRQ_ENABLE."""
    registers = {register.name: register for register in load(ROOT, LANDING).registers}
    places = [[(field.name, field.lsb) for field in registers[name].fields] for name in ("IRQ_STATUS", "IRQ_ENABLE")]
    assert places[0] == places[1]


@pytest.mark.parametrize(
    ("good", "bad", "sentence"),
    [
        ("ID @ 0x00;", "ID @ 0x04;", "is not valid SystemRDL: .*overlap"),
        ("sw = r; hw = w; swacc;", "sw = rw; hw = rw; swacc;", "TIME_LO.us: the exporters support"),
    ],
)
def test_wrong_source_is_one_sentence(tmp_path: Path, good: str, bad: str, sentence: str) -> None:
    """Invalid SystemRDL, and a field kind without exporter, are refused with what is wrong."""
    text = (ROOT / LANDING.path).read_text()
    assert good in text
    source = tmp_path / "broken.rdl"
    source.write_text(text.replace(good, bad, 1))
    with pytest.raises(UserError, match=sentence):
        load(tmp_path, Source(source.name, LANDING.module, LANDING.ring))
