# SPDX-License-Identifier: Apache-2.0
"""The clocks that docs/cores/ccl.md promises, for the tests in cocotb and the bench in C++."""

from tb.common.figures import page_figures

REPORT_CLOCKS, REPORT_AT_EDGE_CLOCKS, LAST_LINE_CLOCKS, CLOSE_CLOCKS, NEXT_CLOCKS = page_figures("ccl")
"""From the pixel that tells that an object has ended to the object; the same at the end of a line; from the last pixel
to the first object of the last line; from it to the trailer and to the next frame's first pixel, if there is none."""
QUEUED = page_figures("ccl", "Throughput")[-1]
"""Components that wait before a stalled output stalls the input."""
