# SPDX-License-Identifier: Apache-2.0
"""Python module: register offsets and fields, and numpy dtypes of the result record."""

from scripts.regmap.model import Block, RegisterMap, Ring


def export(register_map: RegisterMap) -> str:
    """Text of the module in golden/generated."""
    lines = [
        "# SPDX-License-Identifier: Apache-2.0",
        f'"""Generated from {register_map.source} by python -m scripts.regmap. Do not edit."""',
        "",
        *(["import numpy as np", ""] if register_map.ring else []),
        "from golden.registers import Field, Register",
        "",
    ]
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
    lines.append(")")
    if register_map.ring:
        lines += _records(register_map.ring)
    return "\n".join(lines) + "\n"


def _records(ring: Ring) -> list[str]:
    lines = [
        "",
        f"RING_BUFFERS = {ring.buffers}",
        f"RING_STRIDE_BYTES = {ring.stride}",
        f"RECORD_MAX_OBJECTS = {ring.objects.count}",
    ]
    for register in ring.header.registers:
        for field in register.fields:
            name = f"HEADER_{register.name}_{field.name.upper()}"
            if field.width == 1:
                lines.append(f"{name}_MASK = 0x{field.mask:08X}")
            if field.reset:
                lines.append(f"{name} = 0x{field.reset:X}")
    lines += ["", *_dtype("HEADER_DTYPE", ring.header), *_dtype("OBJECT_DTYPE", ring.objects)]
    lines.append('RECORD_DTYPE = np.dtype([("header", HEADER_DTYPE), ("objects", OBJECT_DTYPE, RECORD_MAX_OBJECTS)])')
    return lines


def _dtype(name: str, block: Block) -> list[str]:
    members = [f'        ("{member.name}", "<u{member.size}"),' for member in block.members]
    return [f"{name} = np.dtype(", "    [", *members, "    ]", ")"]
