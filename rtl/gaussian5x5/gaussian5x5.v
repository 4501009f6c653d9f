// SPDX-License-Identifier: Apache-2.0
// Gaussian blur 5x5, bit-exact to cv2.GaussianBlur((5, 5), 0.65) on 8-bit pictures.
//
//   out = (sum over i, j of k[i] k[j] p[i][j] + 32768) >> 16,  k = 1, 48, 158, 48, 1
//
// Latency     2 lines, 2 pixels and 14 cycles; with more pixels a beat, a beat in place of the pixels.
// Throughput  a beat of PPC pixels a cycle; s_axis_tready is 0 for 2 x width / PPC
//             cycles after the last pixel of a frame.
// Borders     reflect_101 (the default of cv2).
// Rounding    half up, once, at the end. The weights sum to 2^16: no overflow.
// Frames      the contract of docs/design.md.
// Limits      3x3 to MAX_WIDTH x MAX_HEIGHT; with PPC above 1, at least 2 x PPC wide and
//             a multiple of PPC.

`default_nettype none

module gaussian5x5 #(
    parameter PPC        = 1,     // pixels a beat, the leftmost in the low bits
    parameter MAX_WIDTH  = 1280,
    parameter MAX_HEIGHT = 720
) (
    input  wire             clk,
    input  wire             rst,
    input  wire [     15:0] cfg_width,
    input  wire [     15:0] cfg_height,
    input  wire [8*PPC-1:0] s_axis_tdata,
    input  wire             s_axis_tvalid,
    output wire             s_axis_tready,
    input  wire             s_axis_tuser,
    input  wire             s_axis_tlast,
    output wire [8*PPC-1:0] m_axis_tdata,
    output wire             m_axis_tvalid,
    input  wire             m_axis_tready,
    output wire             m_axis_tuser,
    output wire             m_axis_tlast,
    output wire             frame_error
);

  localparam REFLECT_101 = 1;

  wire              advance;

  wire              column_valid;
  wire              column_sof;
  wire              column_first;
  wire              column_last;
  wire [40*PPC-1:0] column;

  wire              column_sum_valid;
  wire              column_sum_sof;
  wire              column_sum_first;
  wire              column_sum_last;
  wire [16*PPC-1:0] column_sum;

  wire              window_valid;
  wire              window_sof;
  wire              window_last;
  wire [80*PPC-1:0] window;

  wire              sum_valid;
  wire              sum_sof;
  wire              sum_last;
  wire [24*PPC-1:0] sum;
  wire [ 8*PPC-1:0] rounded;

  reg  [ 8*PPC-1:0] blurred_reg;
  reg               blurred_valid_reg;
  reg               blurred_sof_reg;
  reg               blurred_last_reg;

  window_rows #(
      .TAPS      (5),
      .DATA_WIDTH(8),
      .BORDER    (REFLECT_101),
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

  gaussian_taps #(
      .WIDTH    (8),
      .PPC      (PPC),
      .TAG_WIDTH(3)
  ) vertical (
      .clk      (clk),
      .rst      (rst),
      .advance  (advance),
      .taps     (column),
      .tags     ({column_sof, column_first, column_last}),
      .valid    (column_valid),
      .sum      (column_sum),
      .sum_tags ({column_sum_sof, column_sum_first, column_sum_last}),
      .sum_valid(column_sum_valid)
  );

  window_cols #(
      .TAPS      (5),
      .DATA_WIDTH(16),
      .BORDER    (REFLECT_101),
      .PPC       (PPC)
  ) cols (
      .clk         (clk),
      .rst         (rst),
      .advance     (advance),
      .column_valid(column_sum_valid),
      .column_sof  (column_sum_sof),
      .column_first(column_sum_first),
      .column_last (column_sum_last),
      .column      (column_sum),
      .window_valid(window_valid),
      .window_sof  (window_sof),
      .window_last (window_last),
      .window      (window)
  );

  gaussian_taps #(
      .WIDTH    (16),
      .PPC      (PPC),
      .TAG_WIDTH(2)
  ) horizontal (
      .clk      (clk),
      .rst      (rst),
      .advance  (advance),
      .taps     (window),
      .tags     ({window_sof, window_last}),
      .valid    (window_valid),
      .sum      (sum),
      .sum_tags ({sum_sof, sum_last}),
      .sum_valid(sum_valid)
  );

  genvar pixel;
  generate
    for (pixel = 0; pixel < PPC; pixel = pixel + 1) begin : g_pixel
      wire [ 7:0] whole;
      wire        half;
      wire [14:0] unused_fraction;

      assign {whole, half, unused_fraction} = sum[24*pixel+:24];
      assign rounded[8*pixel+:8] = whole + {7'b0, half};
    end
  endgenerate

  always @(posedge clk) begin
    if (advance) begin
      blurred_reg       <= rounded;
      blurred_valid_reg <= sum_valid;
      blurred_sof_reg   <= sum_sof;
      blurred_last_reg  <= sum_last;
    end

    if (rst) blurred_valid_reg <= 1'b0;
  end

  axis_skid #(
      .WIDTH(8 * PPC + 2)
  ) output_slice (
      .clk      (clk),
      .rst      (rst),
      .s_payload({blurred_sof_reg, blurred_last_reg, blurred_reg}),
      .s_valid  (blurred_valid_reg),
      .s_ready  (advance),
      .m_payload({m_axis_tuser, m_axis_tlast, m_axis_tdata}),
      .m_valid  (m_axis_tvalid),
      .m_ready  (m_axis_tready)
  );

endmodule

`default_nettype wire
