# SPDX-License-Identifier: Apache-2.0
# A stand-in for Vivado: tclsh standin.tcl <facts.tcl> <script> [arguments of the script]
# Runs a script against commands that check their options and the names that they are given, and do nothing else. What
# the RTL has, and which faults of Vivado to play, is in the facts, which scripts/vivado_standin.py writes. What was
# called is printed, a line a call. The first fault ends the run with its sentence and exit code 1; a `catch` in the
# script does not hide it.

namespace eval standin {
    variable folder [file dirname [file normalize [info script]]]
    variable facts
    variable fault ""
    array set facts {version 2023.2 modules {} cells {} nets {} setup 0.1 hold 0.05 no_ip {}}
}

# Ends the run.
proc standin::fail {sentence} {
    variable fault
    if {$fault eq ""} {
        set fault $sentence
    }
    return -code error -errorcode STANDIN $sentence
}

# Options and other arguments of a call, as a dict and a list, after a check of both against the table.
proc standin::parse {name arguments} {
    variable commands
    lassign $commands($name) flags valued least most
    set options {}
    set rest {}
    for {set index 0} {$index < [llength $arguments]} {incr index} {
        set word [lindex $arguments $index]
        if {![regexp {^-[A-Za-z_]+$} $word]} {
            lappend rest $word
        } elseif {$word in $flags} {
            dict set options $word 1
        } elseif {$word in $valued} {
            incr index
            if {$index >= [llength $arguments]} {
                fail "$name: $word has no value"
            }
            dict lappend options $word [lindex $arguments $index]
        } else {
            fail "$name has no option $word"
        }
    }
    if {[llength $rest] < $least || ($most >= 0 && [llength $rest] > $most)} {
        fail "$name takes $least to $most arguments, not [llength $rest]"
    }
    return [list $options $rest]
}

# The value of an option, or what counts without it.
proc standin::option {options name {otherwise ""}} {
    return [expr {[dict exists $options $name] ? [lindex [dict get $options $name] end] : $otherwise}]
}

# One call of a command of Vivado.
proc standin::call {name args} {
    puts "$name $args"
    lassign [parse $name $args] options rest
    set handler do_[string map {:: _} $name]
    if {[info procs ::standin::$handler] eq ""} {
        return ""
    }
    return [$handler $options $rest]
}

# An interpreter with the commands of `names`. Of Tcl's own a script has all, constraints have few.
proc standin::make {interpreter names constraints} {
    interp create $interpreter
    if {$constraints} {
        foreach name [interp eval $interpreter {info commands}] {
            if {$name ni {set list expr unknown}} {
                interp hide $interpreter $name
            }
        }
    }
    foreach name $names {
        interp alias $interpreter $name {} standin::call $name
    }
    interp alias $interpreter unknown {} standin::unknown
    if {!$constraints} {
        interp alias $interpreter exit {} standin::leave
    }
}

proc standin::unknown {name args} {
    fail "there is no command $name"
}

proc standin::leave {{code 0}} {
    return -code error -errorcode [list LEAVE $code] "exit $code"
}

# Constraints, in an interpreter that has their commands only.
proc standin::constrain {file} {
    variable commands
    set names {}
    foreach name [array names commands] {
        if {[lindex $commands($name) 4] eq "xdc"} {
            lappend names $name
        }
    }
    make constraints $names 1
    set channel [open $file]
    set text [read $channel]
    close $channel
    try {
        # tclint-disable-next-line command-args
        interp eval constraints $text
    } on error {sentence} {
        fail "[file tail $file]: $sentence"
    } finally {
        interp delete constraints
    }
}

foreach part {commands objects design block package board} {
    source [file join $standin::folder standin_$part.tcl]
}

proc standin::main {facts_file script arguments} {
    variable facts
    variable commands
    variable fault
    source $facts_file
    make vivado [array names commands] 0
    # tclint-disable-next-line command-args
    interp eval vivado [list set argv $arguments]
    set code 0
    try {
        # tclint-disable-next-line command-args
        interp eval vivado [list source $script]
    } trap LEAVE {- details} {
        set code [lindex [dict get $details -errorcode] 1]
    } on error {sentence} {
        if {$fault eq ""} {
            set fault $sentence
        }
    }
    if {$fault ne ""} {
        puts stderr "standin: $fault"
        exit 1
    }
    exit $code
}
standin::main [lindex $argv 0] [lindex $argv 1] [lrange $argv 2 end]
