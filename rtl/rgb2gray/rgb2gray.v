// SPDX-License-Identifier: Apache-2.0
// RGB to gray, bit-exact to cv2.cvtColor(COLOR_RGB2GRAY).
//
//   gray = (9798 R + 19235 G + 3735 B + 16384) >> 15
//
// Latency     4 cycles.
// Throughput  a beat of PPC pixels a cycle, no stalls of its own.
// Rounding    half up; the weights sum to 2^15, so the result cannot overflow.
// Borders     none: pointwise. tuser and tlast travel with their pixel, so a
//             malformed frame leaves as it came; the next core judges it.
// Limits      none: it knows no frame size.

`default_nettype none

module rgb2gray #(
    parameter PPC = 1  // pixels a beat, the leftmost in the low bits
) (
    input  wire              clk,
    input  wire              rst,
    input  wire [24*PPC-1:0] s_axis_tdata,   // {R, G, B}
    input  wire              s_axis_tvalid,
    output wire              s_axis_tready,
    input  wire              s_axis_tuser,
    input  wire              s_axis_tlast,
    output wire [ 8*PPC-1:0] m_axis_tdata,
    output wire              m_axis_tvalid,
    input  wire              m_axis_tready,
    output wire              m_axis_tuser,
    output wire              m_axis_tlast
);

  generate
    if (PPC != 1 && PPC != 2 && PPC != 4) begin : g_ppc
      ERROR_ppc_must_be_1_or_2_or_4 error_instance ();
    end
  endgenerate

  localparam [13:0] RED_WEIGHT = 14'd9798;
  localparam [14:0] GREEN_WEIGHT = 15'd19235;
  localparam [11:0] BLUE_WEIGHT = 12'd3735;
  localparam [22:0] HALF = 23'd16384;

  wire             advance;
  wire [8*PPC-1:0] grays;

  // {tuser, tlast} beside the arithmetic.
  reg  [      1:0] markers_1_reg;
  reg  [      1:0] markers_2_reg;
  reg  [      1:0] markers_3_reg;
  reg  [      2:0] valid_reg;

  assign s_axis_tready = advance;

  genvar pixel;
  generate
    for (pixel = 0; pixel < PPC; pixel = pixel + 1) begin : g_pixel
      wire [23:0] rgb = s_axis_tdata[24*pixel+:24];

      // Products, two partial sums, sum.
      reg  [21:0] red_reg;
      reg  [22:0] green_reg;
      reg  [19:0] blue_reg;
      reg  [22:0] red_green_reg;
      reg  [22:0] blue_half_reg;
      reg  [ 7:0] gray_reg;
      wire [ 7:0] gray;
      wire [14:0] unused_fraction;

      assign {gray, unused_fraction} = red_green_reg + blue_half_reg;
      assign grays[8*pixel+:8]       = gray_reg;

      always @(posedge clk) begin
        if (advance) begin
          red_reg       <= rgb[23:16] * RED_WEIGHT;
          green_reg     <= rgb[15:8] * GREEN_WEIGHT;
          blue_reg      <= rgb[7:0] * BLUE_WEIGHT;
          red_green_reg <= {1'b0, red_reg} + green_reg;
          blue_half_reg <= {3'b0, blue_reg} + HALF;
          gray_reg      <= gray;
        end
      end
    end
  endgenerate

  always @(posedge clk) begin
    if (advance) begin
      markers_1_reg <= {s_axis_tuser, s_axis_tlast};
      markers_2_reg <= markers_1_reg;
      markers_3_reg <= markers_2_reg;
      valid_reg     <= {valid_reg[1:0], s_axis_tvalid};
    end

    if (rst) valid_reg <= 3'b0;
  end

  axis_skid #(
      .WIDTH(8 * PPC + 2)
  ) output_slice (
      .clk      (clk),
      .rst      (rst),
      .s_payload({markers_3_reg, grays}),
      .s_valid  (valid_reg[2]),
      .s_ready  (advance),
      .m_payload({m_axis_tuser, m_axis_tlast, m_axis_tdata}),
      .m_valid  (m_axis_tvalid),
      .m_ready  (m_axis_tready)
  );

endmodule

`default_nettype wire
