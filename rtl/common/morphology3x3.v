// SPDX-License-Identifier: Apache-2.0
// Binary erosion (DILATE 0: 1 where all 9 pixels around are 1) or dilation
// (DILATE 1: 1 where any of them is) with a 3x3 box. erode3x3 and dilate3x3 are this
// module with one value each; latency, throughput and limits stand in their headers.

`default_nettype none

module morphology3x3 #(
    parameter DILATE     = 0,
    parameter PPC        = 1,
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

  localparam CONSTANT = 2;
  // Pixels outside the frame must not decide the result.
  localparam [0:0] OUTSIDE = (DILATE == 0);

  wire             advance;

  wire             column_valid;
  wire             column_sof;
  wire             column_first;
  wire             column_last;
  wire [3*PPC-1:0] column;
  wire [  PPC-1:0] reduced_column;

  wire             window_valid;
  wire             window_sof;
  wire             window_last;
  wire [3*PPC-1:0] window;
  wire [  PPC-1:0] result;

  // The column is reduced before the horizontal half, which then shifts 1 bit, not 3.
  genvar pixel;
  generate
    if (DILATE != 0 && DILATE != 1) begin : g_parameter
      ERROR_dilate_must_be_0_or_1 error_instance ();
    end
    for (pixel = 0; pixel < PPC; pixel = pixel + 1) begin : g_pixel
      if (DILATE == 0) begin : g_erode
        assign reduced_column[pixel] = column[3*pixel+:3] == 3'b111;
        assign result[pixel] = window[3*pixel+:3] == 3'b111;
      end else begin : g_dilate
        assign reduced_column[pixel] = column[3*pixel+:3] != 3'b000;
        assign result[pixel] = window[3*pixel+:3] != 3'b000;
      end
    end
  endgenerate

  window_rows #(
      .TAPS      (3),
      .DATA_WIDTH(1),
      .BORDER    (CONSTANT),
      .VALUE     (OUTSIDE),
      .PPC       (PPC),
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT)
  ) rows (
      .clk          (clk),
      .rst          (rst),
      .cfg_width    (cfg_width),
      .cfg_height   (cfg_height),
      .s_axis_tdata (s_axis_tdata),
      .s_axis_tvalid(s_axis_tvalid),
      .s_axis_tready(s_axis_tready),
      .s_axis_tuser (s_axis_tuser),
      .s_axis_tlast (s_axis_tlast),
      .advance      (advance),
      .column_valid (column_valid),
      .column_sof   (column_sof),
      .column_first (column_first),
      .column_last  (column_last),
      .column       (column),
      .frame_error  (frame_error)
  );

  window_cols #(
      .TAPS      (3),
      .DATA_WIDTH(1),
      .BORDER    (CONSTANT),
      .VALUE     (OUTSIDE),
      .PPC       (PPC)
  ) cols (
      .clk         (clk),
      .rst         (rst),
      .advance     (advance),
      .column_valid(column_valid),
      .column_sof  (column_sof),
      .column_first(column_first),
      .column_last (column_last),
      .column      (reduced_column),
      .window_valid(window_valid),
      .window_sof  (window_sof),
      .window_last (window_last),
      .window      (window)
  );

  axis_skid #(
      .WIDTH(PPC + 2)
  ) output_slice (
      .clk      (clk),
      .rst      (rst),
      .s_payload({window_sof, window_last, result}),
      .s_valid  (window_valid),
      .s_ready  (advance),
      .m_payload({m_axis_tuser, m_axis_tlast, m_axis_tdata}),
      .m_valid  (m_axis_tvalid),
      .m_ready  (m_axis_tready)
  );

endmodule

`default_nettype wire
