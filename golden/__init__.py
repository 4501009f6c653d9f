# SPDX-License-Identifier: Apache-2.0
"""What each core computes, as pure functions on integer numpy arrays."""
