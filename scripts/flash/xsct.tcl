# SPDX-License-Identifier: Apache-2.0
# The processor by way of JTAG, in two steps with the bitstream between them:
#   xsct scripts/flash/xsct.tcl init <ps7_init.tcl>
#   xsct scripts/flash/xsct.tcl run <ps7_init.tcl> [elf]
# Without a program the registers can be read and written by hand.

lassign $argv step ps7_init elf
# The server that `connect` starts by itself holds the cable for 20 s after the last user, and openFPGALoader is next:
# so one of our own, which goes after 2 s.
exec hw_server -d -s tcp:localhost:3150 -p0 -I2
after 500
connect -url tcp:localhost:3150
targets -set -nocase -filter {name =~ "APU*"}
if {$step eq "init"} {
    # A reset of the whole may clear the logic too, so it comes before the bitstream.
    rst -system
    after 3000
    targets -set -nocase -filter {name =~ "APU*"}
    source $ps7_init
    ps7_init
} else {
    source $ps7_init
    # Opens the way between processor and logic; the logic has to be there by now.
    ps7_post_config
    if {$elf ne ""} {
        targets -set -nocase -filter {name =~ "*A9*#0"}
        rst -processor
        dow $elf
        con
    }
}
disconnect
after 4000
