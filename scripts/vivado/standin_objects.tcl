# SPDX-License-Identifier: Apache-2.0
# Objects of the stand-in are strings kind|name. This finds them by name, and checks what properties they are given.

namespace eval standin {
    variable known
    variable properties
    # Properties of each kind of object that is no IP, and what their values may be ("": anything).
    array set properties {
        project {target_language {Verilog VHDL} ip_repo_paths "" board_part "" default_lib ""}
        fileset {top "" include_dirs "" generic ""}
        design {CFGBVS {VCCO GND} CONFIG_VOLTAGE {1.5 1.8 2.5 3.3} BITSTREAM.GENERAL.COMPRESS {TRUE FALSE}}
        port {
            PACKAGE_PIN "" IOSTANDARD {LVCMOS33 TMDS_33} PULLUP {TRUE FALSE} PULLDOWN {TRUE FALSE} SLEW {SLOW FAST}
            DRIVE {4 8 12 16}
        }
        net {CLOCK_DEDICATED_ROUTE {TRUE FALSE BACKBONE}}
        cell {LOC "" ASYNC_REG {TRUE FALSE} KEEP {TRUE FALSE}}
        file {
            generate_synth_checkpoint {true false} is_enabled {true false} file_type {{Verilog Header} Verilog}
            synth_checkpoint_mode {None Singular Hierarchical} used_in_synthesis {true false}
        }
        bd_port {CONFIG.SENSITIVITY {LEVEL_HIGH EDGE_RISING} CONFIG.ASSOCIATED_BUSIF "" CONFIG.FREQ_HZ ""}
        bd_intf_port {
            CONFIG.PROTOCOL {AXI4 AXI4LITE AXI3} CONFIG.ADDR_WIDTH "" CONFIG.DATA_WIDTH {32 64} CONFIG.ID_WIDTH ""
            CONFIG.READ_WRITE_MODE {READ_WRITE READ_ONLY WRITE_ONLY} CONFIG.HAS_BURST {0 1} CONFIG.HAS_CACHE {0 1}
            CONFIG.HAS_LOCK {0 1} CONFIG.HAS_PROT {0 1} CONFIG.HAS_QOS {0 1} CONFIG.HAS_REGION {0 1}
            CONFIG.MAX_BURST_LENGTH {1 16 256} CONFIG.SUPPORTS_NARROW_BURST {0 1}
        }
        core {
            name "" version "" display_name "" description "" vendor "" library "" supported_families ""
        }
        parameter {value ""}
        bus {slave_memory_map_ref ""}
        address_block {range "" usage {register memory reserved} base_address ""}
    }
}

proc standin::add {kind name} {
    variable known
    set known($kind|$name) {}
    return $kind|$name
}

proc standin::kind_of {object} {
    variable known
    if {![info exists known($object)]} {
        fail "'$object' is no object"
    }
    return [lindex [split $object |] 0]
}

proc standin::name_of {object} {
    return [string range $object [string first | $object]+1 end]
}

# All objects of a kind whose names match one of the patterns; each pattern has to match something.
proc standin::find {kind patterns options} {
    variable known
    set found {}
    foreach pattern $patterns {
        # Brackets in names are bits, not sets of characters.
        set more [array names known [string map {\[ \\\[ \] \\\]} $kind|$pattern]]
        if {[llength $more] == 0 && ![dict exists $options -quiet]} {
            fail "there is no $kind named $pattern"
        }
        lappend found {*}[lsort $more]
    }
    return $found
}

# The pattern in a filter such as {NAME =~ *x*}.
proc standin::filter_of {options} {
    set filter [option $options -filter]
    if {![regexp {^\s*NAME\s*=~\s*(\S+)\s*$} $filter - pattern]} {
        fail "the stand-in knows filters of NAME only, not '$filter'"
    }
    return $pattern
}

proc standin::lookup {kind options rest} {
    if {[dict exists $options -filter]} {
        return [find $kind [list [filter_of $options]] $options]
    }
    return [find $kind [lindex $rest 0] $options]
}

proc standin::do_get_ports {options rest} {
    return [lookup port $options $rest]
}

proc standin::do_get_cells {options rest} {
    return [lookup cell $options $rest]
}

proc standin::do_get_pins {options rest} {
    return [lookup pin $options $rest]
}

proc standin::do_get_nets {options rest} {
    return [lookup net $options $rest]
}

proc standin::do_get_ips {options rest} {
    return [lookup ip $options $rest]
}

proc standin::do_get_files {options rest} {
    if {[dict exists $options -of_objects]} {
        kind_of [option $options -of_objects]
        return {}
    }
    set found {}
    foreach name [lindex $rest 0] {
        set found [concat $found [find file [list *$name] $options]]
    }
    return $found
}

proc standin::do_set_property {options rest} {
    if {[dict exists $options -dict]} {
        set settings [option $options -dict]
        set objects [lindex $rest 0]
    } else {
        if {[llength $rest] != 3} {
            fail "set_property takes a name, a value and objects"
        }
        set settings [lrange $rest 0 1]
        set objects [lindex $rest 2]
    }
    if {[llength $settings] % 2} {
        fail "set_property: a property without a value in {$settings}"
    }
    if {[llength $objects] == 0} {
        fail "set_property has no object to set {$settings} of"
    }
    foreach object $objects {
        foreach {name value} $settings {
            set_one $object $name $value
        }
    }
}

# One property of one object.
proc standin::set_one {object name value} {
    variable known
    variable properties
    set kind [kind_of $object]
    if {$kind in {ip bd_cell}} {
        set allowed [ip_properties $object]
    } elseif {[info exists properties($kind)]} {
        set allowed $properties($kind)
    } else {
        fail "the stand-in knows no property of a $kind"
    }
    if {![dict exists $allowed $name]} {
        fail "$object has no property $name"
    }
    set values [dict get $allowed $name]
    if {[llength $values] && $value ni $values} {
        fail "$name of $object cannot be '$value', only one of: [join $values {, }]"
    }
    dict set known($object) $name $value
    if {$kind eq "port"} {
        check_port $object $name $value
    }
}

proc standin::do_get_property {options rest} {
    variable facts
    lassign $rest name object
    if {$name eq "SLACK"} {
        return $facts([name_of $object])
    }
    variable known
    kind_of $object
    if {![dict exists $known($object) $name]} {
        fail "$object has no $name"
    }
    return [dict get $known($object) $name]
}
