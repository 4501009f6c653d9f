# SPDX-License-Identifier: Apache-2.0
"""The demo's table, for terminal and report alike."""

from scripts.demo_results import Row, describe_target

_LEFT = {"frame", "MAVLink to the autopilot"}


def columns(rows: list[Row]) -> list[str]:
    """Names of the columns; errors only where a truth is known."""
    names = ["frame", "pad x", "pad y", "angle", "altitude", "right", "forward", "MAVLink to the autopilot", "latency"]
    return names + (["error"] if any(row.truth for row in rows) else [])


def units() -> dict[str, str]:
    """Unit of each column that has one."""
    return {
        "pad x": "px",
        "pad y": "px",
        "angle": "deg",
        "altitude": "m",
        "right": "m",
        "forward": "m",
        "latency": "µs",
        "error": "px / deg / m",
    }


def cells(row: Row) -> dict[str, str]:
    """The row's texts by column; '-' where there is nothing to say."""
    pad = row.pad
    error = "-"
    if row.error_px is not None:
        error = f"{row.error_px:.2f} / {row.error_deg:.2f} / {row.error_m:.3f}"
    return {
        "frame": row.name,
        "pad x": f"{pad.x_px:.2f}" if pad else "no pad",
        "pad y": f"{pad.y_px:.2f}" if pad else "-",
        "angle": f"{pad.angle_deg:+.2f}" if pad else "-",
        "altitude": f"{row.altitude_m:.3f}" if row.altitude_m is not None else "-",
        "right": f"{pad.right_m:+.3f}" if pad else "-",
        "forward": f"{pad.forward_m:+.3f}" if pad else "-",
        "MAVLink to the autopilot": describe_target(row.target),
        "latency": f"{row.latency_us:.1f}" if row.latency_us is not None else "-",
        "error": error,
    }


def table(rows: list[Row]) -> str:
    """The table as text, columns aligned."""
    names = columns(rows)
    heads = {name: f"{name} [{units()[name]}]" if name in units() else name for name in names}
    body = [cells(row) for row in rows]
    widths = {name: max(len(heads[name]), *(len(line[name]) for line in body)) for name in names}

    def join(line: dict[str, str]) -> str:
        parts = [line[name].ljust(widths[name]) if name in _LEFT else line[name].rjust(widths[name]) for name in names]
        return "  ".join(parts).rstrip()

    rule = "  ".join("-" * widths[name] for name in names)
    return "\n".join([join(heads), rule, *(join(line) for line in body)])
