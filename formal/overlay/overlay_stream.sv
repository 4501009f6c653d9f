// SPDX-License-Identifier: Apache-2.0
// overlay: the output keeps the stream rules whatever comes in: any markers, any sizes at any time, any stalls.
`default_nettype none

module overlay_stream #(
    parameter MAX_WIDTH  = 4,
    parameter MAX_HEIGHT = 4
) (
    input wire clk,
    input wire rst,
    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
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

  wire s_axis_tready, m_axis_tvalid, m_axis_tuser, m_axis_tlast, frame_error;
  wire [23:0] m_axis_tdata;

  overlay #(
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT)
  ) dut (
      .*
  );

  power_up start (.*);

  axis_rules #(
      .WIDTH(26)
  ) rules (
      .clk    (clk),
      .rst    (rst),
      .valid  (m_axis_tvalid),
      .ready  (m_axis_tready),
      .payload({m_axis_tuser, m_axis_tlast, m_axis_tdata})
  );

endmodule

`default_nettype wire
