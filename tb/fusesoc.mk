# SPDX-License-Identifier: Apache-2.0
# FuseSoC lays this before the Makefile of a simulation: edalize does not tell cocotb 2.1 where its library is, and vvp
# ends with 0 whether tests failed or not.
export GPI_USERS := $(shell cocotb-config --libpython);$(shell cocotb-config --pygpi-entry-point)

all:
	@$(MAKE) -f Makefile

run:
	@rm -f results.xml
	@$(MAKE) -f Makefile run
	@python3 -m cocotb_tools.check_results results.xml

.PHONY: all run
