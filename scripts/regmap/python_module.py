# SPDX-License-Identifier: Apache-2.0
"""Python module: register offsets and fields, and numpy dtypes of the result record."""

from scripts.regmap.model import SOURCE, Block, RegisterMap

PREAMBLE = f'''# SPDX-License-Identifier: Apache-2.0
"""Generated from {SOURCE} by python -m scripts.regmap. Do not edit."""

from typing import NamedTuple

import numpy as np


class Field(NamedTuple):
    """Bits of a register; access is "ro", "constant", "rw" or "w1c"; reset is 0 where hardware gives the value."""

    name: str
    lsb: int
    width: int
    access: str
    reset: int


class Register(NamedTuple):
    """One 32-bit register at a byte offset."""

    name: str
    offset: int
    fields: tuple[Field, ...]

'''


def export(register_map: RegisterMap) -> str:
    """Text of golden/generated/landing_regs.py."""
    lines = [PREAMBLE]
    for register in register_map.registers:
        lines.append(f"{register.name}_OFFSET = 0x{register.offset:02X}")
        for field in register.fields:
            name = f"{register.name}_{field.name.upper()}"
            lines += [f"{name}_MASK = 0x{field.mask:08X}", f"{name}_SHIFT = {field.lsb}"]
    lines += ["", "REGISTERS = ("]
    for register in register_map.registers:
        fields = [
            f'Field("{field.name}", {field.lsb}, {field.width}, "{field.access}", 0x{field.reset or 0:X}),'
            for field in register.fields
        ]
        lines += ["    Register(", f'        "{register.name}",', f"        0x{register.offset:02X},"]
        if len(fields) == 1:
            lines.append(f"        ({fields[0]}),")
        else:
            lines += ["        (", *(f"            {field}" for field in fields), "        ),"]
        lines.append("    ),")
    lines += [
        ")",
        "",
        f"RING_BUFFERS = {register_map.ring_buffers}",
        f"RING_STRIDE_BYTES = {register_map.ring_stride}",
        f"RECORD_MAX_OBJECTS = {register_map.objects.count}",
    ]
    for register in register_map.header.registers:
        for field in register.fields:
            name = f"HEADER_{register.name}_{field.name.upper()}"
            if field.width == 1:
                lines.append(f"{name}_MASK = 0x{field.mask:08X}")
            if field.reset:
                lines.append(f"{name} = 0x{field.reset:X}")
    lines += ["", *_dtype("HEADER_DTYPE", register_map.header), *_dtype("OBJECT_DTYPE", register_map.objects)]
    lines.append('RECORD_DTYPE = np.dtype([("header", HEADER_DTYPE), ("objects", OBJECT_DTYPE, RECORD_MAX_OBJECTS)])')
    return "\n".join(lines) + "\n"


def _dtype(name: str, block: Block) -> list[str]:
    members = [f'        ("{member.name}", "<u{member.size}"),' for member in block.members]
    return [f"{name} = np.dtype(", "    [", *members, "    ]", ")"]
