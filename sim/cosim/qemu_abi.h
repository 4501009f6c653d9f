// SPDX-License-Identifier: Apache-2.0
// The few symbols of QEMU 7.2 that the plugin calls. Debian ships no header for
// them: they are internal, and their layout holds for this series only, which is
// why the plugin refuses any other.
#pragma once

#include <cstddef>
#include <cstdint>

namespace qemu {

constexpr int KNOWN_MAJOR = 7;
constexpr int KNOWN_MINOR = 2;
constexpr int PLUGIN_API = 1;

constexpr int CLOCK_VIRTUAL = 1;    // QEMU_CLOCK_VIRTUAL
constexpr int SCALE_NS = 1;
constexpr int LITTLE_ENDIAN_DEVICE = 2;
constexpr uint32_t MEM_OP_SIZE_4 = 2;  // MemOp: log2 of the size
constexpr uint32_t ATTRS_UNSPECIFIED = 1;

constexpr int PLUGIN_INLINE_ADD = 0;
constexpr int PLUGIN_NO_REGISTERS = 0;

// Larger than QEMU's own, which only QEMU looks into.
struct MemoryRegion {
    alignas(16) unsigned char opaque[1024];
};
struct Timer {
    alignas(16) unsigned char opaque[128];
};

struct MemoryRegionSection {
    unsigned __int128 size;
    MemoryRegion* region;
    void* flat_view;
    uint64_t offset_within_region;
    uint64_t offset_within_address_space;
    bool readonly;
    bool nonvolatile;
};

struct MemoryRegionOps {
    uint64_t (*read)(void* opaque, uint64_t address, unsigned size);
    void (*write)(void* opaque, uint64_t address, uint64_t value, unsigned size);
    void* read_with_attrs;
    void* write_with_attrs;
    int endianness;
    struct {
        unsigned min_size, max_size;
        bool unaligned;
        void* accepts;
    } valid;
    struct {
        unsigned min_size, max_size;
        bool unaligned;
    } impl;
};

struct VersionTriple {
    int64_t major, minor, micro;
};
struct VersionInfo {
    VersionTriple* qemu;
    char* package;
};

struct PluginInfo {
    const char* target_name;
    struct {
        int min, current;
    } version;
    bool system_emulation;
    int smp_vcpus, max_vcpus;
};

}  // namespace qemu

extern "C" {
qemu::VersionInfo* qmp_query_version(void** error);

void* get_system_memory();
void memory_region_init_io(qemu::MemoryRegion* region, void* owner, const qemu::MemoryRegionOps* ops, void* opaque,
                           const char* name, uint64_t size);
void memory_region_add_subregion_overlap(void* parent, uint64_t offset, qemu::MemoryRegion* region, int priority);
qemu::MemoryRegionSection memory_region_find(void* parent, uint64_t address, uint64_t size);
uint32_t memory_region_dispatch_read(qemu::MemoryRegion* region, uint64_t offset, uint64_t* value, uint32_t op,
                                     uint32_t attrs);
uint32_t memory_region_dispatch_write(qemu::MemoryRegion* region, uint64_t offset, uint64_t value, uint32_t op,
                                      uint32_t attrs);
void cpu_physical_memory_rw(uint64_t address, void* bytes, uint64_t count, bool is_write);

void* object_resolve_path_type(const char* path, const char* type, bool* ambiguous);
void* qdev_get_gpio_in(void* device, int number);
void qemu_set_irq(void* irq, int level);

void* qemu_chr_find(const char* name);
int qemu_chr_be_can_write(void* chardev);
void qemu_chr_be_write(void* chardev, const uint8_t* bytes, int count);

int64_t qemu_clock_get_ns(int clock);
void timer_init_full(qemu::Timer* timer, void* group, int clock, int scale, int attributes, void (*callback)(void*),
                     void* opaque);
void timer_mod(qemu::Timer* timer, int64_t expire);

// QEMU's plugin interface; the meter needs no more.
void qemu_plugin_register_vcpu_tb_trans_cb(uint64_t id, void (*callback)(uint64_t id, void* block));
size_t qemu_plugin_tb_n_insns(const void* block);
void* qemu_plugin_tb_get_insn(const void* block, size_t index);
uint64_t qemu_plugin_insn_vaddr(const void* instruction);
void qemu_plugin_register_vcpu_tb_exec_inline(void* block, int operation, void* number, uint64_t operand);
void qemu_plugin_register_vcpu_insn_exec_cb(void* instruction, void (*callback)(unsigned cpu, void* data), int flags,
                                            void* data);

void* qemu_get_aio_context();
void aio_bh_schedule_oneshot_full(void* context, void (*callback)(void*), void* opaque, const char* name);
void vm_start();
}
