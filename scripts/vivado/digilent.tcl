# SPDX-License-Identifier: Apache-2.0
# HDMI receiver and transmitter from Digilent's vivado-library, for 60 to 120 MHz (1280x720 at 60 Hz).

# Adds the library to the catalog and makes both cells in `folder`.
proc make_digilent {library folder} {
    set_property ip_repo_paths [list $library] [current_project]
    update_ip_catalog -rebuild
    foreach vlnv {digilentinc.com:ip:dvi2rgb:2.0 digilentinc.com:ip:rgb2dvi:1.4} {
        if {[get_ipdefs -quiet $vlnv] eq ""} {
            give_up "$library has no $vlnv; give DIGILENT_IP= a clone of Digilent's vivado-library, see docs/board.md."
        }
    }

    # No global buffer of its own: the clock switch of arty_z7_top is one.
    create_ip -vlnv digilentinc.com:ip:dvi2rgb:2.0 -module_name dvi2rgb_0 -dir $folder
    set_property -dict [list \
        CONFIG.kEmulateDDC {true} \
        CONFIG.kEdidFileName {dgl_720p_cea.data} \
        CONFIG.kRstActiveHigh {true} \
        CONFIG.kAddBUFG {false} \
        CONFIG.kClkRange {2} \
        CONFIG.kDebug {false}] [get_ips dvi2rgb_0]

    create_ip -vlnv digilentinc.com:ip:rgb2dvi:1.4 -module_name rgb2dvi_0 -dir $folder
    set_property -dict [list \
        CONFIG.kGenerateSerialClk {true} \
        CONFIG.kClkPrimitive {MMCM} \
        CONFIG.kRstActiveHigh {true} \
        CONFIG.kClkRange {2}] [get_ips rgb2dvi_0]

    # Synthesised with the rest, not before it.
    foreach name {dvi2rgb_0 rgb2dvi_0} {
        set_property generate_synth_checkpoint false [get_files $name.xci]
        generate_target all [get_files $name.xci]
    }

    # The constraints of the receiver's logic analyser find nothing where kDebug is false.
    foreach file [get_files -quiet -of_objects [get_files dvi2rgb_0.xci] -filter {FILE_TYPE == XDC}] {
        if {[string match -nocase "*ila*" $file]} {
            set_property is_enabled false $file
        }
    }
}
