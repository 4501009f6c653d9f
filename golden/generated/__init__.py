# SPDX-License-Identifier: Apache-2.0
"""Constants and layouts made by `python -m scripts.regmap`."""
