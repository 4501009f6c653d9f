// SPDX-License-Identifier: Apache-2.0
// A TCG plugin that puts landing_core into QEMU's Zynq: registers at 0x43C00000
// (M_AXI_GP0), interrupt IRQ_F2P[0], records written to DDR; and logs when each
// byte is pushed into a UART.
//
// The RTL runs on QEMU's virtual clock, which -icount derives from the count of
// instructions. A timer takes it from one deadline to the next, and each access
// of the firmware first takes it to the instant of that access. So firmware and
// RTL see the same time however slow the RTL is, and each run gives the same bytes.
//
// Arguments: frames=<file> out=<folder> frame-clocks=<n> tail-us=<n>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "sim/cosim/qemu_abi.h"
#include "sim/cosim/run_log.h"
#include "sim/verilated/arguments.h"
#include "sim/verilated/landing_layout.h"
#include "sim/verilated/landing_model.h"

namespace touchdown {
namespace {

constexpr uint64_t PL_ADDRESS = 0x43C00000;
constexpr uint64_t PL_BYTES = 0x1000;
constexpr int IRQ_F2P_0 = 29;  // shared peripheral interrupt: GIC ID 61
// An interrupt reaches the CPU at most this late: each wait for a record is
// finely divided, the rest of a frame coarsely, because a division costs time.
constexpr uint64_t FINE_NS = 1'000;
constexpr uint64_t COARSE_NS = 10'000;
// Virtual time in which the firmware must enable the camera input.
constexpr uint64_t BOOT_LIMIT_NS = 20'000'000;
constexpr int OVERLAY_PRIORITY = 10;

// The board's camera, in FRAME_SIZE.
constexpr uint64_t CAMERA_SIZE = 720 << 16 | 1280;

constexpr uint64_t UART_ADDRESS[2] = {0xE0000000, 0xE0001000};
constexpr uint64_t UART_BAUDGEN = 0x18;
constexpr uint64_t UART_FIFO = 0x30;
constexpr uint64_t UART_BAUDDIV = 0x34;
constexpr double UART_REFERENCE_HZ = 100e6;

// QEMU would run the guest on until its main loop comes round; leaving at once
// keeps the last byte the same in each run. Nothing of QEMU's needs flushing:
// its file-backed UARTs write through.
[[noreturn]] void leave(int code) {
    std::fflush(nullptr);
    _exit(code);
}

[[noreturn]] void fail(const std::string& sentence) {
    std::fprintf(stderr, "touchdown: %s\n", sentence.c_str());
    leave(1);
}

uint64_t virtual_ns() { return static_cast<uint64_t>(qemu_clock_get_ns(qemu::CLOCK_VIRTUAL)); }

qemu::MemoryRegionOps register_ops(decltype(qemu::MemoryRegionOps::read) read,
                                   decltype(qemu::MemoryRegionOps::write) write) {
    qemu::MemoryRegionOps ops = {};
    ops.read = read;
    ops.write = write;
    ops.endianness = qemu::LITTLE_ENDIAN_DEVICE;
    ops.valid.min_size = 1;
    ops.valid.max_size = 8;
    ops.impl.min_size = 1;
    ops.impl.max_size = 4;
    return ops;
}

// Stands before the FIFO register of one UART and passes everything on.
class UartTap {
public:
    void map(unsigned port, RunLog& log) {
        port_ = port;
        log_ = &log;
        uart_ = memory_region_find(get_system_memory(), UART_ADDRESS[port], 4).region;
        static const qemu::MemoryRegionOps ops = register_ops(
            [](void* tap, uint64_t, unsigned) { return static_cast<UartTap*>(tap)->read(UART_FIFO); },
            [](void* tap, uint64_t, uint64_t value, unsigned) { static_cast<UartTap*>(tap)->write(value); });
        memory_region_init_io(&region_, nullptr, &ops, this, "touchdown-uart-tap", 4);
        memory_region_add_subregion_overlap(get_system_memory(), UART_ADDRESS[port] + UART_FIFO, &region_,
                                            OVERLAY_PRIORITY);
    }

private:
    uint64_t read(uint64_t offset) {
        uint64_t value = 0;
        memory_region_dispatch_read(uart_, offset, &value, qemu::MEM_OP_SIZE_4, qemu::ATTRS_UNSPECIFIED);
        return value;
    }

    void write(uint64_t value) {
        const uint64_t now = virtual_ns();
        const double baud =
            UART_REFERENCE_HZ / static_cast<double>(read(UART_BAUDGEN)) / static_cast<double>(read(UART_BAUDDIV) + 1);
        log_->uart(port_, now, wire_.send(now, baud), static_cast<uint8_t>(value));
        memory_region_dispatch_write(uart_, UART_FIFO, value, qemu::MEM_OP_SIZE_4, qemu::ATTRS_UNSPECIFIED);
    }

    qemu::MemoryRegion region_ = {};
    qemu::MemoryRegion* uart_ = nullptr;
    RunLog* log_ = nullptr;
    UartWire wire_;
    unsigned port_ = 0;
};

class Plugin final : public Board {
public:
    explicit Plugin(const Arguments& arguments)
        : log_(arguments.text("out")),
          frames_(arguments.text("frames")),
          tail_ns_(arguments.number("tail-us") * 1000) {
        ModelConfig config;
        config.video.frame_clocks = arguments.number("frame-clocks");
        model_ = std::make_unique<LandingModel>(config, frames_, *this);
    }

    // In QEMU's main loop, after the machine was built and before it runs.
    void map() {
        static const qemu::MemoryRegionOps ops = register_ops(
            [](void* plugin, uint64_t address, unsigned size) {
                return static_cast<Plugin*>(plugin)->guarded([&](Plugin& self) { return self.read(address, size); });
            },
            [](void* plugin, uint64_t address, uint64_t value, unsigned size) {
                static_cast<Plugin*>(plugin)->guarded(
                    [&](Plugin& self) { return self.write(address, value, size), uint64_t{0}; });
            });
        memory_region_init_io(&region_, nullptr, &ops, this, "landing-core", PL_BYTES);
        memory_region_add_subregion_overlap(get_system_memory(), PL_ADDRESS, &region_, OVERLAY_PRIORITY);
        for (unsigned port = 0; port < 2; ++port) uarts_[port].map(port, log_);

        bool ambiguous = false;
        void* gic = object_resolve_path_type("", "arm_gic", &ambiguous);
        if (gic == nullptr) fail("this machine has no arm_gic: run QEMU with -M xilinx-zynq-a9.");
        irq_ = qdev_get_gpio_in(gic, IRQ_F2P_0);

        timer_init_full(
            &timer_, nullptr, qemu::CLOCK_VIRTUAL, qemu::SCALE_NS, 0,
            [](void* plugin) {
                static_cast<Plugin*>(plugin)->guarded([](Plugin& self) { return self.tick(), uint64_t{0}; });
            },
            this);
        deadline_ns_ = COARSE_NS;
        timer_mod(&timer_, static_cast<int64_t>(deadline_ns_));
        vm_start();
    }

    void write_memory(uint64_t address, const uint8_t* bytes, size_t count) override {
        cpu_physical_memory_rw(address, const_cast<uint8_t*>(bytes), count, true);
    }
    void read_memory(uint64_t address, uint8_t* bytes, size_t count) override {
        cpu_physical_memory_rw(address, bytes, count, false);
    }
    void first_pixel(uint32_t index, uint64_t time_ns) override { log_.first_pixel(index, time_ns); }
    void last_pixel(uint32_t index, uint64_t time_ns) override {
        log_.last_pixel(index, time_ns);
        last_pixel_ns_ = time_ns;
        record_due_ = true;
        finished_ = index + 1 == frames_.shown();
    }
    void irq(bool level, uint64_t time_ns) override {
        log_.irq(level, time_ns);
        qemu_set_irq(irq_, level);
    }
    void record(uint64_t address, uint64_t time_ns) override {
        log_.record(*this, address, time_ns);
        record_due_ = false;
    }

private:
    // No exception may pass through QEMU's C code.
    template <typename Action>
    uint64_t guarded(Action action) {
        try {
            return action(*this);
        } catch (const std::exception& error) {
            fail(error.what());
        }
    }

    uint64_t read(uint64_t address, unsigned size) {
        model_->advance_to(virtual_ns());
        const uint64_t word = model_->read(static_cast<uint32_t>(address & ~uint64_t{3}));
        return word >> (8 * (address & 3)) & (~uint64_t{0} >> (64 - 8 * size));
    }

    void write(uint64_t address, uint64_t value, unsigned size) {
        const auto word_address = static_cast<uint32_t>(address & ~uint64_t{3});
        if (word_address == LANDING_REG_FRAME_SIZE_OFFSET) value = frame_size(value, size);
        model_->advance_to(virtual_ns());
        model_->write(word_address, static_cast<uint32_t>(value << (8 * (address & 3))),
                      ((1u << size) - 1) << (address & 3));
        if (word_address == LANDING_REG_CTRL_OFFSET && (value & LANDING_REG_CTRL_ENABLE_MASK) != 0) enabled_ = true;
    }

    // The firmware is built for its camera; a test camera may be smaller.
    uint64_t frame_size(uint64_t written, unsigned size) const {
        const uint64_t shown = frames_.height() << 16 | frames_.width();
        if (shown == CAMERA_SIZE) return written;
        if (size == 4 && written == CAMERA_SIZE) return shown;
        throw std::runtime_error("the firmware wrote " + std::to_string(written) + " to FRAME_SIZE and not " +
                                 std::to_string(CAMERA_SIZE) + ", the 1280x720 of the board's camera.");
    }

    void tick() {
        model_->advance_to(deadline_ns_);
        if (!enabled_ && deadline_ns_ > BOOT_LIMIT_NS)
            fail("the firmware did not enable the camera input within 20 ms; look at its messages on UART1.");
        if (finished_ && deadline_ns_ >= last_pixel_ns_ + tail_ns_) {
            log_.end(deadline_ns_);
            leave(0);
        }
        deadline_ns_ += record_due_ ? FINE_NS : COARSE_NS;
        timer_mod(&timer_, static_cast<int64_t>(deadline_ns_));
    }

    RunLog log_;
    FrameList frames_;
    uint64_t tail_ns_;
    std::unique_ptr<LandingModel> model_;
    qemu::MemoryRegion region_ = {};
    qemu::Timer timer_ = {};
    UartTap uarts_[2];
    void* irq_ = nullptr;
    uint64_t deadline_ns_ = 0;
    uint64_t last_pixel_ns_ = 0;
    bool enabled_ = false;
    bool finished_ = false;
    bool record_due_ = false;
};

void check_version() {
    void* error = nullptr;
    const qemu::VersionInfo* version = qmp_query_version(&error);
    if (version->qemu->major == qemu::KNOWN_MAJOR && version->qemu->minor == qemu::KNOWN_MINOR) return;
    fail("the co-simulation works with QEMU 7.2 and this is " + std::to_string(version->qemu->major) + "." +
         std::to_string(version->qemu->minor) + ": install Debian 12's package qemu-system-arm, or use FIRMWARE=host.");
}

}  // namespace
}  // namespace touchdown

extern "C" {

__attribute__((visibility("default"))) int qemu_plugin_version = qemu::PLUGIN_API;

__attribute__((visibility("default"))) int qemu_plugin_install(uint64_t, const qemu::PluginInfo*, int count,
                                                               char** arguments) {
    using namespace touchdown;
    check_version();
    try {
        // Lives as long as the process: QEMU keeps pointers into it.
        static Plugin* plugin = new Plugin(Arguments(count, arguments));
        aio_bh_schedule_oneshot_full(
            qemu_get_aio_context(), [](void* self) { static_cast<Plugin*>(self)->map(); }, plugin, "touchdown-map");
    } catch (const std::exception& error) {
        fail(error.what());
    }
    return 0;
}
}
