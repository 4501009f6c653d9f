# SPDX-License-Identifier: Apache-2.0
"""Coverage of lines, branches and toggles of each core by its own tests."""
