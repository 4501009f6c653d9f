# SPDX-License-Identifier: Apache-2.0
"""Proofs of the cores: properties, bound from outside, and the faults that must break them."""
