# SPDX-License-Identifier: Apache-2.0
"""The landing's phases: one table, from which C and documentation are generated."""
