// SPDX-License-Identifier: Apache-2.0
// The threshold at each pixel of a raster, bilinear between nodes at the window centres, exact.
//
// Vertically once a window segment of a line: line = (one - v) * top + v * bottom, with one = 2**(WINDOW_LOG2 + 1) and
// v odd: one multiplication. Horizontally by adding: from one pixel of a segment to the next the sum one * line grows
// by 2 * slope, with slope = line right - line left; across a node by the slope before plus the slope after; and
// beyond the outermost nodes the slope is 0. So one adder a pixel makes what (one - u) * left + u * right would.
//
// threshold is the integer part of the sum: for an integer pixel, pixel > sum and pixel > integer part are the same.
// Latency 8 cycles of advance, for valid as well; read_* is combinational, its answer comes 2 cycles later.

`default_nettype none

module threshold_interpolate #(
    parameter WINDOW_LOG2 = 7
) (
    input wire clk,
    input wire rst,
    input wire advance,

    input wire        pixel_valid,
    input wire        pixel_sol,
    input wire [15:0] pixel_x,
    input wire [15:0] pixel_y,
    input wire [15:0] last_column,
    input wire [15:0] last_row,

    output wire [15:0] read_row,
    output wire [15:0] read_column,
    input  wire [15:0] node_top,
    input  wire [15:0] node_bottom,

    output wire       valid,
    output wire [7:0] threshold
);

  localparam WEIGHT = WINDOW_LOG2 + 1;
  localparam LINE = 16 + WEIGHT;
  localparam SUM = LINE + WEIGHT;
  localparam [15:0] HALF = 16'd1 << (WINDOW_LOG2 - 1);

  // Stage 1 is the input. In y, segment s lies between rows s - 1 and s; in x, node c is fetched where the segment to
  // its left begins, and node 0 with the line.
  wire [15:0] x_from_node = pixel_x + HALF;
  wire [15:0] y_from_node = pixel_y + HALF;
  wire [15:0] column = x_from_node >> WINDOW_LOG2;
  wire [15:0] segment = y_from_node >> WINDOW_LOG2;
  wire        above_first = segment == 16'd0;
  wire        below_last = segment > last_row;
  wire        at_node = x_from_node[WINDOW_LOG2-1:0] == {WINDOW_LOG2{1'b0}};

  assign read_row    = above_first ? 16'd0 : segment - 16'd1;
  assign read_column = pixel_sol ? 16'd0 : column;

  // Stages 2 to 6: the threshold of the node on this line.
  reg [9:2] valid_reg;
  reg [6:2] fetch_reg;
  reg [8:2] sol_reg;
  reg [6:2] inside_reg;
  reg [3:2] flat_reg;
  reg [WEIGHT-1:0] weight2_reg;
  reg [WEIGHT-1:0] weight3_reg;
  reg [WEIGHT-1:0] weight4_reg;
  reg [15:0] top4_reg;
  reg [15:0] top5_reg;
  reg signed [16:0] fall4_reg;
  reg [LINE-1:0] product5_reg;
  reg [LINE-1:0] line6_reg;
  wire signed [WEIGHT:0] signed_weight4 = {1'b0, weight4_reg};
  wire signed [LINE+1:0] product4 = fall4_reg * signed_weight4;
  // The sum that product4 goes into is not negative and has LINE bits: it is right without the bits above.
  wire [1:0] unused_product4 = product4[LINE+1:LINE];

  // Stages 7 to 9: along the line.
  reg [LINE-1:0] line7_reg;
  reg [LINE-1:0] line8_reg;
  reg [LINE:0] slope7_reg;
  reg [LINE:0] slope_before7_reg;
  reg [LINE+1:0] step8_reg;
  reg [SUM-1:0] sum9_reg;

  assign valid     = valid_reg[9];
  assign threshold = sum9_reg[SUM-1:SUM-8];

  always @(posedge clk) begin
    if (advance) begin
      valid_reg    <= {valid_reg[8:2], pixel_valid};
      fetch_reg    <= {fetch_reg[5:2], pixel_sol || at_node};
      sol_reg      <= {sol_reg[7:2], pixel_sol};
      inside_reg   <= {inside_reg[5:2], column <= last_column};

      flat_reg     <= {flat_reg[2], above_first || below_last};
      weight2_reg  <= {y_from_node[WINDOW_LOG2-1:0], 1'b1};
      weight3_reg  <= weight2_reg;

      // The memory may hold nothing below the last row.
      fall4_reg    <= flat_reg[3] ? 17'd0 : {1'b0, node_bottom} - {1'b0, node_top};
      weight4_reg  <= weight3_reg;
      top4_reg     <= node_top;

      product5_reg <= product4[LINE-1:0];
      top5_reg     <= top4_reg;

      line6_reg    <= {top5_reg, {WEIGHT{1'b0}}} + product5_reg;

      if (valid_reg[6]) begin
        slope_before7_reg <= slope7_reg;
        if (fetch_reg[6]) begin
          line7_reg <= line6_reg;
          slope7_reg <= inside_reg[6] && !sol_reg[6] ? {1'b0, line6_reg} - {1'b0, line7_reg} : {(LINE + 1) {1'b0}};
        end
      end

      step8_reg <= {slope7_reg[LINE], slope7_reg} + {slope_before7_reg[LINE], slope_before7_reg};
      line8_reg <= line7_reg;

      if (valid_reg[8])
        sum9_reg <= sol_reg[8] ? {line8_reg, {WEIGHT{1'b0}}} :
            sum9_reg + {{(SUM - LINE - 2) {step8_reg[LINE+1]}}, step8_reg};
    end

    if (rst) valid_reg <= 8'd0;
  end

endmodule

`default_nettype wire
