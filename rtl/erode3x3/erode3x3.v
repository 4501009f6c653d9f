// SPDX-License-Identifier: Apache-2.0
// Binary erode 3x3, equal to cv2.erode with a 3x3 box: 1 where all 9 pixels around are 1.
//
// Latency     1 line, 1 pixel and 5 cycles; with more pixels a beat, a beat in place of the pixel.
// Throughput  a beat of PPC pixels a cycle; s_axis_tready is 0 for width / PPC
//             cycles after the last pixel of a frame.
// Borders     pixels outside the frame do not count (they read as 1).
// Rounding    none; one bit cannot overflow.
// Frames      the contract of docs/design.md.
// Limits      2x1 to MAX_WIDTH x MAX_HEIGHT; with PPC above 1, at least 2 x PPC wide and
//             a multiple of PPC.

`default_nettype none

module erode3x3 #(
    parameter PPC        = 1,     // pixels a beat, the leftmost in the low bits
    parameter MAX_WIDTH  = 1280,
    parameter MAX_HEIGHT = 720
) (
    input  wire           clk,
    input  wire           rst,
    input  wire [   15:0] cfg_width,
    input  wire [   15:0] cfg_height,
    input  wire [PPC-1:0] s_axis_tdata,
    input  wire           s_axis_tvalid,
    output wire           s_axis_tready,
    input  wire           s_axis_tuser,
    input  wire           s_axis_tlast,
    output wire [PPC-1:0] m_axis_tdata,
    output wire           m_axis_tvalid,
    input  wire           m_axis_tready,
    output wire           m_axis_tuser,
    output wire           m_axis_tlast,
    output wire           frame_error
);

  morphology3x3 #(
      .DILATE    (0),
      .PPC       (PPC),
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT)
  ) morphology (
      .clk          (clk),
      .rst          (rst),
      .cfg_width    (cfg_width),
      .cfg_height   (cfg_height),
      .s_axis_tdata (s_axis_tdata),
      .s_axis_tvalid(s_axis_tvalid),
      .s_axis_tready(s_axis_tready),
      .s_axis_tuser (s_axis_tuser),
      .s_axis_tlast (s_axis_tlast),
      .m_axis_tdata (m_axis_tdata),
      .m_axis_tvalid(m_axis_tvalid),
      .m_axis_tready(m_axis_tready),
      .m_axis_tuser (m_axis_tuser),
      .m_axis_tlast (m_axis_tlast),
      .frame_error  (frame_error)
  );

endmodule

`default_nettype wire
