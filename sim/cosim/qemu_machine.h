// SPDX-License-Identifier: Apache-2.0
// landing_core in QEMU's Zynq, by a TCG plugin: registers at 0x43C00000
// (M_AXI_GP0), interrupt IRQ_F2P[0], records written to DDR; and what passes
// through the UARTs, with times.
//
// The RTL runs on QEMU's virtual clock, which -icount derives from the count of
// instructions. A timer takes it from one deadline to the next, and each access
// of the firmware first takes it to the instant of that access. So firmware and
// RTL see the same time however slow the RTL is, and each run gives the same bytes.
#pragma once

#include <cstdint>
#include <exception>
#include <string>

#include "sim/cosim/qemu_abi.h"
#include "sim/cosim/run_log.h"
#include "sim/verilated/arguments.h"
#include "sim/verilated/board.h"
#include "sim/verilated/camera.h"
#include "sim/verilated/landing_model.h"

namespace touchdown {

// Ends QEMU. It would run the guest on until its main loop comes round; leaving at
// once keeps the last byte the same in each run. Nothing of QEMU's needs flushing:
// its file-backed UARTs write through.
[[noreturn]] void leave(int code);
[[noreturn]] void fail(const std::string& sentence);

class Machine;

// Stands before the FIFO register of one UART and passes everything on.
class UartTap {
public:
    void map(unsigned port, Machine& machine);
    // What the firmware has programmed.
    double baud();

private:
    uint64_t read(uint64_t offset);
    void write(uint64_t value);

    qemu::MemoryRegion region_ = {};
    qemu::MemoryRegion* uart_ = nullptr;
    Machine* machine_ = nullptr;
    UartWire wire_;
    unsigned port_ = 0;
};

class Machine : public Board {
public:
    // To be called while QEMU loads the plugin. Returns only with a machine that can
    // work: `fail` says why it cannot. It lives as long as the process, because QEMU
    // keeps pointers into it.
    template <typename Kind>
    static void install(const Arguments& arguments) {
        try {
            install(new Kind(arguments));
        } catch (const std::exception& error) {
            fail(error.what());
        }
    }

    void write_memory(uint64_t address, const uint8_t* bytes, size_t count) override;
    void read_memory(uint64_t address, uint8_t* bytes, size_t count) override;
    void irq(bool level, uint64_t time_ns) override;

    // The firmware pushed a byte into a UART; `done_ns` is the end of its stop bit.
    virtual void uart(unsigned port, uint64_t push_ns, uint64_t done_ns, uint8_t byte) = 0;

protected:
    Machine(const ModelConfig& config, Camera& camera);

    // The RTL has come to `now_ns`; returns the next deadline.
    virtual uint64_t tick(uint64_t now_ns) = 0;
    // What is written to FRAME_SIZE instead.
    virtual uint64_t frame_size(uint64_t written, unsigned size) const = 0;

    UartTap& tap(unsigned port) { return taps_[port]; }

private:
    static void install(Machine* machine);
    void map();
    template <typename Action>
    uint64_t guarded(Action action);
    uint64_t read(uint64_t address, unsigned size);
    void write(uint64_t address, uint64_t value, unsigned size);
    void deadline();

    LandingModel model_;
    qemu::MemoryRegion region_ = {};
    qemu::Timer timer_ = {};
    UartTap taps_[2];
    void* irq_ = nullptr;
    uint64_t deadline_ns_;
    bool enabled_ = false;
};

}  // namespace touchdown
