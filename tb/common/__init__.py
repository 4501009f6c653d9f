# SPDX-License-Identifier: Apache-2.0
"""What all testbenches share.

`runner` builds and runs; `stream` has source, sink, protocol checker and bench; `patterns` makes frames; `compare`
checks them; `contract` models the frame contract; `matrix` runs the standard scenes on cores with video in and out.
"""
