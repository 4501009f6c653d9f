# SPDX-License-Identifier: Apache-2.0
"""Makes RTL, C, Python and documentation of the registers and the result record from one SystemRDL file."""
