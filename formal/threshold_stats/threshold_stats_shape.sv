// SPDX-License-Identifier: Apache-2.0
// threshold_stats: the markers of what leaves are those of frames, whatever comes in.
`default_nettype none

module threshold_stats_shape #(
    parameter WIDTH  = 3,
    parameter HEIGHT = 2
) (
    input wire clk,
    input wire rst,
    input wire [8:0] cfg_factor,
    input wire [7:0] cfg_flat_limit,
    input wire m_stat_axis_tready,
    input wire [7:0] s_axis_tdata,
    input wire s_axis_tvalid,
    input wire s_axis_tuser,
    input wire s_axis_tlast,
    input wire m_axis_tready
);

  wire [15:0] cfg_width = WIDTH;
  wire [15:0] cfg_height = HEIGHT;
  wire s_axis_tready, m_axis_tvalid, m_axis_tuser, m_axis_tlast, frame_error;
  wire [7:0] m_axis_tdata;
  wire m_stat_axis_tvalid, m_stat_axis_tuser, m_stat_axis_tlast;
  wire [31:0] m_stat_axis_tdata;

  threshold_stats #(
      .MAX_WIDTH (WIDTH),
      .MAX_HEIGHT(HEIGHT),
      .WINDOW_LOG2(1)
  ) dut (.*);

  power_up start (.*);

  video_rules rules (
      .clk       (clk),
      .rst       (rst),
      .cfg_width (cfg_width),
      .cfg_height(cfg_height),
      .s_valid   (s_axis_tvalid),
      .s_ready   (s_axis_tready),
      .s_user    (s_axis_tuser),
      .m_valid   (m_axis_tvalid),
      .m_ready   (m_axis_tready),
      .m_user    (m_axis_tuser),
      .m_last    (m_axis_tlast)
  );

endmodule

`default_nettype wire
