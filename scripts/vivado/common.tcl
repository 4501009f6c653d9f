# SPDX-License-Identifier: Apache-2.0
# What all Vivado scripts share. The caller has set `wanted_version`.

# Stops the run with one sentence.
proc give_up {sentence} {
    puts stderr "touchdown: $sentence"
    exit 1
}

# Only the version that the scripts are written for: others name IP and options differently.
proc check_version {wanted} {
    set found [version -short]
    if {![string match "${wanted}*" $found]} {
        give_up "this is Vivado $found and the scripts are for $wanted; put the bin folder of $wanted first on PATH."
    }
}
