# SPDX-License-Identifier: Apache-2.0
"""Frames through RTL and firmware to UART bytes, without a board."""
