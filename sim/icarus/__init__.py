# SPDX-License-Identifier: Apache-2.0
"""landing_core in Icarus, a simulator of four states."""
