# SPDX-License-Identifier: Apache-2.0
"""AXI4-Lite slave in Verilog-2001 with flat ports."""

from scripts.regmap.model import Field, Register, RegisterMap

ADDR_WIDTH = 12

CONTRACT = """\
// Latency: read data one clock after the address is taken; write response two clocks after the later of address and
// data. Throughput: one read and one write in two clocks, independent of each other.
// AW and W are taken in any order. Ready depends on registers only, never on the valid of its channel.
// The low two address bits are ignored. Unmapped offsets answer SLVERR, read 0 and change nothing; writes to read-only
// fields are ignored with OKAY. Byte strobes are honoured in every field."""
INTERRUPT = """\
// Interrupt: irq = OR of enabled status bits, registered. A set and a clear in one clock leave the status bit set."""
WRITTEN = "// <register>_<field>_written is 1 in the clock in which a write has arrived in that register."
LIMITS = """\
// Border, rounding: none, no picture. Overflow: none; counters are those of the cores that own them.
// Limits: AxPROT is ignored.

`default_nettype none
"""

BUS_PORTS = [
    "input wire clk",
    "input wire rst",
    f"input wire [{ADDR_WIDTH - 1}:0] s_axil_awaddr",
    "input wire [2:0] s_axil_awprot",
    "input wire s_axil_awvalid",
    "output wire s_axil_awready",
    "input wire [31:0] s_axil_wdata",
    "input wire [3:0] s_axil_wstrb",
    "input wire s_axil_wvalid",
    "output wire s_axil_wready",
    "output wire [1:0] s_axil_bresp",
    "output wire s_axil_bvalid",
    "input wire s_axil_bready",
    f"input wire [{ADDR_WIDTH - 1}:0] s_axil_araddr",
    "input wire [2:0] s_axil_arprot",
    "input wire s_axil_arvalid",
    "output wire s_axil_arready",
    "output wire [31:0] s_axil_rdata",
    "output wire [1:0] s_axil_rresp",
    "output wire s_axil_rvalid",
    "input wire s_axil_rready",
]

BUS = f"""
    localparam [1:0] OKAY = 2'b00;
    localparam [1:0] SLVERR = 2'b10;

    wire unused = &{{1'b0, s_axil_awprot, s_axil_arprot, s_axil_awaddr[1:0], s_axil_araddr[1:0]}};

    // A write waits until address and data are both held and the response register is free.
    reg aw_held_reg;
    reg w_held_reg;
    reg [{ADDR_WIDTH - 3}:0] aw_word_reg;
    reg [31:0] w_data_reg;
    reg [3:0] w_strb_reg;
    reg bvalid_reg;
    reg [1:0] bresp_reg;

    assign s_axil_awready = !aw_held_reg;
    assign s_axil_wready = !w_held_reg;
    assign s_axil_bvalid = bvalid_reg;
    assign s_axil_bresp = bresp_reg;

    wire write = aw_held_reg && w_held_reg && (!bvalid_reg || s_axil_bready);
    reg write_mapped;

    always @(posedge clk) begin
        if (s_axil_awvalid && s_axil_awready) begin
            aw_held_reg <= 1'b1;
            aw_word_reg <= s_axil_awaddr[{ADDR_WIDTH - 1}:2];
        end
        if (s_axil_wvalid && s_axil_wready) begin
            w_held_reg <= 1'b1;
            w_data_reg <= s_axil_wdata;
            w_strb_reg <= s_axil_wstrb;
        end
        if (s_axil_bready) bvalid_reg <= 1'b0;
        if (write) begin
            aw_held_reg <= 1'b0;
            w_held_reg <= 1'b0;
            bvalid_reg <= 1'b1;
            bresp_reg <= write_mapped ? OKAY : SLVERR;
        end
        if (rst) begin
            aw_held_reg <= 1'b0;
            w_held_reg <= 1'b0;
            bvalid_reg <= 1'b0;
        end
    end

    reg rvalid_reg;
    reg [1:0] rresp_reg;
    reg [31:0] rdata_reg;
    reg [31:0] read_data;
    reg read_mapped;

    assign s_axil_arready = !rvalid_reg;
    assign s_axil_rvalid = rvalid_reg;
    assign s_axil_rresp = rresp_reg;
    assign s_axil_rdata = rdata_reg;

    wire read = s_axil_arvalid && s_axil_arready;
    wire [{ADDR_WIDTH - 3}:0] read_word = s_axil_araddr[{ADDR_WIDTH - 1}:2];

    always @(posedge clk) begin
        if (s_axil_rready) rvalid_reg <= 1'b0;
        if (read) begin
            rvalid_reg <= 1'b1;
            rresp_reg <= read_mapped ? OKAY : SLVERR;
            rdata_reg <= read_data;
        end
        if (rst) rvalid_reg <= 1'b0;
    end
"""


def export(register_map: RegisterMap, page: str) -> str:
    """Text of the slave; `page` describes its registers."""
    registers = register_map.registers
    fields = [field for register in registers for field in register.fields]
    has_interrupt = any(field.enabled_by for field in fields)
    lines = [
        "// SPDX-License-Identifier: Apache-2.0",
        f"// Generated from {register_map.source} by python -m scripts.regmap. Do not edit.",
        "//",
        f"// {register_map.module}: {register_map.desc} {page} is the reference.",
        "//",
        CONTRACT,
        *([INTERRUPT] if has_interrupt else []),
        *([WRITTEN] if any(field.pulses for field in fields) else []),
        LIMITS,
        f"module {register_map.module} (",
    ]
    ports = BUS_PORTS + [port for register in registers for port in _ports(register)]
    ports += ["output wire irq"] if has_interrupt else []
    lines += [f"    {port}," for port in ports[:-1]] + [f"    {ports[-1]}", ");"]
    lines.append(BUS.rstrip("\n"))
    lines += _declarations(registers)
    lines += _updates(registers)
    lines += _decoders(registers)
    lines += _interrupt(registers) if has_interrupt else [""]
    lines += ["endmodule", "", "`default_nettype wire"]
    return "\n".join(lines) + "\n"


def _range(field: Field) -> str:
    return f"[{field.width - 1}:0] " if field.width > 1 else ""


def _name(register: Register, field: Field) -> str:
    return f"{register.name}_{field.name}".lower()


def _ports(register: Register) -> list[str]:
    ports = []
    for field in register.fields:
        name = _name(register, field)
        if field.access == "ro":
            ports.append(f"input wire {_range(field)}{name}")
        elif field.access == "w1c":
            ports.append(f"input wire {name}_set")
        elif field.access == "rw" and field.to_hardware:
            ports.append(f"output wire {_range(field)}{name}")
        if field.pulses:
            ports.append(f"output wire {name}_written")
    return ports


def _stored(registers: tuple[Register, ...]) -> list[tuple[Register, Field]]:
    return [(r, f) for r in registers for f in r.fields if f.access in ("rw", "w1c") or f.latched_by]


def _pulsing(registers: tuple[Register, ...]) -> list[tuple[Register, Field]]:
    return [(r, f) for r in registers for f in r.fields if f.pulses]


def _declarations(registers: tuple[Register, ...]) -> list[str]:
    lines = ["", "    // Fields."]
    for register, field in _stored(registers):
        lines.append(f"    reg {_range(field)}{_name(register, field)}_reg;")
    for register, field in _stored(registers):
        if field.access == "rw" and field.to_hardware:
            lines.append(f"    assign {_name(register, field)} = {_name(register, field)}_reg;")
    for register, field in _pulsing(registers):
        name = _name(register, field)
        lines += [f"    reg {name}_written_reg;", f"    assign {name}_written = {name}_written_reg;"]
    lines.append("")
    written = {r.name: r for r, f in _stored(registers) if f.access in ("rw", "w1c")}
    latching = {f.latched_by for _, f in _stored(registers) if f.latched_by}
    for register in registers:
        word = f"{ADDR_WIDTH - 2}'h{register.offset // 4:X}"
        if register.name in written:
            lines.append(f"    wire {register.name.lower()}_write = write && aw_word_reg == {word};")
        if register.name in latching:
            lines.append(f"    wire {register.name.lower()}_read = read && read_word == {word};")
    return lines


def _updates(registers: tuple[Register, ...]) -> list[str]:
    lines = ["", "    always @(posedge clk) begin"]
    for register, field in _stored(registers):
        name, write = _name(register, field), f"{register.name.lower()}_write"
        if field.access == "rw":
            lines += [f"        if ({write} && {lane}" for lane in _lanes(name, field)]
        elif field.access == "w1c":
            clear = f"{write} && w_strb_reg[{field.lsb // 8}] && w_data_reg[{field.lsb}]"
            lines += [
                f"        if ({name}_set) {name}_reg <= 1'b1;",
                f"        else if ({clear}) {name}_reg <= 1'b0;",
            ]
        else:
            lines.append(f"        if ({str(field.latched_by).lower()}_read) {name}_reg <= {name};")
    for register, field in _pulsing(registers):
        lines.append(f"        {_name(register, field)}_written_reg <= {register.name.lower()}_write;")
    lines.append("        if (rst) begin")
    lines += [f"            {_name(r, f)}_written_reg <= 1'b0;" for r, f in _pulsing(registers)]
    for register, field in _stored(registers):
        lines.append(f"            {_name(register, field)}_reg <= {field.width}'h{field.reset or 0:X};")
    return [*lines, "        end", "    end"]


def _lanes(name: str, field: Field) -> list[str]:
    """The rest of one statement for each byte that the field has bits in."""
    lanes = []
    end = field.lsb + field.width
    for byte in range(field.lsb // 8, (end + 7) // 8):
        low, high = max(field.lsb, 8 * byte), min(end, 8 * byte + 8) - 1
        data = f"[{low}]" if low == high else f"[{high}:{low}]"
        low, high = low - field.lsb, high - field.lsb
        part = "" if field.width == high - low + 1 else f"[{low}]" if low == high else f"[{high}:{low}]"
        lanes.append(f"w_strb_reg[{byte}]) {name}_reg{part} <= w_data_reg{data};")
    return lanes


def _decoders(registers: tuple[Register, ...]) -> list[str]:
    words = [f"{ADDR_WIDTH - 2}'h{register.offset // 4:X}" for register in registers]
    lines = ["", "    always @* begin", "        case (aw_word_reg)"]
    lines += [
        f"            {', '.join(words[i : i + 8])}{',' if i + 8 < len(words) else ':'}"
        for i in range(0, len(words), 8)
    ]
    lines += [
        "                write_mapped = 1'b1;",
        "            default: write_mapped = 1'b0;",
        "        endcase",
        "    end",
    ]
    lines += ["", "    always @* begin", "        read_mapped = 1'b1;", "        case (read_word)"]
    for word, register in zip(words, registers, strict=True):
        lines.append(f"            {word}: read_data = {_read_word(register)};  // {register.name}")
    lines += ["            default: begin", "                read_data = 32'h0;", "                read_mapped = 1'b0;"]
    return [*lines, "            end", "        endcase", "    end"]


def _read_word(register: Register) -> str:
    parts, top = [], 32
    for field in sorted(register.fields, key=lambda field: -field.lsb):
        gap = top - field.lsb - field.width
        parts += [f"{gap}'h0"] if gap else []
        parts.append(_read_field(register, field))
        top = field.lsb
    parts += [f"{top}'h0"] if top else []
    if len(parts) == 1:
        return parts[0]
    if len(", ".join(parts)) <= 80:
        return f"{{{', '.join(parts)}}}"
    indent = "\n                "
    return "{" + ",".join(indent + part for part in parts) + "\n            }"


def _read_field(register: Register, field: Field) -> str:
    if field.access == "constant":
        return f"{field.width}'h{field.reset or 0:X}"
    if field.access == "ro" and not field.latched_by:
        return _name(register, field)
    return f"{_name(register, field)}_reg"


def _interrupt(registers: tuple[Register, ...]) -> list[str]:
    terms = []
    for register in registers:
        for field in register.fields:
            if field.enabled_by:
                enable = field.enabled_by.replace(".", "_").lower()
                terms.append(f"{_name(register, field)}_reg && {enable}_reg")
    lines = [
        "",
        "    reg irq_reg;",
        "    assign irq = irq_reg;",
        "",
        "    always @(posedge clk) begin",
        "        irq_reg <=",
    ]
    lines += [f"            ({term}){' ||' if term != terms[-1] else ';'}" for term in terms]
    return [*lines, "        if (rst) irq_reg <= 1'b0;", "    end", ""]
