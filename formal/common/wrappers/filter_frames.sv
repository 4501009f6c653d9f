// SPDX-License-Identifier: Apache-2.0
// A filter of binary pixels (`CORE`): 1 where at least LEAST pixels of the square around are 1, in every picture of a
// small frame, with every stall on both sides, frame after frame. REACH and RULE as in binary_window.
`default_nettype none

module filter_frames #(
    parameter REACH  = 1,
    parameter RULE   = 0,
    parameter LEAST  = 1,
    parameter WIDTH  = 3,
    parameter HEIGHT = 2
) (
    input wire clk,
    input wire rst,
    input wire s_axis_tdata,
    input wire s_axis_tvalid,
    input wire s_axis_tuser,
    input wire s_axis_tlast,
    input wire m_axis_tready
);

  wire [15:0] cfg_width = WIDTH;
  wire [15:0] cfg_height = HEIGHT;
  wire s_axis_tready, m_axis_tvalid, m_axis_tuser, m_axis_tlast, m_axis_tdata, frame_error;

  `CORE #(
      .MAX_WIDTH (WIDTH),
      .MAX_HEIGHT(HEIGHT)
  ) dut (.*);

  power_up start (.*);

  wire [31:0] pixels;
  wire [1:0] column, line;
  wire frame, past;
  wire [4:0] ones;

  whole_frames frames (
      .clk       (clk),
      .rst       (rst),
      .cfg_width (cfg_width),
      .cfg_height(cfg_height),
      .s_data    (s_axis_tdata),
      .s_valid   (s_axis_tvalid),
      .s_ready   (s_axis_tready),
      .s_user    (s_axis_tuser),
      .s_last    (s_axis_tlast),
      .m_valid   (m_axis_tvalid),
      .m_ready   (m_axis_tready),
      .m_user    (m_axis_tuser),
      .m_last    (m_axis_tlast),
      .pixels    (pixels),
      .column    (column),
      .line      (line),
      .frame     (frame),
      .past      (past)
  );

  binary_window #(
      .REACH(REACH),
      .RULE (RULE)
  ) window (.*);

  always @(posedge clk)
    if (past && !rst) begin
      if (m_axis_tvalid) assert (m_axis_tdata == (ones >= LEAST));
      assert (!frame_error);
    end

endmodule

`default_nettype wire
