# SPDX-License-Identifier: Apache-2.0
"""Timing pictures of the core pages: WaveDrom JSON whose outputs are what the RTL does with its inputs.

A column is a clock: inputs change after its rising edge, outputs are read in its middle. Besides what WaveDrom knows,
the JSON says `parameters` of the core, `set` (inputs that keep a value), and `wait` (clocks between reset and the first
column). The wave of an input drives it; the wave of an output is made by `simulate`. The payload of a channel is drawn
as unknown while its valid is 0. A name may end in a range of bits, such as `m_axis_tdata[31:0]`.
"""

import json
import re
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from scripts.errors import UserError
from scripts.lint import include_flags
from tb.common.cores import ROOT, load_core

CLOCKS = ("clk", "pix_clk")
RESET_CLOCKS = 4
DATA = "23456789="
CHANNEL = re.compile(r"(.*axis_t|.*_axil?_(?:aw|ar|w|r|b))(?!valid|ready)\w+$")

Timing = dict[str, Any]
Ports = dict[str, tuple[str, int]]


def bare(name: str) -> str:
    """Name of the port that a signal shows."""
    return name.partition("[")[0]


def columns(timing: Timing) -> int:
    """Clocks that a picture shows."""
    return len(next(signal["wave"] for signal in timing["signal"] if signal.get("name") == "clk"))


def driven(wave: str, data: list[str], width: int) -> list[str]:
    """Verilog constants that an input has, one a column.

    Raises:
        ValueError: The wave has a character other than 0, 1, x, a data segment, or too few data.
    """
    values, rest = [], iter(data)
    for character in wave:
        if character == ".":
            values.append(values[-1])
        elif character in DATA:
            values.append(f"{width}'h{next(rest)}")
        elif character in "01":
            values.append(f"{width}'d{character}")
        elif character == "x":
            values.append(f"{width}'bx")
        else:
            raise ValueError(f"an input's wave has '{character}'")
    return values


def bench(core: str, timing: Timing, ports: Ports) -> str:
    """Verilog that plays the inputs and prints the shown outputs in binary, one line a column."""
    top = load_core(core).toplevel
    shown = [signal for signal in timing["signal"] if "wave" in signal and signal["name"] not in CLOCKS]
    outputs = [signal["name"] for signal in shown if ports[bare(signal["name"])][0] == "out"]
    inputs = {
        signal["name"]: driven(signal["wave"], signal.get("data", []), ports[signal["name"]][1])
        for signal in shown
        if ports[bare(signal["name"])][0] == "in"
    }
    lines = ["`timescale 1ns / 1ps", "module bench;", "reg clk = 0;", "always #5 clk = !clk;"]
    for name, (way, width) in ports.items():
        if name not in CLOCKS:
            lines.append(f"{'reg' if way == 'in' else 'wire'} [{width - 1}:0] {name};")
    parameters = ", ".join(f".{name}({value})" for name, value in timing.get("parameters", {}).items())
    connections = ", ".join(f".{name}({'clk' if name in CLOCKS else name})" for name in ports)
    lines += [f"{top} #({parameters}) dut ({connections});", "initial begin"]
    rest = [name for name, (way, _) in ports.items() if way == "in" and name not in CLOCKS]
    lines += [f"{name} = {timing.get('set', {}).get(name, 0)};" for name in rest]
    # A data wave has no value for before its first column: the bus is idle until then.
    lines += ["rst = 1;", f"repeat ({RESET_CLOCKS}) @(posedge clk);", "#1 rst = 0;"]
    lines += [f"repeat ({timing.get('wait', 4)}) @(posedge clk);", "#1;"]
    for column in range(columns(timing)):
        lines += [f"{name} = {values[column]};" for name, values in inputs.items()]
        lines.append(f'@(negedge clk) $display("{" ".join(["%b"] * len(outputs))}", {", ".join(outputs)});')
        lines.append("@(posedge clk) #1;")
    lines += ["$finish;", "end", "endmodule", ""]
    return "\n".join(lines)


def drawn(values: list[str]) -> tuple[str, list[str]]:
    """Wave and data of binary values, one a column; a value with an unknown bit is x."""
    wave, data, before = "", [], None
    for value in ("x" if set(value) - set("01") else value for value in values):
        if value == before:
            wave += "."
        elif len(value) == 1:
            wave += value
        else:
            wave += "="
            data.append(f"{int(value, 2):X}")
        before = value
    return wave, data


def simulate(core: str, timing: Timing, ports: Ports) -> Timing:
    """The same picture with the waves of all outputs as the RTL gives them, in Icarus Verilog.

    Raises:
        UserError: The picture names no port of the core, or does not elaborate.
    """
    strange = [signal["name"] for signal in timing["signal"] if "name" in signal and bare(signal["name"]) not in ports]
    if strange:
        raise UserError(f"the timing of docs/cores/{core}.md shows {strange[0]}, which is no port of the core.")
    with tempfile.TemporaryDirectory() as folder:
        source, program = Path(folder) / "bench.v", Path(folder) / "bench.vvp"
        source.write_text(bench(core, timing, ports), encoding="utf-8")
        sources = [str(path) for path in load_core(core).sources]
        build = ["iverilog", "-g2005", *include_flags(), "-s", "bench", "-o", str(program), str(source), *sources]
        result = subprocess.run(build, cwd=ROOT, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            raise UserError(f"the timing of docs/cores/{core}.md does not elaborate: {result.stderr.splitlines()[0]}.")
        run = subprocess.run(["vvp", "-n", str(program)], capture_output=True, text=True, check=True)
    lines = [line.split() for line in run.stdout.splitlines() if re.fullmatch(r"[01xz ]+", line)]
    outputs = [
        s for s in timing["signal"] if s.get("name") not in (None, *CLOCKS) and ports[bare(s["name"])][0] == "out"
    ]
    got = {signal["name"]: list(values) for signal, values in zip(outputs, zip(*lines, strict=True), strict=True)}
    signals = []
    for signal in timing["signal"]:
        if signal.get("name") not in got:
            signals.append(signal)
            continue
        wave, data = drawn(while_valid(signal["name"], got))
        signals.append({"name": signal["name"], "wave": wave} | ({"data": data} if data else {}))
    return timing | {"signal": signals}


def while_valid(name: str, got: dict[str, list[str]]) -> list[str]:
    """Values of a signal; x where it is the payload of a channel whose valid is shown and not 1."""
    channel = CHANNEL.match(bare(name))
    valid = got.get(f"{channel[1]}valid") if channel else None
    if valid is None:
        return got[name]
    return [value if told == "1" else "x" for value, told in zip(got[name], valid, strict=True)]


def as_text(timing: Timing) -> str:
    """JSON with one line a signal."""
    head = [f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in timing.items() if key != "signal"]
    signals = ",\n".join(f"    {json.dumps(signal)}" for signal in timing["signal"])
    return "{\n" + ",\n".join([*head, f'  "signal": [\n{signals}\n  ]']) + "\n}\n"
