# SPDX-License-Identifier: Apache-2.0
"""The part of the elaborated SystemRDL that the exporters need, checked for what they support."""

from dataclasses import dataclass
from pathlib import Path

from systemrdl import RDLCompileError, RDLCompiler
from systemrdl.messages import MessagePrinter, Severity
from systemrdl.node import AddrmapNode, FieldNode, RegfileNode, RegNode
from systemrdl.rdltypes import AccessType, OnWriteType

from scripts.errors import UserError

UNITS = ("us", "mm")


@dataclass(frozen=True)
class Field:
    """One bit field. `access` is "ro" (hardware value), "constant", "rw" or "w1c".

    `pulses`: hardware is told when software writes the register.
    """

    name: str
    lsb: int
    width: int
    access: str
    reset: int | None
    desc: str
    to_hardware: bool
    pulses: bool
    latched_by: str | None
    enabled_by: str | None

    @property
    def mask(self) -> int:
        """Mask of the field at its place in the word."""
        return ((1 << self.width) - 1) << self.lsb


@dataclass(frozen=True)
class Register:
    """One 32-bit word at a byte offset from its parent."""

    name: str
    title: str
    desc: str
    offset: int
    fields: tuple[Field, ...]


@dataclass(frozen=True)
class Member:
    """One member of a C structure or numpy dtype: 2, 4 or 8 bytes at a byte offset."""

    name: str
    offset: int
    size: int


@dataclass(frozen=True)
class Block:
    """Header or object of the result record."""

    title: str
    desc: str
    offset: int
    size: int
    count: int
    registers: tuple[Register, ...]
    members: tuple[Member, ...]


@dataclass(frozen=True)
class Ring:
    """Records in memory: `buffers` of them, `stride` bytes apart."""

    header: Block
    objects: Block
    record_size: int
    buffers: int
    stride: int


@dataclass(frozen=True)
class RegisterMap:
    """Everything that is generated comes from here. `source` is the file, `module` the slave."""

    source: str
    module: str
    title: str
    desc: str
    registers: tuple[Register, ...]
    ring: Ring | None

    @property
    def prefix(self) -> str:
        """Of names in C: LANDING for landing_regs."""
        return self.module.removesuffix("_regs").upper()


class _Quiet(MessagePrinter):
    """Collects the compiler's messages, so that they become one sentence."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def print_message(self, severity: Severity, text: str, src_ref: object) -> None:
        """Keep one message with its place."""
        line = getattr(src_ref, "start_line", None)
        self.lines.append(f"line {line}: {text}" if line else text)


@dataclass(frozen=True)
class Source:
    """A file that is the one source of a register map, the addrmap in it, and its addrmap of records, if any."""

    path: str
    module: str
    ring: str | None = None


def load(root: Path, source: Source) -> RegisterMap:
    """Compile the file of `source` below `root`.

    Raises:
        UserError: it is not valid SystemRDL, or holds what the exporters do not support.
    """
    path = root / source.path
    printer = _Quiet()
    compiler = RDLCompiler(message_printer=printer)
    try:
        compiler.compile_file(str(path))
        top = compiler.elaborate(source.module).top
        ring = compiler.elaborate(source.ring).top if source.ring else None
    except RDLCompileError as error:
        raise UserError(f"{path.name} is not valid SystemRDL: {'; '.join(printer.lines)}.") from error
    return RegisterMap(
        source=source.path,
        module=source.module,
        title=top.get_property("name"),
        desc=top.get_property("desc"),
        registers=_registers(top),
        ring=_ring(ring) if ring else None,
    )


def _ring(node: AddrmapNode) -> Ring:
    record = _only_child(node)
    header, objects = record.children()
    return Ring(_block(header), _block(objects), record.size, record.array_dimensions[0], record.array_stride)


def _only_child(ring: AddrmapNode) -> AddrmapNode:
    (record,) = ring.children()
    if not isinstance(record, AddrmapNode) or record.array_dimensions is None:
        raise UserError("result_ring must hold one array of result_record.")
    return record


def _block(node: RegfileNode) -> Block:
    registers = _registers(node)
    return Block(
        title=node.get_property("name"),
        desc=node.get_property("desc") or "",
        offset=node.raw_address_offset,
        size=node.size,
        count=node.array_dimensions[0] if node.array_dimensions else 1,
        registers=registers,
        members=_members(registers),
    )


def _registers(parent: AddrmapNode | RegfileNode) -> tuple[Register, ...]:
    registers = []
    for node in parent.children():
        if not isinstance(node, RegNode) or node.is_array or node.get_property("regwidth") != 32:
            raise UserError(f"{node.inst_name}: the exporters support plain 32-bit registers only.")
        registers.append(
            Register(
                name=node.inst_name,
                title=node.get_property("name"),
                desc=node.get_property("desc") or "",
                offset=node.address_offset,
                fields=tuple(_field(field) for field in node.fields()),
            )
        )
    return tuple(registers)


def _field(node: FieldNode) -> Field:
    reset = node.get_property("reset")
    latch = node.get_property("we")
    enable = node.get_property("enable")
    return Field(
        name=node.inst_name,
        lsb=node.lsb,
        width=node.width,
        access=_access(node),
        reset=int(reset) if reset is not None else None,
        desc=node.get_property("desc") or "",
        to_hardware=node.get_property("hw") in (AccessType.r, AccessType.rw),
        pulses=bool(node.get_property("swmod")),
        latched_by=latch.node.parent.inst_name if latch else None,
        enabled_by=f"{enable.parent.inst_name}.{enable.inst_name}" if enable else None,
    )


def _access(node: FieldNode) -> str:
    software, hardware = node.get_property("sw"), node.get_property("hw")
    if node.get_property("onwrite") == OnWriteType.woclr and node.get_property("hwset"):
        return "w1c"
    if software == AccessType.r and hardware == AccessType.w:
        return "ro"
    if software == AccessType.r and hardware == AccessType.na:
        return "constant"
    if software == AccessType.rw and hardware in (AccessType.r, AccessType.na) and not node.get_property("onwrite"):
        return "rw"
    raise UserError(f"{node.get_path()}: the exporters support hw=w, constant, rw and woclr with hwset only.")


def _members(registers: tuple[Register, ...]) -> tuple[Member, ...]:
    """Structure members of a block.

    X_LO with X_HI is one 64-bit member; two 16-bit fields are two members `x_field`; any other word is one 32-bit
    member. A field that is named after a unit gives its name to the member: START_TIME_LO.us -> start_time_us.
    """
    members = []
    names = [register.name for register in registers]
    for register in registers:
        base, fields = register.name, register.fields
        if base.endswith("_HI") and f"{base[:-3]}_LO" in names:
            continue
        size = 4
        if base.endswith("_LO") and f"{base[:-3]}_HI" in names:
            base, size = base[:-3], 8
        if len(fields) == 2 and all(field.width == 16 for field in fields):
            members += [Member(f"{base}_{f.name}".lower(), register.offset + f.lsb // 8, 2) for f in fields]
            continue
        unit = f"_{fields[0].name}" if len(fields) == 1 and fields[0].name in UNITS else ""
        members.append(Member(f"{base}{unit}".lower(), register.offset, size))
    return tuple(members)
