// SPDX-License-Identifier: Apache-2.0
// Whether a pixel lies on the crosshair: arms of 40 pixels from the middle of the frame, 1 pixel wide.
//
// Latency: a beat from x, y. Throughput: a pixel a beat. Border, overflow: none. Rounding: the middle is at half of
// width and height, rounded down. Limits: what start finds counts for the pixels from the next cycle on, show unless hold.

`default_nettype none

module overlay_crosshair (
    input  wire               clk,
    input  wire               rst,
    input  wire               advance,
    input  wire               start,
    input  wire               hold,
    input  wire               show,
    input  wire signed [13:0] half_width,
    input  wire signed [13:0] half_height,
    input  wire signed [13:0] x,
    input  wire signed [13:0] y,
    output wire               covers
);

  localparam signed [14:0] ARM = 15'sd40;

  reg show_reg;
  reg signed [13:0] middle_x_reg, middle_y_reg;

  // A beat later: how far from the middle the pixel lies, and whether its frame shows that.
  reg shown_reg;
  reg signed [14:0] right_reg, below_reg;

  wire level = below_reg == 15'sd0 && right_reg >= -ARM && right_reg <= ARM;
  wire upright = right_reg == 15'sd0 && below_reg >= -ARM && below_reg <= ARM;

  assign covers = shown_reg && (level || upright);

  always @(posedge clk) begin
    if (start) begin
      middle_x_reg <= half_width;
      middle_y_reg <= half_height;
      if (!hold) show_reg <= show;
    end
    if (advance) begin
      shown_reg <= show_reg;
      right_reg <= x - middle_x_reg;
      below_reg <= y - middle_y_reg;
    end
    if (rst) show_reg <= 1'b0;
  end

endmodule

`default_nettype wire
