# SPDX-License-Identifier: Apache-2.0
"""Verilog header: geometry of the ring, and bit positions in the 512-bit header and object words."""

from scripts.regmap.model import SOURCE, Block, RegisterMap


def export(register_map: RegisterMap) -> str:
    """Text of rtl/generated/result_record.vh."""
    constants = {
        "RING_BUFFERS": register_map.ring_buffers,
        "RING_STRIDE": register_map.ring_stride,
        "RECORD_MAX_OBJECTS": register_map.objects.count,
        "RECORD_OBJECTS_OFFSET": register_map.objects.offset,
        "HEADER_BYTES": register_map.header.size,
        "OBJECT_BYTES": register_map.objects.size,
        **_positions("HEADER", register_map.header),
        **_positions("OBJECT", register_map.objects),
    }
    lines = [
        "// SPDX-License-Identifier: Apache-2.0",
        f"// Generated from {SOURCE} by python -m scripts.regmap. Do not edit.",
        "// Include inside a module. *_LSB counts bits from bit 0 of the 512-bit header or object.",
        *(f"localparam integer {name} = {value};" for name, value in constants.items()),
        *_values("HEADER", register_map.header),
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
