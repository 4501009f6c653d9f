// SPDX-License-Identifier: Apache-2.0
// Binary median 5x5, equal to cv2.medianBlur(5): 1 where at least 13 of the 25
// pixels around are 1.
//
// Latency     2 lines, 2 pixels and 6 cycles; with more pixels a beat, a beat in place of the pixels.
// Throughput  a beat of PPC pixels a cycle; s_axis_tready is 0 for 2 x width / PPC
//             cycles after the last pixel of a frame.
// Borders     replicate.
// Rounding    none; one bit cannot overflow.
// Frames      the contract of docs/design.md.
// Limits      2x1 to MAX_WIDTH x MAX_HEIGHT; with PPC above 1, at least 2 x PPC wide and
//             a multiple of PPC.

`default_nettype none

module median5x5 #(
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

  localparam REPLICATE = 0;

  wire              advance;

  wire              column_valid;
  wire              column_sof;
  wire              column_first;
  wire              column_last;
  wire [ 5*PPC-1:0] column;
  wire [ 3*PPC-1:0] ones_in_column;

  wire              window_valid;
  wire              window_sof;
  wire              window_last;
  wire [15*PPC-1:0] window;
  wire [   PPC-1:0] median;

  reg  [   PPC-1:0] median_reg;
  reg               median_valid_reg;
  reg               median_sof_reg;
  reg               median_last_reg;

  // The column is counted before the horizontal half, which then shifts 3 bits, not 5.
  genvar pixel;
  generate
    for (pixel = 0; pixel < PPC; pixel = pixel + 1) begin : g_pixel
      wire [ 4:0] rows = column[5*pixel+:5];
      wire [14:0] counts = window[15*pixel+:15];
      wire [ 4:0] ones = {2'b0, counts[2:0]} + {2'b0, counts[5:3]} + {2'b0, counts[8:6]} +
          {2'b0, counts[11:9]} + {2'b0, counts[14:12]};

      assign ones_in_column[3*pixel+:3] = {2'b0, rows[0]} + {2'b0, rows[1]} + {2'b0, rows[2]} +
          {2'b0, rows[3]} + {2'b0, rows[4]};
      assign median[pixel] = ones >= 5'd13;
    end
  endgenerate

  window_rows #(
      .TAPS      (5),
      .DATA_WIDTH(1),
      .BORDER    (REPLICATE),
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
      .TAPS      (5),
      .DATA_WIDTH(3),
      .BORDER    (REPLICATE),
      .PPC       (PPC)
  ) cols (
      .clk         (clk),
      .rst         (rst),
      .advance     (advance),
      .column_valid(column_valid),
      .column_sof  (column_sof),
      .column_first(column_first),
      .column_last (column_last),
      .column      (ones_in_column),
      .window_valid(window_valid),
      .window_sof  (window_sof),
      .window_last (window_last),
      .window      (window)
  );

  always @(posedge clk) begin
    if (advance) begin
      median_reg       <= median;
      median_valid_reg <= window_valid;
      median_sof_reg   <= window_sof;
      median_last_reg  <= window_last;
    end

    if (rst) median_valid_reg <= 1'b0;
  end

  axis_skid #(
      .WIDTH(PPC + 2)
  ) output_slice (
      .clk      (clk),
      .rst      (rst),
      .s_payload({median_sof_reg, median_last_reg, median_reg}),
      .s_valid  (median_valid_reg),
      .s_ready  (advance),
      .m_payload({m_axis_tuser, m_axis_tlast, m_axis_tdata}),
      .m_valid  (m_axis_tvalid),
      .m_ready  (m_axis_tready)
  );

endmodule

`default_nettype wire
