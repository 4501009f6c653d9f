// SPDX-License-Identifier: Apache-2.0
// threshold_stats: the output keeps the stream rules whatever comes in: any markers, any sizes at any time, any stalls.
`default_nettype none

module threshold_stats_stream #(
    parameter MAX_WIDTH  = 4,
    parameter MAX_HEIGHT = 4
) (
    input wire clk,
    input wire rst,
    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
    input wire [8:0] cfg_factor,
    input wire [7:0] cfg_flat_limit,
    input wire m_stat_axis_tready,
    input wire [7:0] s_axis_tdata,
    input wire s_axis_tvalid,
    input wire s_axis_tuser,
    input wire s_axis_tlast,
    input wire m_axis_tready
);

  wire s_axis_tready, m_axis_tvalid, m_axis_tuser, m_axis_tlast, frame_error;
  wire [7:0] m_axis_tdata;
  wire m_stat_axis_tvalid, m_stat_axis_tuser, m_stat_axis_tlast;
  wire [31:0] m_stat_axis_tdata;

  threshold_stats #(
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT),
      .WINDOW_LOG2(1)
  ) dut (.*);

  power_up start (.*);

  axis_rules #(
      .WIDTH(10)
  ) rules (
      .clk    (clk),
      .rst    (rst),
      .valid  (m_axis_tvalid),
      .ready  (m_axis_tready),
      .payload({m_axis_tuser, m_axis_tlast, m_axis_tdata})
  );

  axis_rules #(
      .WIDTH(34)
  ) stat_rules (
      .clk    (clk),
      .rst    (rst),
      .valid  (m_stat_axis_tvalid),
      .ready  (m_stat_axis_tready),
      .payload({m_stat_axis_tuser, m_stat_axis_tlast, m_stat_axis_tdata})
  );

endmodule

`default_nettype wire
