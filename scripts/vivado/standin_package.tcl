# SPDX-License-Identifier: Apache-2.0
# The stand-in's packaging of IP: interfaces consist of ports that the core has.

namespace eval standin {
    variable bus_kinds {
        xilinx.com:interface:axis_rtl:1.0 xilinx.com:interface:aximm_rtl:1.0 xilinx.com:signal:clock_rtl:1.0
        xilinx.com:signal:reset_rtl:1.0
    }
}

proc standin::do_ipx_package_project {options rest} {
    variable facts
    need_folder [option $options -root_dir]
    variable known
    if {[option $known(fileset|sources_1) top] ne $facts(top)} {
        fail "the top is [option $known(fileset|sources_1) top], not $facts(top)"
    }
    variable read
    foreach file $facts(sources) {
        if {$file ni $read} {
            fail "$file was not read"
        }
    }
    foreach name $facts(ports) {
        add port $name
    }
    add core $facts(top)
}

proc standin::do_ipx_current_core {options rest} {
    variable facts
    return [find core $facts(top) $options]
}

proc standin::do_ipx_infer_bus_interface {options rest} {
    variable bus_kinds
    lassign $rest ports vlnv core
    kind_of $core
    if {$vlnv ni $bus_kinds} {
        fail "there is no interface $vlnv"
    }
    foreach port $ports {
        find port [list $port] {}
    }
    set name [lindex $ports 0]
    if {[string match *:interface:* $vlnv]} {
        set name [join [lrange [split $name _] 0 end-1] _]
    }
    return [add bus $name]
}

proc standin::do_ipx_get_bus_interfaces {options rest} {
    return [lookup bus $options $rest]
}

proc standin::do_ipx_add_bus_parameter {options rest} {
    kind_of [lindex $rest 1]
    return [add parameter [lindex $rest 0]]
}

proc standin::do_ipx_associate_bus_interfaces {options rest} {
    foreach name {-busif -clock -reset} {
        if {[dict exists $options $name]} {
            find bus [list [option $options $name]] {}
        }
    }
}

proc standin::do_ipx_add_memory_map {options rest} {
    kind_of [lindex $rest 1]
    return [add memory_map [lindex $rest 0]]
}

proc standin::do_ipx_get_memory_maps {options rest} {
    return [lookup memory_map $options $rest]
}

proc standin::do_ipx_add_address_block {options rest} {
    kind_of [lindex $rest 1]
    return [add address_block [lindex $rest 0]]
}
