# SPDX-License-Identifier: Apache-2.0
"""The letters of `overlay` as a Verilog constant: `python -m scripts.font` makes rtl/generated/overlay_font.vh.

The source is rtl/overlay/font.txt; golden/overlay.py reads the same.
"""

import numpy as np

from golden.overlay import FONT_FILE, read_font
from scripts.errors import UserError, run_main
from tb.common.cores import ROOT

NAMES = {" ": "space", "\\": "backslash"}
"""Of what a comment must not end in."""
HEADER = ROOT / "rtl/generated/overlay_font.vh"


def verilog(font: np.ndarray) -> str:
    """The header: bit {glyph, row, column} of FONT is a pixel.

    Args:
        font: bool array (64, 8, 8).
    """
    lines = [
        "// SPDX-License-Identifier: Apache-2.0",
        f"// Generated from {FONT_FILE.relative_to(ROOT)} by python -m scripts.font. Do not edit.",
        "// Bit {glyph, row, column} of FONT is a pixel; glyph 0 is the space of ASCII.",
        "localparam [4095:0] FONT = {",
    ]
    for glyph in reversed(range(64)):
        bits = np.packbits(font[glyph].ravel(), bitorder="little")[::-1]
        name = NAMES.get(chr(32 + glyph), chr(32 + glyph))
        lines.append(f"    64'h{bits.tobytes().hex().upper()}{',' if glyph else ''}  // {name}")
    return "\n".join([*lines, "};", ""])


def main() -> int:
    """Write the header."""
    try:
        font = read_font()
    except ValueError as error:
        raise UserError(str(error)) from error
    HEADER.write_text(verilog(font), encoding="ascii")
    return 0


if __name__ == "__main__":
    run_main(main)
