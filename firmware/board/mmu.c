// SPDX-License-Identifier: Apache-2.0
// One table of 1 MB sections, identity mapped:
//   0x00000000  1 MB    no access: null pointers fault
//   0x00100000  31 MB   normal, write-back: code and data
//   0x02000000  1 MB    normal, not cached: the result ring
//   0x40000000  1 GB    device: programmable logic behind M_AXI_GP0
//   0xE0000000  3 MB    device: UARTs
//   0xF8000000  16 MB   device: GIC and timers
// The ring is not cached because the HP port is not coherent: with cached
// lines each frame would need an invalidation by address, and a line that the
// core fetched ahead of time would still be stale. Each byte is read once, so
// a cache would win nothing. Packed MAVLink structures need Normal memory:
// unaligned access to strongly-ordered memory faults.
#include "mmu.h"

#include <stdint.h>

#define SECTIONS 4096U

// Section descriptors, access permission 0b11 (full) in domain 0 (client).
#define SECTION 0x2U
#define ACCESS_FULL (3U << 10)
#define EXECUTE_NEVER (1U << 4)
#define TEX(n) ((uint32_t)(n) << 12)
#define C_BIT (1U << 3)
#define B_BIT (1U << 2)
// Not shareable: the Cortex-A9 does not cache shareable memory while SMP mode is off.
#define NORMAL_CACHED (SECTION | ACCESS_FULL | TEX(1) | C_BIT | B_BIT)
#define NORMAL_UNCACHED (SECTION | ACCESS_FULL | EXECUTE_NEVER | TEX(1))
#define DEVICE (SECTION | ACCESS_FULL | EXECUTE_NEVER | B_BIT)

#define SCTLR_MMU (1U << 0)
#define SCTLR_DCACHE (1U << 2)
#define SCTLR_BRANCH_PREDICTION (1U << 11)
#define SCTLR_ICACHE (1U << 12)
#define SCTLR_ALIGNMENT_CHECK (1U << 1)

static uint32_t table[SECTIONS] __attribute__((aligned(16384), section(".translation_table")));

static void map(uint32_t first_mb, uint32_t count_mb, uint32_t attributes)
{
    for (uint32_t mb = first_mb; mb < first_mb + count_mb; mb++) {
        table[mb] = (mb << 20) | attributes;
    }
}

void mmu_enable(void)
{
    uint32_t control;

    map(0x001U, 31U, NORMAL_CACHED);
    map(0x020U, 1U, NORMAL_UNCACHED);
    map(0x400U, 1024U, DEVICE);
    map(0xE00U, 3U, DEVICE);
    map(0xF80U, 16U, DEVICE);
    __asm__ volatile("dsb\n\t"
                     "mcr p15, 0, %0, c2, c0, 0\n\t" // TTBR0
                     "mcr p15, 0, %1, c2, c0, 2\n\t" // TTBCR: only TTBR0
                     "mcr p15, 0, %2, c3, c0, 0\n\t" // DACR: domain 0 client
                     "mcr p15, 0, %1, c8, c7, 0\n\t" // TLBIALL
                     "dsb\n\tisb" ::"r"(table),
                     "r"(0U), "r"(1U)
                     : "memory");
    __asm__ volatile("mrc p15, 0, %0, c1, c0, 0" : "=r"(control));
    control |= SCTLR_MMU | SCTLR_DCACHE | SCTLR_BRANCH_PREDICTION | SCTLR_ICACHE;
    control &= ~SCTLR_ALIGNMENT_CHECK;
    __asm__ volatile("mcr p15, 0, %0, c1, c0, 0\n\tisb" ::"r"(control) : "memory");
}
