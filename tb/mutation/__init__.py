# SPDX-License-Identifier: Apache-2.0
"""Mutation testing: small faults planted into each core, which the core's own tests have to find."""
