# SPDX-License-Identifier: Apache-2.0
# Clock crossings of landing_core, for Vivado; docs/cores/video_in.md says what crosses and how. Not run in Vivado here.
# The clocks are named clk and pix_clk.

# Gray code and words that stand still: their bits may not arrive further apart than the shorter period, 10 ns of clk.
set_max_delay -datapath_only -from [get_clocks clk] -to [get_clocks pix_clk] 10.000
set_max_delay -datapath_only -from [get_clocks pix_clk] -to [get_clocks clk] 10.000

# The pin of the LiDAR is asynchronous: the first of the two flip-flops in lidar_pwm may take it at any time.
set_false_path -to [get_cells -hierarchical -filter {NAME =~ *lidar*/sync_reg_reg[0]}]
