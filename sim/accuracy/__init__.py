# SPDX-License-Identifier: Apache-2.0
"""Measures how well the pad is found, on photographs and on rendered frames (`make accuracy`)."""
