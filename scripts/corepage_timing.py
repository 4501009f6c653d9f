# SPDX-License-Identifier: Apache-2.0
"""Timing pictures of the core pages: WaveDrom JSON whose outputs are what the RTL does with its inputs.

A column is a clock: inputs change after its rising edge, outputs are read in its middle. The wave of an input drives
it; the wave of an output is made by `simulate`. The payload of a channel is drawn as unknown while its valid is 0. A
name may end in a range of bits, such as `m_axis_tdata[31:0]`. Besides what WaveDrom knows, the JSON may say

- `parameters` of the core, and `set`: inputs that keep a value;
- `prelude`: a Verilog file beside the page. It stands in the bench, where the ports of the core are variables of the
  same names, and its task `prelude` runs after the reset;
- `answers`: inputs that the prelude's file drives, drawn as they turn out;
- `wait`: clocks between reset, or prelude, and the first column;
- `gaps`: how many clocks each column `|` of `clk` stands for. All inputs have `|` there. No signal of the picture
  changes in a gap: `simulate` refuses one that does, so that nothing is hidden.
"""

import json
import re
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from scripts.errors import UserError
from scripts.lint import include_flags
from tb.common.cores import ROOT, load_core
from tb.common.figures import PAGES

CLOCKS = ("clk", "pix_clk")
RESET_CLOCKS = 4
LIMIT_CLOCKS = 100_000
GAP = "|"
DATA = "23456789="
CHANNEL = re.compile(r"(.*axis_t|.*_axil?_(?:aw|ar|w|r|b))(?!valid|ready)\w+$")

Timing = dict[str, Any]
Ports = dict[str, tuple[str, int]]


def bare(name: str) -> str:
    """Name of the port that a signal shows."""
    return name.partition("[")[0]


def clock_of(timing: Timing) -> Timing:
    """The signal `clk` of a picture, or that of the only clock that it has."""
    return next(signal for name in CLOCKS for signal in timing["signal"] if signal.get("name") == name)


def gap_columns(signal: Timing) -> list[int]:
    """Columns in which a signal has a gap."""
    return [column for column, character in enumerate(signal["wave"]) if character == GAP]


def clocks_of_columns(timing: Timing) -> list[int]:
    """How many clocks each column of a picture stands for.

    Raises:
        ValueError: The gaps of the clock are not as many as their lengths.
    """
    clocks = [1] * len(clock_of(timing)["wave"])
    for column, length in zip(gap_columns(clock_of(timing)), timing.get("gaps", []), strict=True):
        clocks[column] = length
    return clocks


def is_read(timing: Timing, name: str, ports: Ports) -> bool:
    """Whether a signal of a picture is read from the bench, not driven by its wave."""
    return ports[bare(name)][0] == "out" or name in timing.get("answers", [])


def driven(wave: str, data: list[str], width: int) -> list[str]:
    """Verilog constants that an input has, one a column.

    Raises:
        ValueError: The wave has a character other than 0, 1, x, a data segment or a gap.
    """
    values, rest = [], iter(data)
    for character in wave:
        if character in (".", GAP):
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
    """Verilog that plays the inputs and prints what is read in binary, one line a clock.

    Raises:
        ValueError: The gaps of an input are not those of the clock.
    """
    top = load_core(core).toplevel
    shown = [signal for signal in timing["signal"] if "wave" in signal and signal["name"] not in CLOCKS]
    read = [signal["name"] for signal in shown if is_read(timing, signal["name"], ports)]
    inputs = {
        signal["name"]: driven(signal["wave"], signal.get("data", []), ports[signal["name"]][1])
        for signal in shown
        if signal["name"] not in read
    }
    gaps = gap_columns(clock_of(timing))
    wrong = [signal["name"] for signal in shown if signal["name"] in inputs and gap_columns(signal) != gaps]
    if wrong:
        raise ValueError(f"the gaps of {wrong[0]} are not those of clk")
    lines = ["`timescale 1ns / 1ps", "module bench;", "reg clk = 0;", "always #5 clk = !clk;"]
    for name, (way, width) in ports.items():
        if name not in CLOCKS:
            lines.append(f"{'reg' if way == 'in' else 'wire'} [{width - 1}:0] {name};")
    parameters = ", ".join(f".{name}({value})" for name, value in timing.get("parameters", {}).items())
    connections = ", ".join(f".{name}({'clk' if name in CLOCKS else name})" for name in ports)
    lines.append(f"{top} #({parameters}) dut ({connections});")
    if "prelude" in timing:
        lines.append(f'`include "{PAGES / timing["prelude"]}"')
        lines.append(f"initial begin repeat ({LIMIT_CLOCKS}) @(posedge clk); $finish; end")
    lines.append("initial begin")
    rest = [name for name, (way, _) in ports.items() if way == "in" and name not in CLOCKS]
    lines += [f"{name} = {timing.get('set', {}).get(name, 0)};" for name in rest]
    # A data wave has no value for before its first column: the bus is idle until then.
    reset = "rst" if "rst" in ports else "pix_rst"
    lines += [f"{reset} = 1;", f"repeat ({RESET_CLOCKS}) @(posedge clk);", f"#1 {reset} = 0;"]
    lines += ["prelude;"] if "prelude" in timing else []
    lines += [f"repeat ({timing.get('wait', 4)}) @(posedge clk);", "#1;"]
    for column, length in enumerate(clocks_of_columns(timing)):
        lines += [f"{name} = {values[column]};" for name, values in inputs.items()]
        lines.append(f"repeat ({length}) begin")
        lines.append(f'@(negedge clk) $display("{" ".join(["%b"] * len(read))}", {", ".join(read)});')
        lines += ["@(posedge clk) #1;", "end"]
    lines += ["$finish;", "end", "endmodule", ""]
    return "\n".join(lines)


def drawn(values: list[str], gaps: Sequence[int] = ()) -> tuple[str, list[str]]:
    """Wave and data of binary values, one a column; a value with an unknown bit is x, one in a gap goes on."""
    wave, data, before = "", [], None
    for column, value in enumerate("x" if set(value) - set("01") else value for value in values):
        if column in gaps:
            wave += GAP
        elif value == before:
            wave += "."
        elif len(value) == 1:
            wave += value
        else:
            wave += "="
            data.append(f"{int(value, 2):X}")
        before = value
    return wave, data


def one_a_column(name: str, values: list[str], timing: Timing) -> list[str]:
    """One value a column, of one a clock.

    Raises:
        UserError: The signal changes in a gap.
    """
    kept, place, gaps = [], 0, gap_columns(clock_of(timing))
    for column, length in enumerate(clocks_of_columns(timing)):
        late = [clock for clock in range(length) if column in gaps and values[place + clock] != kept[-1]]
        if late:
            raise UserError(f"{name} changes in clock {late[0]} of the gap in column {column}; draw that clock.")
        kept.append(values[place])
        place += length
    return kept


def play(core: str, timing: Timing, ports: Ports) -> list[list[str]]:
    """What the signals that are read have in binary, a list a clock, in Icarus Verilog.

    Raises:
        UserError: The bench does not elaborate, or its prelude does not end.
    """
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
    if len(lines) != sum(clocks_of_columns(timing)):
        raise UserError(f"the prelude of docs/cores/{core}.md does not end within {LIMIT_CLOCKS} clocks; mend it.")
    return lines


def simulate(core: str, timing: Timing, ports: Ports) -> Timing:
    """The same picture with the waves of all outputs and answers as the RTL gives them.

    Raises:
        UserError: The picture names no port of the core, does not elaborate or end, or hides a change in a gap.
    """
    strange = [signal["name"] for signal in timing["signal"] if "name" in signal and bare(signal["name"]) not in ports]
    if strange:
        raise UserError(f"the timing of docs/cores/{core}.md shows {strange[0]}, which is no port of the core.")
    names = [signal["name"] for signal in timing["signal"] if signal.get("name") not in (None, *CLOCKS)]
    read = [name for name in names if is_read(timing, name, ports)]
    lines = play(core, timing, ports)
    got = {name: list(values) for name, values in zip(read, zip(*lines, strict=True), strict=True)}
    signals = []
    for signal in timing["signal"]:
        if signal.get("name") not in got:
            signals.append(signal)
            continue
        values = one_a_column(signal["name"], while_valid(signal["name"], got), timing)
        wave, data = drawn(values, gap_columns(clock_of(timing)))
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
