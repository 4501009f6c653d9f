# SPDX-License-Identifier: Apache-2.0
"""The firmware in a closed loop: a simple vehicle and autopilot around it, and scenarios of landings."""
