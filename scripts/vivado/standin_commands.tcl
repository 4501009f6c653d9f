# SPDX-License-Identifier: Apache-2.0
# Commands of Vivado 2023.2 that the stand-in knows, as UG835 and UG1118 have them: options that stand alone, options
# with a value, the least and the most of other arguments (-1: any number), and `xdc` where constraints may use it. Only
# what scripts here have use for; a command that is missing here has to be looked up and entered.

namespace eval standin {
    variable commands
}

foreach {name flags valued least most where} {
    version {-short -quiet} {} 0 0 script
    create_project {-in_memory -force -quiet} {-part} 0 2 script
    close_project {-quiet} {} 0 0 script
    current_project {-quiet} {} 0 1 script
    current_fileset {-quiet -simset -constrset -srcset} {} 0 1 script
    current_design {-quiet} {} 0 1 xdc
    set_property {-quiet -verbose} {-dict -name} 1 3 xdc
    get_property {-quiet -min -max} {} 2 2 script
    update_ip_catalog {-rebuild -quiet} {} 0 0 script
    get_ipdefs {-quiet -all} {-filter} 0 -1 script
    create_ip {-quiet -force} {-vlnv -name -vendor -library -version -module_name -dir} 0 0 script
    get_ips {-quiet -all} {-filter} 0 -1 script
    get_files {-quiet -all} {-of_objects -filter} 0 -1 script
    generate_target {-force -quiet} {} 2 2 script
    read_verilog {-sv -quiet} {-library} 1 1 script
    read_xdc {-unmanaged -no_add -quiet} {-cells -ref} 1 1 script
    update_compile_order {-quiet} {-fileset} 0 0 script
    synth_design {-quiet -rtl} {-name -part -top -include_dirs -generic -directive -flatten_hierarchy} 0 0 script
    opt_design {-quiet -verbose} {-directive} 0 0 script
    place_design {-quiet -verbose} {-directive} 0 0 script
    phys_opt_design {-quiet -verbose} {-directive} 0 0 script
    route_design {-quiet -verbose} {-directive} 0 0 script
    write_checkpoint {-force -quiet} {} 1 1 script
    write_bitstream {-force -quiet -bin_file} {} 1 1 script
    write_hw_platform {-fixed -force -include_bit -quiet -minimal} {-file} 0 1 script
    report_utilization {-hierarchical -quiet} {-file} 0 0 script
    report_timing_summary {-report_unconstrained -quiet} {-file -max_paths -delay_type} 0 0 script
    check_timing {-verbose -quiet} {-file} 0 0 script
    report_cdc {-details -quiet} {-file -from -to -severity} 0 0 script
    report_clock_interaction {-quiet} {-file} 0 0 script
    report_clock_utilization {-quiet} {-file} 0 0 script
    report_drc {-quiet} {-file -ruledecks -checks} 0 0 script
    report_methodology {-quiet} {-file} 0 0 script
    report_power {-quiet} {-file} 0 0 script
    get_timing_paths {-setup -hold -quiet} {-max_paths -nworst -from -to -slack_lesser_than} 0 0 script
    get_ports {-quiet -nocase} {-filter -of_objects} 0 1 xdc
    get_pins {-hierarchical -quiet -leaf} {-filter -of_objects} 0 1 xdc
    get_cells {-hierarchical -quiet} {-filter -of_objects} 0 1 xdc
    get_nets {-hierarchical -quiet} {-filter -of_objects} 0 1 xdc
    get_clocks {-include_generated_clocks -quiet} {-filter -of_objects} 0 1 xdc
    create_clock {-add -quiet} {-name -period -waveform} 0 1 xdc
    create_generated_clock {-add -invert -quiet} {-name -source -divide_by -multiply_by -master_clock -edges} 1 1 xdc
    set_clock_groups {-asynchronous -physically_exclusive -logically_exclusive -quiet} {-group -name} 0 0 xdc
    set_input_jitter {-quiet} {} 2 2 xdc
    set_max_delay {-datapath_only -quiet} {-from -to -through} 1 1 xdc
    set_bus_skew {-quiet} {-from -to} 1 1 xdc
    set_false_path {-setup -hold -quiet} {-from -to -through} 0 0 xdc
    create_bd_design {-quiet -bdsource} {-dir} 1 1 script
    create_bd_cell {-quiet} {-type -vlnv -reference} 1 1 script
    create_bd_port {-quiet} {-dir -type -from -to} 1 1 script
    create_bd_intf_port {-quiet} {-mode -vlnv} 1 1 script
    connect_bd_net {-quiet} {-net} 2 -1 script
    connect_bd_intf_net {-quiet} {-intf_net} 2 2 script
    get_bd_cells {-quiet -hierarchical} {-filter} 0 1 script
    get_bd_pins {-quiet -hierarchical} {-filter -of_objects} 0 1 script
    get_bd_ports {-quiet} {-filter} 0 1 script
    get_bd_intf_pins {-quiet -hierarchical} {-filter} 0 1 script
    get_bd_intf_ports {-quiet} {-filter} 0 1 script
    get_bd_addr_spaces {-quiet} {-filter -of_objects} 0 1 script
    get_bd_addr_segs {-quiet} {-filter -of_objects} 0 1 script
    assign_bd_address {-quiet -force} {-target_address_space -offset -range} 0 1 script
    apply_bd_automation {-quiet} {-rule -config} 1 1 script
    validate_bd_design {-quiet -force} {} 0 0 script
    save_bd_design {-quiet} {} 0 1 script
    ipx::package_project {-import_files -force -quiet} {-root_dir -vendor -library -taxonomy -set_current} 0 0 script
    ipx::current_core {-quiet} {} 0 1 script
    ipx::remove_all_bus_interface {-quiet} {} 1 1 script
    ipx::infer_bus_interface {-quiet} {} 3 3 script
    ipx::get_bus_interfaces {-quiet} {-of_objects -filter} 0 1 script
    ipx::add_memory_map {-quiet} {} 2 2 script
    ipx::get_memory_maps {-quiet} {-of_objects -filter} 0 1 script
    ipx::add_address_block {-quiet} {} 2 2 script
    ipx::add_bus_parameter {-quiet} {} 2 2 script
    ipx::associate_bus_interfaces {-quiet -clear} {-busif -clock -reset} 1 1 script
    ipx::create_xgui_files {-quiet} {} 1 1 script
    ipx::update_checksums {-quiet} {} 1 1 script
    ipx::check_integrity {-quiet} {} 1 1 script
    ipx::save_core {-quiet} {} 1 1 script
} {
    set standin::commands($name) [list $flags $valued $least $most $where]
}
