# SPDX-License-Identifier: Apache-2.0
"""Cores against their models for every input there is."""
