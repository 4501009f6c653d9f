// SPDX-License-Identifier: Apache-2.0
// Whether a pixel lies in a box, and on its line, which is 2 pixels wide and lies inside.
//
// Latency 0 cycles from x, y. Throughput: a pixel a cycle. Border, rounding, overflow: none. Limits: what sample finds
// counts for the pixels from the next cycle on.

`default_nettype none

module overlay_box (
    input  wire               clk,
    input  wire               rst,
    input  wire               sample,
    input  wire               show,
    input  wire signed [13:0] left,
    input  wire signed [13:0] top,
    input  wire signed [13:0] right,
    input  wire signed [13:0] bottom,
    input  wire signed [13:0] x,
    input  wire signed [13:0] y,
    output wire               holds,
    output wire               covers
);

  reg show_reg;
  reg signed [13:0] left_reg, top_reg, right_reg, bottom_reg;

  // How far within the box; negative is outside.
  wire signed [14:0] from_left = x - left_reg;
  wire signed [14:0] from_top = y - top_reg;
  wire signed [14:0] from_right = right_reg - x;
  wire signed [14:0] from_bottom = bottom_reg - y;
  wire contains = !(from_left[14] || from_top[14] || from_right[14] || from_bottom[14]);
  // Less than 2, without the sign, as of what lies outside nobody asks.
  wire near_left = from_left[13:0] >> 1 == 14'd0;
  wire near_top = from_top[13:0] >> 1 == 14'd0;
  wire near_right = from_right[13:0] >> 1 == 14'd0;
  wire near_bottom = from_bottom[13:0] >> 1 == 14'd0;
  wire at_edge = near_left || near_top || near_right || near_bottom;

  assign holds = show_reg && contains;
  assign covers = holds && at_edge;

  always @(posedge clk) begin
    if (sample) begin
      show_reg   <= show;
      left_reg   <= left;
      top_reg    <= top;
      right_reg  <= right;
      bottom_reg <= bottom;
    end
    if (rst) show_reg <= 1'b0;
  end

endmodule

`default_nettype wire
