# SPDX-License-Identifier: Apache-2.0
# IP and block design of the stand-in: cells with the pins that their settings give them, nets, addresses. In the end it
# prints each port of the design, as Verilog has it: what arty_z7_top instantiates is compared with that.

namespace eval standin {
    variable vlnv_of
    variable joined
    variable ranges {}
    variable design ""
    array set vlnv_of {}
    array set joined {}
    variable axi_write {
        awaddr awlen awsize awburst awcache awprot awvalid awready wdata wstrb wlast wvalid wready bresp bvalid bready
    }
    variable axi_read {araddr arlen arsize arburst arcache arprot arvalid arready rdata rresp rlast rvalid rready}
}
source [file join $standin::folder standin_ip.tcl]

proc standin::do_get_ipdefs {options rest} {
    variable ip
    variable facts
    set found {}
    foreach vlnv $rest {
        if {[info exists ip($vlnv)] && $vlnv ni $facts(no_ip)} {
            lappend found $vlnv
        }
    }
    return $found
}

proc standin::need_ip {vlnv} {
    variable ip
    if {![info exists ip($vlnv)]} {
        fail "the catalog has no $vlnv"
    }
}

proc standin::do_create_ip {options rest} {
    variable vlnv_of
    set name [option $options -module_name]
    need_ip [option $options -vlnv]
    need_folder [option $options -dir]
    add file [file join [option $options -dir] $name $name.xci]
    set object [add ip $name]
    set vlnv_of($object) [option $options -vlnv]
    return $object
}

proc standin::do_generate_target {options rest} {
    variable made
    foreach object [lindex $rest 1] {
        kind_of $object
        lappend made [file rootname [file tail [name_of $object]]]
    }
}

proc standin::ip_of {object} {
    variable ip
    variable vlnv_of
    return $ip($vlnv_of($object))
}

proc standin::ip_properties {object} {
    return [dict get [ip_of $object] properties]
}

# Names of one kind that a cell has with its settings.
proc standin::parts {object kind} {
    variable known
    set description [ip_of $object]
    set found [option_list $description $kind]
    foreach {name condition} [option_list $description ${kind}_if] {
        lassign $condition property value
        if {[dict exists $known($object) $property] && [dict get $known($object) $property] eq $value} {
            lappend found $name
        }
    }
    return $found
}

proc standin::option_list {description name} {
    return [expr {[dict exists $description $name] ? [dict get $description $name] : {}}]
}

# ---- Design, cells, ports.

proc standin::do_create_bd_design {options rest} {
    variable design
    need_folder [option $options -dir]
    set design [lindex $rest 0]
    add file [file join [option $options -dir] $design $design.bd]
}

proc standin::new {kind name} {
    variable known
    variable design
    if {$design eq ""} {
        fail "there is no block design for $name"
    }
    if {[info exists known($kind|$name)]} {
        fail "there are two of $name"
    }
    return [add $kind $name]
}

proc standin::do_create_bd_cell {options rest} {
    variable vlnv_of
    need_ip [option $options -vlnv]
    if {[option $options -type] ne "ip"} {
        fail "create_bd_cell: -type is [option $options -type], not ip"
    }
    set object [new bd_cell [lindex $rest 0]]
    set vlnv_of($object) [option $options -vlnv]
    return $object
}

proc standin::do_create_bd_port {options rest} {
    variable known
    set object [new bd_port [lindex $rest 0]]
    if {[option $options -dir] ni {I O IO}} {
        fail "create_bd_port: -dir is [option $options -dir], not I, O or IO"
    }
    if {[option $options -type data] ni {clk rst data intr}} {
        fail "create_bd_port: -type is [option $options -type]"
    }
    dict set known($object) dir [option $options -dir]
    dict set known($object) width [expr {[option $options -from 0] - [option $options -to 0] + 1}]
    return $object
}

proc standin::do_create_bd_intf_port {options rest} {
    variable known
    if {[option $options -vlnv] ne "xilinx.com:interface:aximm_rtl:1.0"} {
        fail "there is no interface [option $options -vlnv]"
    }
    if {[option $options -mode] ni {Master Slave}} {
        fail "create_bd_intf_port: -mode is [option $options -mode]"
    }
    set object [new bd_intf_port [lindex $rest 0]]
    dict set known($object) mode [option $options -mode]
    return $object
}

proc standin::do_apply_bd_automation {options rest} {
    variable joined
    if {[option $options -rule] ne "xilinx.com:bd_rule:processing_system7"} {
        fail "there is no rule [option $options -rule]"
    }
    set cell [name_of [lindex $rest 0]]
    kind_of [lindex $rest 0]
    foreach name [split [string map {" " ""} [dict get [option $options -config] make_external]] ,] {
        if {$name ni [parts [lindex $rest 0] interfaces]} {
            fail "$cell has no interface $name"
        }
        set joined(bd_intf_pin|$cell/$name) external
    }
}

# ---- Names.

foreach kind {cell port intf_port} {
    # tclint-disable-next-line command-args
    proc standin::do_get_bd_${kind}s {options rest} [string map [list KIND $kind] {
        return [lookup bd_KIND $options $rest]
    }]
}

proc standin::cell_part {name kind what} {
    variable known
    lassign [split $name /] cell part
    if {![info exists known(bd_cell|$cell)]} {
        fail "the design has no cell $cell"
    }
    if {$part ni [parts bd_cell|$cell $kind]} {
        fail "$cell has no $what $part with its settings"
    }
}

proc standin::do_get_bd_pins {options rest} {
    cell_part [lindex $rest 0] pins pin
    return [add bd_pin [lindex $rest 0]]
}

proc standin::do_get_bd_intf_pins {options rest} {
    cell_part [lindex $rest 0] interfaces interface
    return [add bd_intf_pin [lindex $rest 0]]
}

proc standin::connect {objects kinds} {
    variable joined
    foreach object $objects {
        if {[kind_of $object] ni $kinds} {
            fail "$object cannot be joined to that"
        }
        set joined($object) 1
    }
}

proc standin::do_connect_bd_net {options rest} {
    connect $rest {bd_pin bd_port}
}

proc standin::do_connect_bd_intf_net {options rest} {
    connect $rest {bd_intf_pin bd_intf_port}
}

# ---- Addresses.

proc standin::do_get_bd_addr_spaces {options rest} {
    variable known
    set name [lindex $rest 0]
    if {$name ne "ps7/Data" && ![info exists known(bd_intf_port|$name)]} {
        fail "there is no address space $name"
    }
    return [add space $name]
}

proc standin::do_get_bd_addr_segs {options rest} {
    variable known
    set name [lindex $rest 0]
    lassign [split $name /] first second third
    if {[info exists known(bd_intf_port|$first)] && $second eq "Reg" && $third eq ""} {
        return [add segment $name]
    }
    if {$second in [parts bd_cell|$first interfaces] && $third eq "[lindex [split $second _] end]_DDR_LOWOCM"} {
        return [add segment $name]
    }
    fail "there is no address segment $name"
}

proc standin::bytes {text} {
    if {[regexp {^(\d+)([KMG])$} $text - number unit]} {
        return [expr {$number * [dict get {K 1024 M 1048576 G 1073741824} $unit]}]
    }
    return [expr {$text}]
}

proc standin::do_assign_bd_address {options rest} {
    variable ranges
    set space [option $options -target_address_space]
    kind_of $space
    kind_of [lindex $rest 0]
    set first [bytes [option $options -offset]]
    set last [expr {$first + [bytes [option $options -range]] - 1}]
    foreach {other from to} $ranges {
        if {$other eq $space && $first <= $to && $from <= $last} {
            fail "[name_of [lindex $rest 0]] overlaps another range at [format 0x%08X $first]"
        }
    }
    lappend ranges $space $first $last
    puts [format "address %s 0x%08X 0x%08X" [name_of [lindex $rest 0]] $first $last]
}

# ---- The whole.

proc standin::do_validate_bd_design {options rest} {
    variable known
    variable joined
    foreach object [lsort [array names known bd_cell|*]] {
        set cell [name_of $object]
        foreach {kind prefix} {pins bd_pin interfaces bd_intf_pin} {
            foreach name [parts $object $kind] {
                if {$name in [option_list [ip_of $object] must] && ![info exists joined($prefix|$cell/$name)]} {
                    fail "$cell/$name is not connected"
                }
            }
        }
    }
    foreach object [lsort [concat [array names known bd_port|*] [array names known bd_intf_port|*]]] {
        if {![info exists joined($object)]} {
            fail "port [name_of $object] is not connected"
        }
    }
    print_ports
}

proc standin::print_ports {} {
    variable known
    variable axi_write
    variable axi_read
    foreach object [lsort [array names known bd_port|*]] {
        puts "port [name_of $object] [dict get $known($object) dir] [dict get $known($object) width]"
    }
    foreach object [lsort [array names known bd_intf_port|*]] {
        set settings $known($object)
        set access [dict get $settings CONFIG.READ_WRITE_MODE]
        set lite [expr {[dict get $settings CONFIG.PROTOCOL] eq "AXI4LITE"}]
        set names {}
        if {$access ne "READ_ONLY"} {
            lappend names {*}$axi_write
        }
        if {$access ne "WRITE_ONLY"} {
            lappend names {*}$axi_read
        }
        foreach name $names {
            if {$lite && [regexp {len$|size$|burst$|cache$|last$} $name]} {
                continue
            }
            print_port [name_of $object] $settings $name
        }
    }
}

proc standin::print_port {interface settings name} {
    set data [dict get $settings CONFIG.DATA_WIDTH]
    set widths [list addr [dict get $settings CONFIG.ADDR_WIDTH] len 8 size 3 burst 2 cache 4 prot 3 data $data \
        strb [expr {$data / 8}] resp 2]
    set part [regsub {^(aw|ar|w|r|b)} $name ""]
    set width [expr {[dict exists $widths $part] ? [dict get $widths $part] : 1}]
    # Seen from a master; valid goes with its payload, ready against it.
    set out [expr {[string match aw* $name] || [string match ar* $name] || [string match w* $name]}]
    if {$part eq "ready"} {
        set out [expr {!$out}]
    }
    if {[dict get $settings mode] eq "Slave"} {
        set out [expr {!$out}]
    }
    puts "port ${interface}_$name [expr {$out ? "O" : "I"}] $width"
}
