// SPDX-License-Identifier: Apache-2.0
#ifndef TOUCHDOWN_MMU_H
#define TOUCHDOWN_MMU_H

// Identity map, caches and branch prediction on. Called once, from start.S.
void mmu_enable(void);

#endif
