// SPDX-License-Identifier: Apache-2.0
#include "sim/cosim/qemu_machine.h"

#include <unistd.h>

#include <cstdio>
#include <exception>

#include "sim/verilated/landing_layout.h"

namespace touchdown {
namespace {

constexpr uint64_t PL_ADDRESS = 0x43C00000;
constexpr uint64_t PL_BYTES = 0x1000;
constexpr int IRQ_F2P_0 = 29;  // shared peripheral interrupt: GIC ID 61
constexpr uint64_t FIRST_DEADLINE_NS = 10'000;
// Virtual time in which the firmware must enable the camera input.
constexpr uint64_t BOOT_LIMIT_NS = 20'000'000;
constexpr int OVERLAY_PRIORITY = 10;

constexpr uint64_t UART_ADDRESS[2] = {0xE0000000, 0xE0001000};
constexpr uint64_t UART_BAUDGEN = 0x18;
constexpr uint64_t UART_FIFO = 0x30;
constexpr uint64_t UART_BAUDDIV = 0x34;
constexpr double UART_REFERENCE_HZ = 100e6;

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

void check_version() {
    void* error = nullptr;
    const qemu::VersionInfo* version = qmp_query_version(&error);
    if (version->qemu->major == qemu::KNOWN_MAJOR && version->qemu->minor == qemu::KNOWN_MINOR) return;
    fail("the co-simulation works with QEMU 7.2 and this is " + std::to_string(version->qemu->major) + "." +
         std::to_string(version->qemu->minor) + ": install Debian 12's package qemu-system-arm, or use FIRMWARE=host.");
}

}  // namespace

void leave(int code) {
    std::fflush(nullptr);
    _exit(code);
}

void fail(const std::string& sentence) {
    std::fprintf(stderr, "touchdown: %s\n", sentence.c_str());
    leave(1);
}

void UartTap::map(unsigned port, Machine& machine) {
    port_ = port;
    machine_ = &machine;
    uart_ = memory_region_find(get_system_memory(), UART_ADDRESS[port], 4).region;
    static const qemu::MemoryRegionOps ops = register_ops(
        [](void* tap, uint64_t, unsigned) { return static_cast<UartTap*>(tap)->read(UART_FIFO); },
        [](void* tap, uint64_t, uint64_t value, unsigned) { static_cast<UartTap*>(tap)->write(value); });
    memory_region_init_io(&region_, nullptr, &ops, this, "touchdown-uart-tap", 4);
    memory_region_add_subregion_overlap(get_system_memory(), UART_ADDRESS[port] + UART_FIFO, &region_,
                                        OVERLAY_PRIORITY);
}

double UartTap::baud() {
    return UART_REFERENCE_HZ / static_cast<double>(read(UART_BAUDGEN)) / static_cast<double>(read(UART_BAUDDIV) + 1);
}

uint64_t UartTap::read(uint64_t offset) {
    uint64_t value = 0;
    memory_region_dispatch_read(uart_, offset, &value, qemu::MEM_OP_SIZE_4, qemu::ATTRS_UNSPECIFIED);
    return value;
}

void UartTap::write(uint64_t value) {
    const uint64_t now = virtual_ns();
    machine_->uart(port_, now, wire_.send(now, baud()), static_cast<uint8_t>(value));
    memory_region_dispatch_write(uart_, UART_FIFO, value, qemu::MEM_OP_SIZE_4, qemu::ATTRS_UNSPECIFIED);
}

Machine::Machine(const ModelConfig& config, Camera& camera)
    : model_(config, camera, *this), deadline_ns_(FIRST_DEADLINE_NS) {}

void Machine::install(Machine* machine) {
    check_version();
    aio_bh_schedule_oneshot_full(
        qemu_get_aio_context(), [](void* self) { static_cast<Machine*>(self)->map(); }, machine, "touchdown-map");
}

// In QEMU's main loop, after the machine was built and before it runs.
void Machine::map() {
    static const qemu::MemoryRegionOps ops = register_ops(
        [](void* machine, uint64_t address, unsigned size) {
            return static_cast<Machine*>(machine)->guarded([&](Machine& self) { return self.read(address, size); });
        },
        [](void* machine, uint64_t address, uint64_t value, unsigned size) {
            static_cast<Machine*>(machine)->guarded(
                [&](Machine& self) { return self.write(address, value, size), uint64_t{0}; });
        });
    memory_region_init_io(&region_, nullptr, &ops, this, "landing-core", PL_BYTES);
    memory_region_add_subregion_overlap(get_system_memory(), PL_ADDRESS, &region_, OVERLAY_PRIORITY);
    for (unsigned port = 0; port < 2; ++port) taps_[port].map(port, *this);

    bool ambiguous = false;
    void* gic = object_resolve_path_type("", "arm_gic", &ambiguous);
    if (gic == nullptr) fail("this machine has no arm_gic: run QEMU with -M xilinx-zynq-a9.");
    irq_ = qdev_get_gpio_in(gic, IRQ_F2P_0);

    timer_init_full(
        &timer_, nullptr, qemu::CLOCK_VIRTUAL, qemu::SCALE_NS, 0,
        [](void* machine) {
            static_cast<Machine*>(machine)->guarded([](Machine& self) { return self.deadline(), uint64_t{0}; });
        },
        this);
    timer_mod(&timer_, static_cast<int64_t>(deadline_ns_));
    vm_start();
}

void Machine::write_memory(uint64_t address, const uint8_t* bytes, size_t count) {
    cpu_physical_memory_rw(address, const_cast<uint8_t*>(bytes), count, true);
}

void Machine::read_memory(uint64_t address, uint8_t* bytes, size_t count) {
    cpu_physical_memory_rw(address, bytes, count, false);
}

void Machine::irq(bool level, uint64_t) { qemu_set_irq(irq_, level); }

// No exception may pass through QEMU's C code.
template <typename Action>
uint64_t Machine::guarded(Action action) {
    try {
        return action(*this);
    } catch (const std::exception& error) {
        fail(error.what());
    }
}

uint64_t Machine::read(uint64_t address, unsigned size) {
    model_.advance_to(virtual_ns());
    const uint64_t word = model_.read(static_cast<uint32_t>(address & ~uint64_t{3}));
    return word >> (8 * (address & 3)) & (~uint64_t{0} >> (64 - 8 * size));
}

void Machine::write(uint64_t address, uint64_t value, unsigned size) {
    const auto word_address = static_cast<uint32_t>(address & ~uint64_t{3});
    if (word_address == LANDING_REG_FRAME_SIZE_OFFSET) value = frame_size(value, size);
    model_.advance_to(virtual_ns());
    model_.write(word_address, static_cast<uint32_t>(value << (8 * (address & 3))),
                 ((1u << size) - 1) << (address & 3));
    if (word_address == LANDING_REG_CTRL_OFFSET && (value & LANDING_REG_CTRL_ENABLE_MASK) != 0) enabled_ = true;
}

void Machine::deadline() {
    model_.advance_to(deadline_ns_);
    if (!enabled_ && deadline_ns_ > BOOT_LIMIT_NS)
        fail("the firmware did not enable the camera input within 20 ms; look at its messages on UART1.");
    deadline_ns_ = tick(deadline_ns_);
    timer_mod(&timer_, static_cast<int64_t>(deadline_ns_));
}

}  // namespace touchdown

extern "C" {
__attribute__((visibility("default"))) int qemu_plugin_version = qemu::PLUGIN_API;
}
