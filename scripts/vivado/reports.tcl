# SPDX-License-Identifier: Apache-2.0
# Reports of a routed design, and the judgement of its timing.

proc write_reports {out} {
    report_utilization -hierarchical -file [file join $out utilization.rpt]
    report_timing_summary -report_unconstrained -max_paths 10 -file [file join $out timing.rpt]
    check_timing -verbose -file [file join $out check_timing.rpt]
    report_cdc -details -file [file join $out cdc.rpt]
    report_clock_interaction -file [file join $out clock_interaction.rpt]
    report_clock_utilization -file [file join $out clock_utilization.rpt]
    report_drc -file [file join $out drc.rpt]
    report_methodology -file [file join $out methodology.rpt]
    report_power -file [file join $out power.rpt]
}

# Slack of the worst path of one kind in ns. A design without one has no clocks: that is a fault too.
proc worst_slack {kind} {
    set paths [get_timing_paths -max_paths 1 $kind]
    if {[llength $paths] == 0} {
        give_up "no path is constrained ($kind); constraints/arty_z7.xdc was not read."
    }
    return [get_property SLACK [lindex $paths 0]]
}

proc require_timing {out} {
    set setup [worst_slack -setup]
    set hold [worst_slack -hold]
    if {$setup < 0 || $hold < 0} {
        give_up "timing is not met: worst setup slack $setup ns, worst hold slack $hold ns; see $out/timing.rpt."
    }
    puts "touchdown: worst setup slack $setup ns, worst hold slack $hold ns."
}
