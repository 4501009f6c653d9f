# SPDX-License-Identifier: Apache-2.0
# IP that the stand-in knows: properties with the values they may have ("": any), pins, interfaces. A pin or an
# interface that is there for some settings only stands with the property and the value that it needs. `must` has to
# be connected.

namespace eval standin {
    variable ip
    set ip(digilentinc.com:ip:dvi2rgb:2.0) {
        properties {
            CONFIG.kEmulateDDC {true false} CONFIG.kRstActiveHigh {true false} CONFIG.kAddBUFG {true false}
            CONFIG.kClkRange {1 2 3 4 5} CONFIG.kDebug {true false} CONFIG.kEnableSerialClkOutput {true false}
            CONFIG.kEdidFileName {
                dgl_720p_cea.data dgl_1080p_cea.data 720p_edid.txt 800_600_edid.data 900p_edid.data 1280_720_edid.txt
            }
        }
    }
    set ip(digilentinc.com:ip:rgb2dvi:1.4) {
        properties {
            CONFIG.kGenerateSerialClk {true false} CONFIG.kClkPrimitive {MMCM PLL} CONFIG.kRstActiveHigh {true false}
            CONFIG.kClkRange {1 2 3 4 5} CONFIG.kD0Swap {true false} CONFIG.kD1Swap {true false}
            CONFIG.kD2Swap {true false} CONFIG.kClkSwap {true false}
        }
    }
    set ip(xilinx.com:ip:axi_interconnect:2.1) {
        properties {CONFIG.NUM_SI {1} CONFIG.NUM_MI {1 2} CONFIG.STRATEGY {0 1 2}}
        pins {ACLK ARESETN S00_ACLK S00_ARESETN M00_ACLK M00_ARESETN}
        pins_if {M01_ACLK {CONFIG.NUM_MI 2} M01_ARESETN {CONFIG.NUM_MI 2}}
        interfaces {S00_AXI M00_AXI}
        interfaces_if {M01_AXI {CONFIG.NUM_MI 2}}
        must {
            ACLK ARESETN S00_ACLK S00_ARESETN M00_ACLK M00_ARESETN M01_ACLK M01_ARESETN S00_AXI M00_AXI M01_AXI
        }
    }
    set ip(xilinx.com:ip:proc_sys_reset:5.0) {
        properties {CONFIG.C_EXT_RST_WIDTH ""}
        pins {
            slowest_sync_clk ext_reset_in aux_reset_in mb_debug_sys_rst dcm_locked mb_reset bus_struct_reset
            peripheral_reset interconnect_aresetn peripheral_aresetn
        }
        must {slowest_sync_clk ext_reset_in}
    }
    set ip(xilinx.com:ip:processing_system7:5.5) {
        properties {
            CONFIG.PCW_CRYSTAL_PERIPHERAL_FREQMHZ "" CONFIG.PCW_APU_PERIPHERAL_FREQMHZ ""
            CONFIG.PCW_PRESET_BANK0_VOLTAGE {{LVCMOS 3.3V} {LVCMOS 2.5V} {LVCMOS 1.8V}}
            CONFIG.PCW_PRESET_BANK1_VOLTAGE {{LVCMOS 3.3V} {LVCMOS 2.5V} {LVCMOS 1.8V}}
            CONFIG.PCW_UIPARAM_DDR_MEMORY_TYPE {{DDR 3} {DDR 3 (Low Voltage)} {LPDDR 2} {DDR 2}}
            CONFIG.PCW_UIPARAM_DDR_PARTNO {{MT41J256M16 RE-125} {MT41K256M16 RE-125} Custom}
            CONFIG.PCW_UIPARAM_DDR_BUS_WIDTH {{16 Bit} {32 Bit}} CONFIG.PCW_UIPARAM_DDR_FREQ_MHZ ""
            CONFIG.PCW_UIPARAM_DDR_DQS_TO_CLK_DELAY_0 "" CONFIG.PCW_UIPARAM_DDR_DQS_TO_CLK_DELAY_1 ""
            CONFIG.PCW_UIPARAM_DDR_BOARD_DELAY0 "" CONFIG.PCW_UIPARAM_DDR_BOARD_DELAY1 ""
            CONFIG.PCW_UIPARAM_DDR_TRAIN_WRITE_LEVEL {0 1} CONFIG.PCW_UIPARAM_DDR_TRAIN_READ_GATE {0 1}
            CONFIG.PCW_UIPARAM_DDR_TRAIN_DATA_EYE {0 1}
            CONFIG.PCW_QSPI_PERIPHERAL_ENABLE {0 1} CONFIG.PCW_QSPI_GRP_SINGLE_SS_ENABLE {0 1}
            CONFIG.PCW_QSPI_GRP_FBCLK_ENABLE {0 1} CONFIG.PCW_SD0_PERIPHERAL_ENABLE {0 1}
            CONFIG.PCW_SD0_SD0_IO {{MIO 40 .. 45} {MIO 28 .. 33} {MIO 16 .. 21} EMIO} CONFIG.PCW_SD0_GRP_CD_ENABLE {0 1}
            CONFIG.PCW_SD0_GRP_CD_IO "" CONFIG.PCW_SDIO_PERIPHERAL_FREQMHZ "" CONFIG.PCW_UART_PERIPHERAL_FREQMHZ ""
            CONFIG.PCW_UART0_PERIPHERAL_ENABLE {0 1} CONFIG.PCW_UART0_UART0_IO {EMIO {MIO 14 .. 15}}
            CONFIG.PCW_UART1_PERIPHERAL_ENABLE {0 1} CONFIG.PCW_UART1_UART1_IO {EMIO {MIO 48 .. 49}}
            CONFIG.PCW_FPGA0_PERIPHERAL_FREQMHZ "" CONFIG.PCW_FPGA1_PERIPHERAL_FREQMHZ ""
            CONFIG.PCW_EN_CLK0_PORT {0 1} CONFIG.PCW_EN_CLK1_PORT {0 1} CONFIG.PCW_EN_RST0_PORT {0 1}
            CONFIG.PCW_FCLK_CLK0_BUF {TRUE FALSE} CONFIG.PCW_FCLK_CLK1_BUF {TRUE FALSE}
            CONFIG.PCW_USE_M_AXI_GP0 {0 1} CONFIG.PCW_USE_S_AXI_HP0 {0 1} CONFIG.PCW_USE_S_AXI_HP1 {0 1}
            CONFIG.PCW_S_AXI_HP0_DATA_WIDTH {32 64} CONFIG.PCW_S_AXI_HP1_DATA_WIDTH {32 64}
            CONFIG.PCW_USE_FABRIC_INTERRUPT {0 1} CONFIG.PCW_IRQ_F2P_INTR {0 1}
        }
        pins_if {
            FCLK_CLK0 {CONFIG.PCW_EN_CLK0_PORT 1} FCLK_CLK1 {CONFIG.PCW_EN_CLK1_PORT 1}
            FCLK_RESET0_N {CONFIG.PCW_EN_RST0_PORT 1} M_AXI_GP0_ACLK {CONFIG.PCW_USE_M_AXI_GP0 1}
            S_AXI_HP0_ACLK {CONFIG.PCW_USE_S_AXI_HP0 1} S_AXI_HP1_ACLK {CONFIG.PCW_USE_S_AXI_HP1 1}
            IRQ_F2P {CONFIG.PCW_IRQ_F2P_INTR 1}
            UART0_RX {CONFIG.PCW_UART0_UART0_IO EMIO} UART0_TX {CONFIG.PCW_UART0_UART0_IO EMIO}
            UART1_RX {CONFIG.PCW_UART1_UART1_IO EMIO} UART1_TX {CONFIG.PCW_UART1_UART1_IO EMIO}
        }
        interfaces {DDR FIXED_IO}
        interfaces_if {
            M_AXI_GP0 {CONFIG.PCW_USE_M_AXI_GP0 1} S_AXI_HP0 {CONFIG.PCW_USE_S_AXI_HP0 1}
            S_AXI_HP1 {CONFIG.PCW_USE_S_AXI_HP1 1}
        }
        must {
            FCLK_CLK0 FCLK_CLK1 M_AXI_GP0_ACLK S_AXI_HP0_ACLK S_AXI_HP1_ACLK IRQ_F2P UART0_RX UART1_RX
            M_AXI_GP0 S_AXI_HP0 S_AXI_HP1 DDR FIXED_IO
        }
    }
}
