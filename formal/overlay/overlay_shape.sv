// SPDX-License-Identifier: Apache-2.0
// overlay: the markers of what leaves are those of frames, whatever comes in.
`default_nettype none

module overlay_shape #(
    parameter WIDTH  = 3,
    parameter HEIGHT = 2
) (
    input wire clk,
    input wire rst,
    input wire cfg_hold,
    input wire cfg_tint,
    input wire cfg_show_text,
    input wire cfg_text_bank,
    input wire cfg_show_pad,
    input wire cfg_show_crosshair,
    input wire [3:0] cfg_show_boxes,
    input wire [223:0] cfg_boxes,
    input wire [13:0] cfg_centre_x,
    input wire [13:0] cfg_centre_y,
    input wire [13:0] cfg_tip_x,
    input wire [13:0] cfg_tip_y,
    input wire text_write,
    input wire [7:0] text_address,
    input wire [6:0] text_char,
    input wire [23:0] s_axis_tdata,
    input wire s_axis_tvalid,
    input wire s_axis_tuser,
    input wire s_axis_tlast,
    input wire m_axis_tready
);

  wire [15:0] cfg_width = WIDTH;
  wire [15:0] cfg_height = HEIGHT;
  wire s_axis_tready, m_axis_tvalid, m_axis_tuser, m_axis_tlast, frame_error;
  wire [23:0] m_axis_tdata;

  overlay #(
      .MAX_WIDTH (WIDTH),
      .MAX_HEIGHT(HEIGHT)
  ) dut (
      .*
  );

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
