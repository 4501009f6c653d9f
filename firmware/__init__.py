# SPDX-License-Identifier: Apache-2.0
"""Firmware: C sources, and what Python needs to build and to test them."""
