# SPDX-License-Identifier: Apache-2.0
# The block design zynq_ps: the processor, and what turns its AXI3 ports into those of the cores. arty_z7_top
# instantiates it; tb/top/vendor/zynq_ps.v is its list of ports, and a test compares the two.

# An AXI interconnect of one clock between what is named, with `masters` outputs.
proc make_interconnect {name masters} {
    create_bd_cell -type ip -vlnv xilinx.com:ip:axi_interconnect:2.1 $name
    set_property -dict [list CONFIG.NUM_SI {1} CONFIG.NUM_MI $masters] [get_bd_cells $name]
    set clocks [list ACLK S00_ACLK]
    set resets [list ARESETN S00_ARESETN]
    for {set index 0} {$index < $masters} {incr index} {
        lappend clocks [format "M%02d_ACLK" $index]
        lappend resets [format "M%02d_ARESETN" $index]
    }
    foreach pin $clocks {
        connect_bd_net [get_bd_pins ps7/FCLK_CLK0] [get_bd_pins $name/$pin]
    }
    foreach pin $resets {
        connect_bd_net [get_bd_pins resets/peripheral_aresetn] [get_bd_pins $name/$pin]
    }
}

# An AXI port of the design. What has the width 0 is left out.
proc make_axi_port {name mode protocol data_bits access} {
    create_bd_intf_port -mode $mode -vlnv xilinx.com:interface:aximm_rtl:1.0 $name
    set lite [expr {$protocol eq "AXI4LITE"}]
    set settings [list \
        CONFIG.PROTOCOL $protocol \
        CONFIG.ADDR_WIDTH {32} \
        CONFIG.DATA_WIDTH $data_bits \
        CONFIG.READ_WRITE_MODE $access \
        CONFIG.HAS_BURST [expr {!$lite}] \
        CONFIG.HAS_CACHE [expr {!$lite}] \
        CONFIG.HAS_LOCK {0} \
        CONFIG.HAS_PROT {1} \
        CONFIG.HAS_QOS {0} \
        CONFIG.HAS_REGION {0}]
    if {$mode eq "Slave"} {
        lappend settings CONFIG.ID_WIDTH {0} CONFIG.MAX_BURST_LENGTH {256} CONFIG.SUPPORTS_NARROW_BURST {0}
    }
    set_property -dict $settings [get_bd_intf_ports $name]
}

# A single signal of the design, joined to a pin of a cell.
proc make_port {name direction pin} {
    create_bd_port -dir $direction $name
    connect_bd_net [get_bd_ports $name] [get_bd_pins $pin]
}

# A port by which the logic reaches memory through one of the processor's fast ports.
proc join_memory {name access hp} {
    make_axi_port $name Slave AXI4 64 $access
    make_interconnect ${name}_join 1
    connect_bd_intf_net [get_bd_intf_ports $name] [get_bd_intf_pins ${name}_join/S00_AXI]
    connect_bd_intf_net [get_bd_intf_pins ${name}_join/M00_AXI] [get_bd_intf_pins ps7/S_AXI_$hp]
    connect_bd_net [get_bd_pins ps7/FCLK_CLK0] [get_bd_pins ps7/S_AXI_${hp}_ACLK]
    assign_bd_address -target_address_space [get_bd_addr_spaces $name] -offset 0x00000000 -range 512M \
        [get_bd_addr_segs ps7/S_AXI_$hp/${hp}_DDR_LOWOCM]
}

# The whole of it, in `folder`; returns its file. `bases` are the addresses of the two sets of registers.
proc make_zynq_ps {folder bases} {
    create_bd_design -dir $folder zynq_ps
    create_bd_cell -type ip -vlnv xilinx.com:ip:processing_system7:5.5 ps7
    set_property -dict [ps7_settings] [get_bd_cells ps7]
    apply_bd_automation -rule xilinx.com:bd_rule:processing_system7 \
        -config {make_external "FIXED_IO, DDR" apply_board_preset "0" Master "Disable" Slave "Disable"} \
        [get_bd_cells ps7]

    create_bd_port -dir O -type clk clk
    connect_bd_net [get_bd_ports clk] [get_bd_pins ps7/FCLK_CLK0]
    create_bd_port -dir O -type clk clk_200
    connect_bd_net [get_bd_ports clk_200] [get_bd_pins ps7/FCLK_CLK1]
    create_bd_port -dir O -type rst reset_n
    connect_bd_net [get_bd_ports reset_n] [get_bd_pins ps7/FCLK_RESET0_N]
    create_bd_port -dir I -from 0 -to 0 -type intr irq
    set_property CONFIG.SENSITIVITY {LEVEL_HIGH} [get_bd_ports irq]
    connect_bd_net [get_bd_ports irq] [get_bd_pins ps7/IRQ_F2P]
    make_port uart0_rxd I ps7/UART0_RX
    make_port uart0_txd O ps7/UART0_TX
    make_port uart1_rxd I ps7/UART1_RX
    make_port uart1_txd O ps7/UART1_TX

    create_bd_cell -type ip -vlnv xilinx.com:ip:proc_sys_reset:5.0 resets
    connect_bd_net [get_bd_pins ps7/FCLK_CLK0] [get_bd_pins resets/slowest_sync_clk]
    connect_bd_net [get_bd_pins ps7/FCLK_RESET0_N] [get_bd_pins resets/ext_reset_in]

    # Registers.
    make_interconnect registers 2
    connect_bd_net [get_bd_pins ps7/FCLK_CLK0] [get_bd_pins ps7/M_AXI_GP0_ACLK]
    connect_bd_intf_net [get_bd_intf_pins ps7/M_AXI_GP0] [get_bd_intf_pins registers/S00_AXI]
    set index 0
    foreach {name base} $bases {
        make_axi_port $name Master AXI4LITE 32 READ_WRITE
        connect_bd_intf_net [get_bd_intf_pins [format "registers/M%02d_AXI" $index]] [get_bd_intf_ports $name]
        assign_bd_address -target_address_space [get_bd_addr_spaces ps7/Data] -offset $base -range 4K \
            [get_bd_addr_segs $name/Reg]
        incr index
    }

    # Memory.
    join_memory s_axi_results WRITE_ONLY HP0
    join_memory s_axi_frames READ_ONLY HP1

    set_property CONFIG.ASSOCIATED_BUSIF {m_axil_landing:m_axil_display:s_axi_results:s_axi_frames} [get_bd_ports clk]
    validate_bd_design
    save_bd_design
    set file [get_files zynq_ps.bd]
    set_property synth_checkpoint_mode None $file
    generate_target all $file
    return $file
}
