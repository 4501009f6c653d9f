# SPDX-License-Identifier: Apache-2.0
# The stand-in's project, sources, synthesis, clocks, reports and outputs.

namespace eval standin {
    variable read {}
    variable constraints {}
    variable made {}
    variable stage none
}

proc standin::need_file {name} {
    if {![file isfile $name]} {
        fail "there is no file $name"
    }
}

proc standin::need_folder {name} {
    if {![file isdirectory $name]} {
        fail "there is no folder $name"
    }
}

# Steps of the flow come in their order.
proc standin::step {from to what} {
    variable stage
    if {$stage ni $from} {
        fail "$what after '$stage', not after [join $from { or }]"
    }
    set stage $to
}

proc standin::do_version {options rest} {
    variable facts
    return $facts(version)
}

proc standin::do_create_project {options rest} {
    if {![dict exists $options -in_memory]} {
        fail "create_project would leave a project on disk; use -in_memory"
    }
    if {[option $options -part] ne "xc7z020clg400-1"} {
        fail "the board's part is xc7z020clg400-1, not [option $options -part]"
    }
    step none project create_project
    add project current
    add fileset sources_1
}

proc standin::do_close_project {options rest} {
    variable stage none
}

proc standin::do_current_project {options rest} {
    return [find project current $options]
}

proc standin::do_current_fileset {options rest} {
    return [find fileset sources_1 $options]
}

proc standin::do_current_design {options rest} {
    return [find design current $options]
}

proc standin::do_read_verilog {options rest} {
    variable read
    foreach file [lindex $rest 0] {
        need_file $file
        if {$file in $read} {
            fail "$file is read twice"
        }
        lappend read $file
        add file $file
    }
}

proc standin::do_read_xdc {options rest} {
    variable constraints
    need_file [lindex $rest 0]
    add file [lindex $rest 0]
    lappend constraints [lindex $rest 0]
}

proc standin::do_synth_design {options rest} {
    variable facts
    variable read
    variable constraints
    variable made
    step project synthesised synth_design
    set top [option $options -top]
    foreach folder [option $options -include_dirs] {
        need_folder $folder
    }
    if {$top ne $facts(top)} {
        fail "there is no module $top to build, only $facts(top)"
    }
    foreach file $facts(sources) {
        if {$file ni $read} {
            fail "$file was not read"
        }
    }
    foreach module $facts(blackboxes) {
        if {$module ni $made} {
            fail "module $module has no source"
        }
    }
    add design current
    variable known
    foreach kind {port cell pin net} {
        foreach name $facts(${kind}s) {
            set known($kind|$name) {}
        }
    }
    # What the IP brings, as far as constraints of ours name it.
    foreach name {zynq_ps/ps7/inst/PS7_i/FCLKCLK[0] zynq_ps/ps7/inst/PS7_i/FCLKCLK[1]} {
        add pin $name
    }
    add clock clk_fpga_0
    add clock clk_fpga_1
    foreach file $constraints {
        constrain $file
    }
    check_ports
}

proc standin::do_opt_design {options rest} {
    step synthesised optimised opt_design
}

proc standin::do_place_design {options rest} {
    step optimised placed place_design
}

proc standin::do_phys_opt_design {options rest} {
    step {placed routed} placed phys_opt_design
}

proc standin::do_route_design {options rest} {
    step placed routed route_design
}

# What is written is a file of the length 0.
proc standin::leave_file {name} {
    need_folder [file dirname $name]
    close [open $name w]
}

proc standin::do_write_checkpoint {options rest} {
    leave_file [lindex $rest 0]
}

proc standin::do_write_bitstream {options rest} {
    step routed done write_bitstream
    leave_file [lindex $rest 0]
}

proc standin::do_write_hw_platform {options rest} {
    step done done write_hw_platform
    leave_file [option $options -file]
}

foreach report {
    report_utilization report_timing_summary check_timing report_cdc report_clock_interaction report_clock_utilization
    report_drc report_methodology report_power
} {
    proc standin::do_$report {options rest} {
        leave_file [option $options -file]
    }
}

proc standin::do_get_timing_paths {options rest} {
    variable facts
    set kind [expr {[dict exists $options -hold] ? "hold" : "setup"}]
    return [expr {$facts($kind) eq "" ? {} : [list path|$kind]}]
}

# ---- Clocks.

proc standin::do_create_clock {options rest} {
    set name [option $options -name]
    if {![string is double -strict [option $options -period]] || [option $options -period] <= 0} {
        fail "clock $name has no period"
    }
    foreach object [lindex $rest 0] {
        kind_of $object
    }
    return [add clock $name]
}

proc standin::do_create_generated_clock {options rest} {
    foreach object [concat [option $options -source] [option $options -master_clock] [lindex $rest 0]] {
        kind_of $object
    }
    return [add clock [option $options -name]]
}

proc standin::do_get_clocks {options rest} {
    if {[dict exists $options -of_objects]} {
        set object [option $options -of_objects]
        kind_of $object
        return [add clock of_[name_of $object]]
    }
    return [lookup clock $options $rest]
}

# Each of these names objects by get_* only.
proc standin::need_objects {objects what} {
    if {[llength $objects] == 0} {
        fail "$what names nothing"
    }
    foreach object $objects {
        kind_of $object
    }
}

proc standin::do_set_clock_groups {options rest} {
    if {![dict exists $options -group] || [llength [dict get $options -group]] < 2} {
        fail "set_clock_groups needs two groups"
    }
    foreach group [dict get $options -group] {
        need_objects $group set_clock_groups
    }
}

proc standin::do_set_input_jitter {options rest} {
    find clock [lindex $rest 0] {}
}

foreach command {set_max_delay set_bus_skew set_false_path} {
    # tclint-disable-next-line command-args
    proc standin::do_$command {options rest} [string map [list NAME $command] {
        if {![dict exists $options -from] && ![dict exists $options -to]} {
            fail "NAME has neither -from nor -to"
        }
        foreach name {-from -to -through} {
            if {[dict exists $options $name]} {
                need_objects [option $options $name] "NAME $name"
            }
        }
        if {[llength $rest] && ![string is double -strict [lindex $rest 0]]} {
            fail "NAME takes nanoseconds, not [lindex $rest 0]"
        }
    }]
}
