# SPDX-License-Identifier: Apache-2.0
"""Testbenches; `tb.common` holds what all of them share."""
