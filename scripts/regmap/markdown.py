# SPDX-License-Identifier: Apache-2.0
"""Reference page of the registers and the result record."""

from scripts.regmap.model import Block, Field, Register, RegisterMap, Ring

ACCESS = {"ro": "read", "constant": "read", "rw": "read, write", "w1c": "read, write 1 to clear"}

BUS = """## Bus

AXI4-Lite, 32 bit, a 4 KiB window. The low two address bits are ignored; byte strobes are honoured.
An offset that is not in the table answers SLVERR (reads give 0).
A write to a read-only field is ignored and answers OKAY."""
INTERRUPT = "Interrupt: high while any bit of `IRQ_STATUS` that is enabled in `IRQ_ENABLE` is set, one clock later."


def export(register_map: RegisterMap) -> str:
    """Text of the reference page in docs."""
    has_interrupt = any(field.enabled_by for register in register_map.registers for field in register.fields)
    lines = [
        f"# {register_map.title}",
        "",
        f"Generated from `{register_map.source}` by `python -m scripts.regmap`; edit that file, not this page.",
        "How the generator works, and why it has its own exporters, is told in [regmap.md](regmap.md).",
        "",
        register_map.desc,
        "",
        BUS,
        *([INTERRUPT] if has_interrupt else []),
        "",
        "## Registers",
        "",
        "| offset | register | meaning |",
        "|---|---|---|",
    ]
    for register in register_map.registers:
        lines.append(
            f"| `0x{register.offset:02X}` | [`{register.name}`](#{register.name.lower()}) | {register.title} |"
        )
    for register in register_map.registers:
        lines += [
            "",
            f"### {register.name}",
            "",
            f"`0x{register.offset:02X}`. {register.title}. {register.desc}".rstrip(),
        ]
        lines += ["", "| bits | field | access | reset | meaning |", "|---|---|---|---|---|"]
        lines += [_field(field) for field in register.fields]
    if register_map.ring:
        lines += _records(register_map.ring)
    return "\n".join(lines) + "\n"


def _records(ring: Ring) -> list[str]:
    return [
        "",
        "## Result ring",
        "",
        f"{ring.buffers} buffers, {ring.stride} bytes apart, from `RING_BASE`. "
        f"A buffer holds a header of {ring.header.size} bytes and {ring.objects.count} objects of "
        f"{ring.objects.size} bytes ({ring.record_size} bytes in use). All values are little endian.",
        *_block("Header", "struct landing_result_header", ring.header),
        *_block("Object", "struct landing_object", ring.objects),
    ]


def _bits(field: Field) -> str:
    return f"{field.lsb}" if field.width == 1 else f"{field.lsb + field.width - 1}:{field.lsb}"


def _reset(field: Field) -> str:
    return "hardware" if field.reset is None else f"`0x{field.reset:X}`"


def _field(field: Field) -> str:
    return f"| {_bits(field)} | `{field.name}` | {ACCESS[field.access]} | {_reset(field)} | {field.desc} |"


def _block(title: str, struct: str, block: Block) -> list[str]:
    lines = ["", f"### {title}", "", f"`{struct}`. {block.desc}".rstrip()]
    lines += ["", "| byte | word | bits | field | member | meaning |", "|---|---|---|---|---|---|"]
    for register in block.registers:
        for field in register.fields:
            lines.append(
                f"| `0x{block.offset + register.offset:02X}` | {register.title} | {_bits(field)} | "
                f"`{field.name}` | `{_member(block, register, field)}` | {field.desc} |"
            )
    return lines


def _member(block: Block, register: Register, field: Field) -> str:
    """Name of the structure member that holds a field."""
    at = register.offset + (field.lsb // 8 if field.width == 16 else 0)
    return next(member.name for member in block.members if member.offset <= at < member.offset + member.size)
