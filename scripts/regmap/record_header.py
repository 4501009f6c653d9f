# SPDX-License-Identifier: Apache-2.0
"""Verilog header: geometry of the ring, and bit positions in the 512-bit header and object words."""

from scripts.errors import UserError
from scripts.regmap.model import Block, RegisterMap


def export(register_map: RegisterMap) -> str:
    """Text of rtl/generated/result_record.vh."""
    ring = register_map.ring
    if ring is None:
        raise UserError(f"{register_map.source} holds no records.")
    constants = {
        "RING_BUFFERS": ring.buffers,
        "RING_STRIDE": ring.stride,
        "RECORD_MAX_OBJECTS": ring.objects.count,
        "RECORD_OBJECTS_OFFSET": ring.objects.offset,
        "HEADER_BYTES": ring.header.size,
        "OBJECT_BYTES": ring.objects.size,
        **_positions("HEADER", ring.header),
        **_positions("OBJECT", ring.objects),
    }
    lines = [
        "// SPDX-License-Identifier: Apache-2.0",
        f"// Generated from {register_map.source} by python -m scripts.regmap. Do not edit.",
        "// Include inside a module. *_LSB counts bits from bit 0 of the 512-bit header or object.",
        *(f"localparam integer {name} = {value};" for name, value in constants.items()),
        *_values("HEADER", ring.header),
    ]
    return "\n".join(lines) + "\n"


def _positions(prefix: str, block: Block) -> dict[str, int]:
    positions = {}
    for member in block.members:
        positions[f"{prefix}_{member.name.upper()}_LSB"] = member.offset * 8
        positions[f"{prefix}_{member.name.upper()}_WIDTH"] = member.size * 8
    for register in block.registers:
        for field in register.fields:
            name = f"{prefix}_{register.name}_{field.name.upper()}"
            if field.width == 1:
                positions[f"{name}_LSB"] = register.offset * 8 + field.lsb
    return positions


def _values(prefix: str, block: Block) -> list[str]:
    return [
        f"localparam [{field.width - 1}:0] {prefix}_{register.name}_{field.name.upper()}_VALUE = "
        f"{field.width}'h{field.reset:X};"
        for register in block.registers
        for field in register.fields
        if field.reset
    ]
