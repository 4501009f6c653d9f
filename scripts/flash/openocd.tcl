# SPDX-License-Identifier: Apache-2.0
# The same as xsct.tcl for OpenOCD: what ps7_init.tcl expects of xsct, and the two steps.

# Memory as xsct prints it: address, colon, eight digits, end of line.
proc mrd {args} {
    set address [lindex $args end]
    return [format "%08X:   %08X\n" $address [read_memory $address 32 1]]
}

proc mwr {args} {
    mww [lindex $args end-1] [lindex $args end]
}

proc configparams {args} {
}

proc ps_begin {ps7_init} {
    init
    targets zynq.cpu0
    halt
    uplevel #0 [list source $ps7_init]
}

proc ps_init {ps7_init} {
    ps_begin $ps7_init
    ps7_init
    shutdown
}

proc ps_run {ps7_init {elf ""} {entry 0}} {
    ps_begin $ps7_init
    ps7_post_config
    if {$elf ne ""} {
        load_image $elf
        resume $entry
    }
    shutdown
}
