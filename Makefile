# SPDX-License-Identifier: Apache-2.0
# Every command of the project. `make help` lists them.

SHELL := /bin/bash
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:

PYTHON := .venv/bin/python
export PATH := $(CURDIR)/.venv/bin:$(PATH)
export PYTHONPATH := $(CURDIR)
export PYTHONDONTWRITEBYTECODE := 1

# Options of the commands below.
CORE ?=
SIM ?= icarus
SEED ?=
WAVES ?=
FRAMES ?=
ALTITUDE ?=
FIRMWARE ?= qemu
PHOTOS ?=
RUN ?= golden
COUNT ?=
SETS ?=
OPTIONS ?=
NO_GOALS ?=
BOARD ?=
SQUARE_MM ?=
RADIAL ?=
TARGET ?=
RUNS ?=
ROUNDS ?=
SECONDS ?=
KEEP ?=
JOBS ?= 2
DIGILENT_IP ?=
TOOL ?=
DRY_RUN ?=
NO_FIRMWARE ?=
CARD ?=
FSBL ?=

.PHONY: help
help: ## This list
	@printf 'Touchdown: cores and firmware that land a drone on a marked pad.\n\n'
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-10s %s\n", $$1, $$2}' $(MAKEFILE_LIST)
	@printf '\nOptions: CORE=name  SIM=icarus|verilator  SEED=n  WAVES=1  FRAMES=folder|video  ALTITUDE=csv|metres  FIRMWARE=qemu|host  PHOTOS=folders\n'
	@printf 'Start with: make demo\n'

.PHONY: setup
setup: ## Install what is needed: Debian packages and .venv, pinned; does nothing when all is there
	@scripts/setup.sh

.PHONY: doctor
doctor: ## Say which tools are here, which version each has and which is wanted
	@python3 -m scripts.doctor

.PHONY: demo
demo: setup ## Photographs or the bundled clip through RTL and firmware to MAVLink bytes: table, pictures, report
	@$(PYTHON) -m scripts.demo $(if $(FRAMES),--frames "$(FRAMES)") $(if $(ALTITUDE),--altitude "$(ALTITUDE)") --firmware "$(FIRMWARE)"

.PHONY: test
test: setup ## Everything that fits into 25 minutes on 2 cores
	@$(PYTHON) -m pytest -n $(JOBS) --dist worksteal -m "not full"

.PHONY: test-full
test-full: setup ## Everything, a line an item, and the table of what each core passed: [PHOTOS="folder folder"]
	@status=0; $(PYTHON) -m pytest -v -n $(JOBS) --dist worksteal || status=1; $(PYTHON) -m scripts.signoff || status=1; exit $$status

.PHONY: signoff
signoff: setup ## The table of what each core passed, from the results of the last runs
	@$(PYTHON) -m scripts.signoff

.PHONY: bench
bench: setup ## How fast the parts are, as ratios measured side by side: [ROUNDS=n]
	@$(PYTHON) -m scripts.bench $(if $(ROUNDS),--rounds "$(ROUNDS)")

.PHONY: synth
synth: setup ## Area of one core or all, against constraints/budgets.toml (yosys, xc7): [CORE=name]
	@$(PYTHON) -m scripts.synth $(if $(CORE),--core "$(CORE)")

.PHONY: sweep
sweep: setup ## What features and sizes cost: the builds of constraints/sweeps.toml [CORE=name]
	@$(PYTHON) -m scripts.sweep $(if $(CORE),--core "$(CORE)")

.PHONY: pnr
pnr: setup ## How fast one core or all are, placed and routed by nextpnr for the Zynq-7020: [CORE=name]
	@$(PYTHON) -m scripts.pnr $(if $(CORE),--core "$(CORE)")

.PHONY: sim
sim: setup ## Test one core in one simulator: CORE=name [SIM=icarus|verilator] [SEED=n] [WAVES=1]
	@$(PYTHON) -m tb.common.runner --core "$(CORE)" --sim "$(SIM)" $(if $(SEED),--seed "$(SEED)") $(if $(filter-out 0,$(WAVES)),--waves)

.PHONY: vectors
vectors: setup ## Golden input and output of one core from recorded frames: CORE=name [FRAMES=folder|video]
	@$(PYTHON) -m scripts.vectors --core "$(CORE)" $(if $(FRAMES),--frames "$(FRAMES)")

.PHONY: lint
lint: setup ## verilator, Icarus, yosys and verible on the RTL; clang, clang-tidy, cppcheck on C; ruff on Python; tclint on Tcl
	@$(PYTHON) -m scripts.lint

.PHONY: formal
formal: setup ## Prove the cores and see each planted fault found: [CORE=name]
	@$(PYTHON) -m formal.run --faults $(if $(CORE),--core "$(CORE)")

.PHONY: mutation
mutation: setup ## Plant faults into the cores and count how many their own tests find: [CORE=name]
	@$(PYTHON) -m tb.mutation.run --jobs $(JOBS) $(if $(CORE),--core "$(CORE)")

.PHONY: coverage
coverage: setup ## Lines, branches and toggles that the tests of the cores reach, and which they miss: [CORE=name]
	@$(PYTHON) -m tb.coverage.run $(if $(CORE),--core "$(CORE)")

.PHONY: frames
frames: setup ## Whole frames through landing_core, every stream equal to golden: [PHOTOS="folder folder"]
	@$(PYTHON) -m sim.full_frames $(if $(PHOTOS),--photos $(PHOTOS))

.PHONY: accuracy
accuracy: setup ## How well the pad is found, against truth and goals: [FRAMES=folder] [RUN=golden|rtl] [COUNT=n] [SEED=n] [SETS="a b"]
	@$(PYTHON) -m sim.accuracy.run --jobs $(JOBS) --run "$(RUN)" $(if $(FRAMES),--frames "$(FRAMES)") $(if $(ALTITUDE),--altitude "$(ALTITUDE)") $(if $(COUNT),--count "$(COUNT)") $(if $(SEED),--seed "$(SEED)") $(if $(SETS),--sets $(SETS)) $(if $(filter-out 0,$(OPTIONS)),--options) $(if $(filter-out 0,$(NO_GOALS)),--no-goals)

.PHONY: calibrate
calibrate: setup ## Measure the camera from photos of a chessboard or the pad: FRAMES=folder [BOARD=9x6|pad] [SQUARE_MM=25] [RADIAL=0|1|2]
	@$(PYTHON) -m scripts.calibrate --frames "$(FRAMES)" $(if $(BOARD),--board "$(BOARD)") $(if $(SQUARE_MM),--square-mm "$(SQUARE_MM)") $(if $(RADIAL),--radial "$(RADIAL)")

.PHONY: fuzz
fuzz: setup ## Hostile input for the firmware, under sanitizers: [TARGET=name] [RUNS=n] [SECONDS=n] [KEEP=1]
	@$(PYTHON) -m scripts.fuzz $(if $(TARGET),--target "$(TARGET)") $(if $(RUNS),--runs "$(RUNS)") $(if $(SECONDS),--seconds "$(SECONDS)") $(if $(filter-out 0,$(KEEP)),--keep)

.PHONY: flight
flight: setup ## Fly one landing in simulation, print its steps and draw it: [PROFILE=px4] [GUSTS=0.5] [SEED=n]
	@$(PYTHON) -m sim.flight.run $(if $(PROFILE),--profile "$(PROFILE)") $(if $(GUSTS),--gusts "$(GUSTS)") $(if $(SEED),--seed "$(SEED)")

.PHONY: frame-time
frame-time: setup ## Instructions of the board for each photograph, searched and tracked, on QEMU: FRAMES=folder [ALTITUDE=m]
	@$(PYTHON) -m sim.flight.frame_time "$(FRAMES)" $(if $(ALTITUDE),--altitude "$(ALTITUDE)")

.PHONY: ground
ground: setup ## Show a Touchdown in this terminal, start, hold or abort it: LINK=port|udp:14550 [BAUD=57600] [DO=abort]
	@$(PYTHON) -m scripts.ground_station --link "$(LINK)" $(if $(BAUD),--baud "$(BAUD)") $(if $(DO),--do "$(DO)")

.PHONY: landing
landing: setup ## Regenerate everything that comes from firmware/landing.toml: C table, docs/landing.md
	@$(PYTHON) -m scripts.landing

.PHONY: regmap
regmap: setup ## Regenerate everything that comes from the .rdl files of registers and record
	@$(PYTHON) -m scripts.regmap

.PHONY: fusesoc
fusesoc: setup ## Regenerate the .core files of FuseSoC from rtl/*/core.toml
	@$(PYTHON) -m scripts.fusesoc

.PHONY: firmware
firmware: setup ## Build build/firmware/touchdown.elf: [CAMERA=file] [AUTOPILOT_BAUD=57600] [GROUND_BAUD=115200]
	@$(MAKE) --no-print-directory -C firmware elf

.PHONY: bitstream
bitstream: setup ## Build the board's bitstream with Vivado 2023.2: DIGILENT_IP=<clone of vivado-library> (docs/board.md)
	@$(PYTHON) -m scripts.vivado bitstream --digilent-ip "$(DIGILENT_IP)"

.PHONY: xsa
xsa: setup ## The same, and the hardware description for Vitis: DIGILENT_IP=<clone of vivado-library>
	@$(PYTHON) -m scripts.vivado xsa --digilent-ip "$(DIGILENT_IP)"

.PHONY: ip
ip: setup ## Package one core or all as IP-XACT with Vivado: [CORE=name]
	@$(PYTHON) -m scripts.vivado ip $(if $(CORE),--core "$(CORE)")

.PHONY: flash
flash: setup ## Load bitstream and firmware into a board on USB: [TOOL=xsct|openocd] [NO_FIRMWARE=1] [DRY_RUN=1]
	@$(PYTHON) -m scripts.flash $(if $(TOOL),--tool "$(TOOL)") $(if $(filter-out 0,$(NO_FIRMWARE)),--no-firmware) $(if $(filter-out 0,$(DRY_RUN)),--dry-run)

.PHONY: sdcard
sdcard: setup ## BOOT.BIN for a card that starts the board: [CARD=<where it is mounted>] [FSBL=file] [DRY_RUN=1]
	@$(PYTHON) -m scripts.sdcard $(if $(CARD),--card "$(CARD)") $(if $(FSBL),--fsbl "$(FSBL)") $(if $(filter-out 0,$(DRY_RUN)),--dry-run)

.PHONY: clean
clean: ## Remove build/ (not .venv)
	@rm -rf build
