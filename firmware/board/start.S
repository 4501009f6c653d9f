// SPDX-License-Identifier: Apache-2.0
// From reset, or from whatever loaded the ELF, to main(); and exception entry.
// Main code and interrupts share the system-mode stack.

    .syntax unified
    .arm

    .equ MODE_ABORT, 0x17
    .equ MODE_UNDEFINED, 0x1B
    .equ MODE_SYSTEM, 0x1F

    .equ PAINT, 0x5AFE57AC                  // of the stack, as in stack.c

    .equ DFSR_STATUS, 0x40F
    .equ DFSR_ASYNCHRONOUS_EXTERNAL, 0x406

    .equ SCTLR_MMU, 1 << 0
    .equ SCTLR_DCACHE, 1 << 2
    .equ SCTLR_BRANCH_PREDICTION, 1 << 11
    .equ SCTLR_ICACHE, 1 << 12

    .section .vectors, "ax"
    .global vectors
vectors:
    b   start
    b   undefined_entry
    b   supervisor_call_entry
    b   prefetch_abort_entry
    b   data_abort_entry
    nop
    b   interrupt_entry
    b   fast_interrupt_entry

// The same, for the one moment in which an abort is not ours.
    .balign 32
loader_vectors:
    b   start
    b   undefined_entry
    b   supervisor_call_entry
    b   prefetch_abort_entry
    b   loader_abort_entry
    nop
    b   interrupt_entry
    b   fast_interrupt_entry

    .section .text.start, "ax"
    .global start
start:
    cpsid   aif
    mrc     p15, 0, r0, c0, c0, 5           // MPIDR: the second core has no part in this
    ands    r0, r0, #3
park:
    wfine
    bne     park

    // Nothing of what a loader left in caches, TLB or predictor is ours.
    mrc     p15, 0, r0, c1, c0, 0
    bic     r0, r0, #(SCTLR_MMU | SCTLR_DCACHE)
    bic     r0, r0, #(SCTLR_BRANCH_PREDICTION | SCTLR_ICACHE)
    mcr     p15, 0, r0, c1, c0, 0
    isb
    mov     r0, #0
    mcr     p15, 0, r0, c8, c7, 0           // TLBIALL
    mcr     p15, 0, r0, c7, c5, 0           // ICIALLU
    mcr     p15, 0, r0, c7, c5, 6           // BPIALL
    // L1 data cache of the Cortex-A9, 32 KB: 4 ways, 256 sets of 32 bytes.
    mov     r1, #0                          // way in bits 31:30
1:  mov     r2, #(255 << 5)                 // set in bits 12:5
2:  orr     r3, r1, r2
    mcr     p15, 0, r3, c7, c6, 2           // DCISW
    subs    r2, r2, #(1 << 5)
    bge     2b
    adds    r1, r1, #(1 << 30)
    bcc     1b
    dsb

    ldr     r0, =vectors
    mcr     p15, 0, r0, c12, c0, 0          // VBAR

    cps     #MODE_ABORT
    ldr     sp, =abort_stack_top
    cps     #MODE_UNDEFINED
    ldr     sp, =undefined_stack_top
    cps     #MODE_SYSTEM
    ldr     sp, =stack_top

    // VFP and NEON: access for all privilege levels, then on.
    mrc     p15, 0, r0, c1, c0, 2
    orr     r0, r0, #(0xF << 20)
    mcr     p15, 0, r0, c1, c0, 2
    isb
    mov     r0, #(1 << 30)
    vmsr    fpexc, r0

    ldr     r0, =bss_start
    ldr     r1, =bss_end
    mov     r2, #0
3:  cmp     r0, r1
    strlo   r2, [r0], #4
    blo     3b

    // What has never been on the stack stays painted.
    ldr     r0, =stack_bottom
    ldr     r1, =stack_top
    ldr     r2, =PAINT
4:  cmp     r0, r1
    strlo   r2, [r0], #4
    blo     4b

    // From here on an access that a bus answers with an error is a fault, also one that is answered late. One that
    // the boot loader left pending is taken at once, and is not: nothing is known of it, and it is over.
    ldr     r0, =loader_vectors
    ldr     r1, =vectors
    mcr     p15, 0, r0, c12, c0, 0          // VBAR
    isb
    dsb
    cpsie   a
    isb
    mcr     p15, 0, r1, c12, c0, 0
    isb

    bl      mmu_enable
    bl      main
5:  wfi
    b       5b

// Goes on where it was.
loader_abort_entry:
    sub     lr, lr, #8
    srsdb   sp!, #MODE_ABORT
    rfeia   sp!

// Return state and the registers that C may change go on the system-mode stack.
interrupt_entry:
    sub     lr, lr, #4
    srsdb   sp!, #MODE_SYSTEM
    cps     #MODE_SYSTEM
    push    {r0-r3, r12, lr}
    and     r1, sp, #4                      // the procedure call standard wants 8-byte alignment
    sub     sp, sp, r1
    vpush   {d0-d7}
    vpush   {d16-d31}
    vmrs    r0, fpscr
    push    {r0, r1}
    bl      gic_dispatch
    pop     {r0, r1}
    vmsr    fpscr, r0
    vpop    {d16-d31}
    vpop    {d0-d7}
    add     sp, sp, r1
    pop     {r0-r3, r12, lr}
interrupt_return:                           // where the co-simulation stops counting
    rfeia   sp!

// fault_report(kind, address of the instruction) does not return. A late answer to an access of before must not
// take the place of what it has to say; aborts and fast interrupts mask those themselves.
undefined_entry:
    cpsid   a
    sub     r1, lr, #4
    mov     r0, #0
    b       fault_report
supervisor_call_entry:
    cpsid   a
    ldr     sp, =undefined_stack_top
    sub     r1, lr, #4
    mov     r0, #1
    b       fault_report
prefetch_abort_entry:
    sub     r1, lr, #4
    mov     r0, #2
    b       fault_report
data_abort_entry:
    sub     r1, lr, #8
    mrc     p15, 0, r2, c5, c0, 0           // DFSR
    movw    r3, #DFSR_STATUS
    and     r2, r2, r3
    movw    r3, #DFSR_ASYNCHRONOUS_EXTERNAL
    cmp     r2, r3
    movne   r0, #3
    moveq   r0, #5                          // the address is where the answer found us, not who asked
    b       fault_report
fast_interrupt_entry:
    ldr     sp, =undefined_stack_top
    sub     r1, lr, #4
    mov     r0, #4
    b       fault_report
