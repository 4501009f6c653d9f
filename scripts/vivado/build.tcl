# SPDX-License-Identifier: Apache-2.0
# Builds the board in one run, without a project on disk:
#   vivado -mode batch -source scripts/vivado/build.tcl -tclargs build/vivado/inputs.tcl
# scripts/vivado.py writes the inputs: what to read, where Digilent's library is, what to make (bitstream or xsa).

set here [file dirname [file normalize [info script]]]
foreach script {common digilent ps7_settings zynq_ps reports} {
    source [file join $here $script.tcl]
}
source [lindex $argv 0]
check_version $wanted_version

# Nothing of an older run is taken for a result of this one.
file delete -force [file join $out ip] [file join $out bd]
file delete -force [file join $out touchdown.bit] [file join $out touchdown.xsa]
file mkdir [file join $out ip] [file join $out bd]

create_project -in_memory -part $part
set_property target_language Verilog [current_project]
make_digilent $digilent_ip [file join $out ip]
make_zynq_ps [file join $out bd] $register_bases

read_verilog $sources
foreach constraint $constraints {
    read_xdc $constraint
}

synth_design -top $top -part $part -include_dirs $include_dirs
write_checkpoint -force [file join $out synthesised.dcp]
report_utilization -hierarchical -file [file join $out utilization_synthesised.rpt]

opt_design
place_design
phys_opt_design
route_design
write_checkpoint -force [file join $out routed.dcp]

write_reports $out
require_timing $out
write_bitstream -force [file join $out touchdown.bit]
if {$goal eq "xsa"} {
    write_hw_platform -fixed -include_bit -force -file [file join $out touchdown.xsa]
}
puts "touchdown: [file join $out touchdown.bit] is there; timing is met, reports are in $out."
