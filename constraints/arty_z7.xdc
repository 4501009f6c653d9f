# SPDX-License-Identifier: Apache-2.0
# Pins, clocks and crossings of arty_z7_top on a Digilent Arty Z7-20. docs/board.md lists each crossing with its reason.
# Read before constraints/video_in.xdc, which needs the clocks clk and pix_clk. Not run in Vivado here.

# ---- Pins. The pins of the processor (DDR_*, FIXED_IO_*) come from its block design.

set_property -dict {PACKAGE_PIN N18 IOSTANDARD TMDS_33} [get_ports hdmi_rx_clk_p]
set_property -dict {PACKAGE_PIN P19 IOSTANDARD TMDS_33} [get_ports hdmi_rx_clk_n]
set_property -dict {PACKAGE_PIN V20 IOSTANDARD TMDS_33} [get_ports {hdmi_rx_d_p[0]}]
set_property -dict {PACKAGE_PIN W20 IOSTANDARD TMDS_33} [get_ports {hdmi_rx_d_n[0]}]
set_property -dict {PACKAGE_PIN T20 IOSTANDARD TMDS_33} [get_ports {hdmi_rx_d_p[1]}]
set_property -dict {PACKAGE_PIN U20 IOSTANDARD TMDS_33} [get_ports {hdmi_rx_d_n[1]}]
set_property -dict {PACKAGE_PIN N20 IOSTANDARD TMDS_33} [get_ports {hdmi_rx_d_p[2]}]
set_property -dict {PACKAGE_PIN P20 IOSTANDARD TMDS_33} [get_ports {hdmi_rx_d_n[2]}]
set_property -dict {PACKAGE_PIN T19 IOSTANDARD LVCMOS33} [get_ports hdmi_rx_hpd]
set_property -dict {PACKAGE_PIN U14 IOSTANDARD LVCMOS33} [get_ports hdmi_rx_scl]
set_property -dict {PACKAGE_PIN U15 IOSTANDARD LVCMOS33} [get_ports hdmi_rx_sda]

set_property -dict {PACKAGE_PIN L16 IOSTANDARD TMDS_33} [get_ports hdmi_tx_clk_p]
set_property -dict {PACKAGE_PIN L17 IOSTANDARD TMDS_33} [get_ports hdmi_tx_clk_n]
set_property -dict {PACKAGE_PIN K17 IOSTANDARD TMDS_33} [get_ports {hdmi_tx_d_p[0]}]
set_property -dict {PACKAGE_PIN K18 IOSTANDARD TMDS_33} [get_ports {hdmi_tx_d_n[0]}]
set_property -dict {PACKAGE_PIN K19 IOSTANDARD TMDS_33} [get_ports {hdmi_tx_d_p[1]}]
set_property -dict {PACKAGE_PIN J19 IOSTANDARD TMDS_33} [get_ports {hdmi_tx_d_n[1]}]
set_property -dict {PACKAGE_PIN J18 IOSTANDARD TMDS_33} [get_ports {hdmi_tx_d_p[2]}]
set_property -dict {PACKAGE_PIN H18 IOSTANDARD TMDS_33} [get_ports {hdmi_tx_d_n[2]}]
set_property -dict {PACKAGE_PIN R19 IOSTANDARD LVCMOS33} [get_ports hdmi_tx_hpdn]

# Pmod JA, pins 2 and 3: autopilot. Pmod JB, pins 2 and 3: radio. An input that nobody drives is an idle line.
set_property -dict {PACKAGE_PIN Y19 IOSTANDARD LVCMOS33} [get_ports autopilot_txd]
set_property -dict {PACKAGE_PIN Y16 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports autopilot_rxd]
set_property -dict {PACKAGE_PIN Y14 IOSTANDARD LVCMOS33} [get_ports ground_txd]
set_property -dict {PACKAGE_PIN T11 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports ground_rxd]

# Header IO0: the mode line of the LiDAR, direct. Header IO1: pulls it low through 1 kOhm.
set_property -dict {PACKAGE_PIN T14 IOSTANDARD LVCMOS33} [get_ports lidar_mode]
set_property -dict {PACKAGE_PIN U12 IOSTANDARD LVCMOS33} [get_ports lidar_pull]

set_property -dict {PACKAGE_PIN D19 IOSTANDARD LVCMOS33} [get_ports {btn[0]}]
set_property -dict {PACKAGE_PIN D20 IOSTANDARD LVCMOS33} [get_ports {btn[1]}]
set_property -dict {PACKAGE_PIN L20 IOSTANDARD LVCMOS33} [get_ports {btn[2]}]
set_property -dict {PACKAGE_PIN L19 IOSTANDARD LVCMOS33} [get_ports {btn[3]}]
set_property -dict {PACKAGE_PIN M20 IOSTANDARD LVCMOS33} [get_ports {sw[0]}]
set_property -dict {PACKAGE_PIN M19 IOSTANDARD LVCMOS33} [get_ports {sw[1]}]
set_property -dict {PACKAGE_PIN R14 IOSTANDARD LVCMOS33} [get_ports {led[0]}]
set_property -dict {PACKAGE_PIN P14 IOSTANDARD LVCMOS33} [get_ports {led[1]}]
set_property -dict {PACKAGE_PIN N16 IOSTANDARD LVCMOS33} [get_ports {led[2]}]
set_property -dict {PACKAGE_PIN M14 IOSTANDARD LVCMOS33} [get_ports {led[3]}]

# ---- Clocks.

# 74.25 MHz, 1280x720 at 60 Hz. 1080p would be 6.734 and kClkRange 1 of both HDMI cells; nothing here is made for it.
create_clock -name hdmi_rx_clk -period 13.468 [get_ports hdmi_rx_clk_p]

# FCLK_CLK0 under the name that video_in.xdc wants; takes the place of the block design's own clk_fpga_0 of 10 ns.
create_clock -name clk -period 10.000 [get_pins {zynq_ps/ps7/inst/PS7_i/FCLKCLK[0]}]
set_input_jitter clk 0.300

# The MMCM's own clock, 74.25 MHz of clk, by a name that stays.
create_generated_clock -name local_clk [get_pins local_mmcm/CLKOUT0]

# Behind the switch: the camera's clock is pix_clk, the local one of the same period pix_clk_local.
create_generated_clock -name pix_clk -divide_by 1 -source [get_pins pix_clk_switch/I0] [get_pins pix_clk_switch/O]
create_generated_clock -name pix_clk_local -divide_by 1 -source [get_pins pix_clk_switch/I1] -add \
    -master_clock [get_clocks local_clk] [get_pins pix_clk_switch/O]

# Only one of the two is there at a time, and nothing goes from the one to the other.
set_clock_groups -physically_exclusive -group [get_clocks pix_clk] -group [get_clocks pix_clk_local]
set_clock_groups -asynchronous \
    -group [get_clocks -include_generated_clocks hdmi_rx_clk] \
    -group [get_clocks -include_generated_clocks local_clk]

# 200 MHz of the receiver: a reset from clk and a lock to it, each with its synchroniser; the rest is inside of it.
set_clock_groups -asynchronous -group [get_clocks clk_fpga_1] -group [get_clocks clk]
set_clock_groups -asynchronous \
    -group [get_clocks clk_fpga_1] -group [get_clocks -include_generated_clocks hdmi_rx_clk]

# ---- Crossings. Those of clk and pix_clk are in video_in.xdc; here the same for the other clock of the same wires.

set_max_delay -datapath_only -from [get_clocks clk] -to [get_clocks pix_clk_local] 10.000
set_max_delay -datapath_only -from [get_clocks pix_clk_local] -to [get_clocks clk] 10.000

# The clock switch takes its orders at any time: it waits for the edges of its clocks by itself.
set_false_path -to [get_pins {pix_clk_switch/S0 pix_clk_switch/S1}]
set_false_path -to [get_pins {pix_clk_switch/IGNORE0 pix_clk_switch/IGNORE1}]

# Lock signals may change at any time; the first flip-flop of their synchroniser takes them.
set_false_path -to [get_cells {board/switch/lock_sync/first_reg_reg[*]}]

# The reset of the processor, likewise.
set_false_path -to [get_cells {reset/first_reg_reg reset/second_reg_reg}]

# Transmitter: its reset is asynchronous, and its lock is waited for inside.
set_false_path -from [get_cells board/switch/hold_reg] -to [get_clocks -include_generated_clocks hdmi_rx_clk]
set_false_path -from [get_cells board/switch/hold_reg] -to [get_clocks -include_generated_clocks local_clk]

# Slow or asynchronous pins: serial lines, what a hand moves, what a monitor says, DDC.
set_false_path -from [get_ports {autopilot_rxd ground_rxd btn[*] sw[*] hdmi_tx_hpdn lidar_mode hdmi_rx_scl hdmi_rx_sda}]
set_false_path -to [get_ports {autopilot_txd ground_txd led[*] hdmi_rx_hpd lidar_pull hdmi_rx_scl hdmi_rx_sda}]

# ---- Configuration.

set_property CFGBVS VCCO [current_design]
set_property CONFIG_VOLTAGE 3.3 [current_design]
