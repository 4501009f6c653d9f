# SPDX-License-Identifier: Apache-2.0
"""C11 header: register offsets, field masks, and the structures of the result record with checked layout."""

from scripts.regmap.model import Block, Register, RegisterMap, Ring

C_TYPES = {2: "uint16_t", 4: "uint32_t", 8: "uint64_t"}


def export(register_map: RegisterMap) -> str:
    """Text of the header in firmware/generated."""
    guard = f"{register_map.module.upper()}_H"
    prefix = f"{register_map.prefix}_REG"
    lines = [
        "// SPDX-License-Identifier: Apache-2.0",
        f"// Generated from {register_map.source} by python -m scripts.regmap. Do not edit.",
        f"#ifndef {guard}",
        f"#define {guard}",
        *(["", "#include <stddef.h>", "#include <stdint.h>"] if register_map.ring else []),
        "",
        "// Registers: byte offsets from their base; fields as masks in place.",
    ]
    for register in register_map.registers:
        lines.append(f"#define {prefix}_{register.name}_OFFSET 0x{register.offset:02x}u")
        lines += _fields(f"{prefix}_{register.name}", register)
    if register_map.ring:
        lines += _records(register_map.ring)
    return "\n".join([*lines, "", "#endif"]) + "\n"


def _records(ring: Ring) -> list[str]:
    lines = [
        "",
        "// Result ring: buffers of LANDING_RING_STRIDE_BYTES, each begins with a struct landing_record.",
        f"#define LANDING_RING_BUFFERS {ring.buffers}u",
        f"#define LANDING_RING_STRIDE_BYTES {ring.stride}u",
        f"#define LANDING_RECORD_MAX_OBJECTS {ring.objects.count}u",
    ]
    for register in ring.header.registers:
        if len(register.fields) > 1 and any(field.width != 16 or field.reset for field in register.fields):
            lines += _fields(f"LANDING_HEADER_{register.name}", register)
    lines += _struct("landing_result_header", ring.header)
    lines += _struct("landing_object", ring.objects)
    return [
        *lines,
        "",
        "struct landing_record {",
        "    struct landing_result_header header;",
        "    struct landing_object objects[LANDING_RECORD_MAX_OBJECTS];",
        "};",
        _check("offsetof(struct landing_record, objects)", ring.objects.offset),
        _check("sizeof(struct landing_record)", ring.record_size),
        '_Static_assert(sizeof(struct landing_record) <= LANDING_RING_STRIDE_BYTES, "a record fits into a buffer");',
    ]


def _fields(prefix: str, register: Register) -> list[str]:
    lines = []
    for field in register.fields:
        name = f"{prefix}_{field.name.upper()}"
        lines.append(f"#define {name}_MASK 0x{field.mask:08x}u")
        lines.append(f"#define {name}_SHIFT {field.lsb}u")
        if field.reset is not None:
            lines.append(f"#define {name}_RESET 0x{field.reset:x}u")
    return lines


def _struct(name: str, block: Block) -> list[str]:
    members = [f"    {C_TYPES[member.size]} {member.name};" for member in block.members]
    checks = [_check(f"offsetof(struct {name}, {member.name})", member.offset) for member in block.members]
    return ["", f"struct {name} {{", *members, "};", *checks, _check(f"sizeof(struct {name})", block.size)]


def _check(expression: str, value: int) -> str:
    return f'_Static_assert({expression} == {value}, "layout of the result record");'
