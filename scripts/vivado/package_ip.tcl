# SPDX-License-Identifier: Apache-2.0
# Packages one core as IP-XACT, with its AXI interfaces, their clock and its reset:
#   vivado -mode batch -source scripts/vivado/package_ip.tcl -tclargs build/ip/inputs/<core>.tcl
# scripts/vivado.py writes the inputs, interfaces included, from the ports of the RTL.

set here [file dirname [file normalize [info script]]]
source [file join $here common.tcl]
source [lindex $argv 0]
check_version $wanted_version

file delete -force $out
file mkdir $out
create_project -in_memory -part $part
read_verilog $sources
foreach header $headers {
    set_property file_type {Verilog Header} [get_files $header]
}
set_property top $top [current_fileset]
set_property include_dirs $include_dirs [current_fileset]
update_compile_order -fileset sources_1

ipx::package_project -root_dir $out -vendor touchdown -library touchdown -taxonomy /Touchdown -import_files \
    -set_current true -force
set core [ipx::current_core]
set_property name $top $core
set_property version 1.0 $core
set_property display_name $top $core
set_property description $description $core
set_property supported_families {zynq Production artix7 Production kintex7 Production} $core

# Only what the RTL says, not what a name may look like.
ipx::remove_all_bus_interface $core
foreach {name vlnv ports} $interfaces {
    ipx::infer_bus_interface $ports $vlnv $core
}
foreach name $clocks {
    ipx::infer_bus_interface $name xilinx.com:signal:clock_rtl:1.0 $core
}
foreach name $resets {
    ipx::infer_bus_interface $name xilinx.com:signal:reset_rtl:1.0 $core
    set parameter [ipx::add_bus_parameter POLARITY [ipx::get_bus_interfaces $name -of_objects $core]]
    set_property value ACTIVE_HIGH $parameter
}
foreach {name vlnv ports} $interfaces {
    ipx::associate_bus_interfaces -busif $name -clock clk $core
}
# What a block design needs to give the registers an address.
foreach name $registers {
    ipx::add_memory_map $name $core
    set_property slave_memory_map_ref $name [ipx::get_bus_interfaces $name -of_objects $core]
    set map [ipx::get_memory_maps $name -of_objects $core]
    set block [ipx::add_address_block registers $map]
    set_property range 4096 $block
    set_property usage register $block
}
foreach name $resets {
    ipx::associate_bus_interfaces -clock clk -reset $name $core
}
ipx::create_xgui_files $core
ipx::update_checksums $core
ipx::check_integrity $core
ipx::save_core $core
puts "touchdown: $out holds $top."
close_project
