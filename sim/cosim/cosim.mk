# SPDX-License-Identifier: Apache-2.0
# C++ side of the co-simulation. sim/cosim/build.py calls this from the project
# root with RTL= the sources of landing_core.

BUILD := build/cosim
MODEL := $(BUILD)/model
# landing_core with the stand-ins of the stages from camera to objects.
FLIGHT_MODEL := $(BUILD)/flight-model
# landing_core for 1920x1080; stages_main.cpp knows its clocks.
FULL_HD_MODEL := $(BUILD)/full-hd-model
STAND_INS := $(wildcard sim/verilated/stand_ins/*.v)
STOOD_IN_FOR := $(patsubst sim/verilated/stand_ins/%,\%/%,$(STAND_INS))
FLIGHT_RTL = $(STAND_INS) $(filter-out $(STOOD_IN_FOR),$(RTL))
VERILATOR_ROOT := $(shell verilator --getenv VERILATOR_ROOT)

CXX := $(if $(shell command -v ccache),ccache )g++
CXXFLAGS := -std=c++17 -O2 -fPIC -Wall -Wextra -Werror -Wno-pedantic -I. -Isim/verilated \
            -isystem $(VERILATOR_ROOT)/include -isystem $(VERILATOR_ROOT)/include/vltstd -MMD -MP
VERILATE := verilator --cc --quiet-stats -O3 --x-assign fast --x-initial fast --no-assert --no-timing \
            --language 1364-2005 -CFLAGS -fPIC -Irtl/generated --prefix Vlanding_core --top-module landing_core
LDLIBS := -lpthread

SHARED := frame_list video_source axi_memory stage_taps landing_model
SHARED_OBJECTS := $(SHARED:%=$(BUILD)/obj/%.o)
FLIGHT_OBJECTS := $(addprefix $(BUILD)/flight-obj/,qemu_flight.o qemu_machine.o run_log.o axi_memory.o landing_model.o)
FULL_HD_OBJECTS := $(addprefix $(BUILD)/full-hd-obj/,stages_main.o run_log.o $(SHARED:%=%.o))
FIRMWARE_LIBRARY := build/firmware/libtouchdown.a
MODEL_LIBS := $(MODEL)/libVlanding_core.a $(MODEL)/libverilated.a

# verilator itself sees to it that unchanged sources change nothing.
.PHONY: plugin flight-plugin meter-plugin host stages full-hd-stages
plugin: $(BUILD)/touchdown-plugin.so
flight-plugin: $(BUILD)/touchdown-flight-plugin.so
meter-plugin: $(BUILD)/touchdown-meter-plugin.so
host: $(BUILD)/touchdown-host
stages: $(BUILD)/landing-stages
full-hd-stages: $(BUILD)/full-hd-landing-stages

$(MODEL)/Vlanding_core.mk: $(RTL) sim/verilated/taps.vlt sim/cosim/cosim.mk $(wildcard rtl/generated/*.vh)
	@mkdir -p $(@D)
	$(VERILATE) --Mdir $(MODEL) sim/verilated/taps.vlt $(RTL)
	@touch $@

$(FLIGHT_MODEL)/Vlanding_core.mk: $(RTL) $(STAND_INS) sim/verilated/taps.vlt sim/cosim/cosim.mk $(wildcard rtl/generated/*.vh)
	@mkdir -p $(@D)
	$(VERILATE) --Mdir $(FLIGHT_MODEL) -GCLK_PER_US=2 sim/verilated/taps.vlt $(FLIGHT_RTL)
	@touch $@

$(FULL_HD_MODEL)/Vlanding_core.mk: $(RTL) sim/verilated/taps.vlt sim/cosim/cosim.mk $(wildcard rtl/generated/*.vh)
	@mkdir -p $(@D)
	$(VERILATE) --Mdir $(FULL_HD_MODEL) -GMAX_WIDTH=1920 -GMAX_HEIGHT=1080 -GCLK_PER_US=150 sim/verilated/taps.vlt $(RTL)
	@touch $@

%/libVlanding_core.a %/libverilated.a: %/Vlanding_core.mk
	+$(MAKE) -C $* -f Vlanding_core.mk OPT_FAST=-O3 OPT_GLOBAL=-O2 $(if $(shell command -v ccache),OBJCACHE=ccache) \
	    libVlanding_core.a libverilated.a
	@touch $*/libVlanding_core.a $*/libverilated.a

$(BUILD)/obj/%.o: sim/verilated/%.cpp $(MODEL)/Vlanding_core.mk
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) -isystem $(MODEL) -c -o $@ $<

$(BUILD)/obj/%.o: sim/cosim/%.cpp $(MODEL)/Vlanding_core.mk
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) -isystem $(MODEL) -c -o $@ $<

$(BUILD)/flight-obj/%.o: sim/verilated/%.cpp $(FLIGHT_MODEL)/Vlanding_core.mk
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) -isystem $(FLIGHT_MODEL) -c -o $@ $<

$(BUILD)/flight-obj/%.o: sim/cosim/%.cpp $(FLIGHT_MODEL)/Vlanding_core.mk
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) -isystem $(FLIGHT_MODEL) -c -o $@ $<

$(BUILD)/full-hd-obj/%.o: sim/verilated/%.cpp $(FULL_HD_MODEL)/Vlanding_core.mk
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) -isystem $(FULL_HD_MODEL) -c -o $@ $<

$(BUILD)/full-hd-obj/%.o: sim/cosim/%.cpp $(FULL_HD_MODEL)/Vlanding_core.mk
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) -isystem $(FULL_HD_MODEL) -c -o $@ $<

$(BUILD)/touchdown-plugin.so: $(BUILD)/obj/qemu_frames.o $(BUILD)/obj/qemu_machine.o $(BUILD)/obj/run_log.o $(SHARED_OBJECTS) $(MODEL_LIBS)
	$(CXX) -shared -Wl,--exclude-libs,ALL -o $@ $^ $(LDLIBS)

$(BUILD)/touchdown-flight-plugin.so: $(FLIGHT_OBJECTS) $(FLIGHT_MODEL)/libVlanding_core.a $(FLIGHT_MODEL)/libverilated.a
	$(CXX) -shared -Wl,--exclude-libs,ALL -o $@ $^ $(LDLIBS)

$(BUILD)/touchdown-meter-plugin.so: $(BUILD)/obj/qemu_meter.o
	$(CXX) -shared -o $@ $^

# firmware/Makefile knows whether its library is up to date.
.PHONY: firmware-library
firmware-library:
	+$(MAKE) -C firmware host

$(FIRMWARE_LIBRARY): firmware-library ;

$(BUILD)/touchdown-host: $(BUILD)/obj/host_main.o $(BUILD)/obj/run_log.o $(SHARED_OBJECTS) $(FIRMWARE_LIBRARY) $(MODEL_LIBS)
	$(CXX) -o $@ $^ -lm $(LDLIBS)

$(BUILD)/landing-stages: $(BUILD)/obj/stages_main.o $(BUILD)/obj/run_log.o $(SHARED_OBJECTS) $(MODEL_LIBS)
	$(CXX) -o $@ $^ $(LDLIBS)

$(BUILD)/full-hd-landing-stages: $(FULL_HD_OBJECTS) $(FULL_HD_MODEL)/libVlanding_core.a $(FULL_HD_MODEL)/libverilated.a
	$(CXX) -o $@ $^ $(LDLIBS)

-include $(wildcard $(BUILD)/obj/*.d $(BUILD)/flight-obj/*.d $(BUILD)/full-hd-obj/*.d)
