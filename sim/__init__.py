# SPDX-License-Identifier: Apache-2.0
"""Everything together: the verilated hardware, the firmware, and the world before the camera."""
