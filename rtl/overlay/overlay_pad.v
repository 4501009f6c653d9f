// SPDX-License-Identifier: Apache-2.0
// Whether a pixel lies on the mark of the pad: an upright cross at its centre, arms of 12 pixels, 3 pixels wide, and the
// line from the centre to the tip.
//
// Latency: covers speaks of the pixel that was x_1, y_1 three beats before. Throughput: a pixel a beat. Border, rounding,
// overflow: none. Limits: none.
//
// The line: with dx, dy from centre to tip, the pixels for which |(x - centre_x) dy - (y - centre_y) dx| is at most the
// greater of |dx| and |dy|, no further than one pixel outside the box of both ends. The product grows by dy a pixel and
// falls by dx a line, so that only its value at the first pixel of a frame is multiplied out. That takes three stages;
// what a frame has sampled walks through them with its first pixel, and changes nothing for the pixels ahead of it.

`default_nettype none

module overlay_pad (
    input wire clk,
    input wire rst,
    input wire advance,
    input wire start,  // the pixel that stage 1 takes now is the first of its frame
    input wire hold,
    input wire show,
    input wire signed [13:0] centre_x,
    input wire signed [13:0] centre_y,
    input wire signed [13:0] tip_x,
    input wire signed [13:0] tip_y,
    input wire valid_3,
    input wire sol_1,  // the pixel is the first of its line
    input wire signed [13:0] x_1,
    input wire signed [13:0] y_1,
    output wire covers
);

  localparam signed [14:0] ARM = 15'sd12;

  // ---- Where the pixel is, beside it. {first of the frame, with a sample; first of the frame; first of the line}

  reg signed [13:0] x_2_reg, y_2_reg, x_3_reg, y_3_reg, x_4_reg, y_4_reg;
  reg [1:0] start_1_reg;
  reg [2:0] starts_2_reg, starts_3_reg;

  always @(posedge clk) begin
    if (advance) begin
      start_1_reg <= {start && !hold, start};
      starts_2_reg <= {start_1_reg, sol_1};
      starts_3_reg <= starts_2_reg;
      {x_2_reg, y_2_reg} <= {x_1, y_1};
      {x_3_reg, y_3_reg} <= {x_2_reg, y_2_reg};
      {x_4_reg, y_4_reg} <= {x_3_reg, y_3_reg};
    end
    if (rst) {start_1_reg, starts_2_reg, starts_3_reg} <= 8'd0;
  end

  // ---- From centre and tip to what stage 4 compares with.

  reg show_1_reg, show_2_reg, show_3_reg, show_4_reg;
  reg signed [13:0] centre_x_1_reg, centre_y_1_reg, tip_x_1_reg, tip_y_1_reg;
  reg signed [13:0] centre_x_2_reg, centre_y_2_reg, tip_x_2_reg, tip_y_2_reg;
  // Kept, as yosys takes them into the multipliers and leaves who else reads them without a driver.
  (* keep *) reg signed [14:0] dx_2_reg, dy_2_reg;
  reg signed [13:0]
      centre_x_3_reg, centre_y_3_reg, low_x_3_reg, high_x_3_reg, low_y_3_reg, high_y_3_reg;
  reg signed [14:0] dx_3_reg, dy_3_reg;
  reg [14:0] dx_size_3_reg, dy_size_3_reg;
  reg signed [28:0] cx_dy_3_reg, cy_dx_3_reg;
  // The cross at the centre: ends of its long arms, sides of its thin ones.
  reg signed [14:0] long_left_4_reg, long_right_4_reg, long_top_4_reg, long_bottom_4_reg;
  reg signed [14:0] thin_left_4_reg, thin_right_4_reg, thin_top_4_reg, thin_bottom_4_reg;
  reg signed [14:0] low_x_4_reg, high_x_4_reg, low_y_4_reg, high_y_4_reg;
  reg signed [14:0] dx_4_reg, dy_4_reg;
  reg signed [30:0] first_4_reg;
  reg [14:0] reach_4_reg;

  wire signed [30:0] first = {{2{cy_dx_3_reg[28]}}, cy_dx_3_reg} - {{2{cx_dy_3_reg[28]}}, cx_dy_3_reg};

  wire sample_1 = start && !hold;
  wire sample_2 = advance && start_1_reg[1];
  wire sample_3 = advance && starts_2_reg[2];
  wire sample_4 = advance && starts_3_reg[2];

  always @(posedge clk) begin
    if (sample_1) begin
      show_1_reg     <= show;
      centre_x_1_reg <= centre_x;
      centre_y_1_reg <= centre_y;
      tip_x_1_reg    <= tip_x;
      tip_y_1_reg    <= tip_y;
    end
    if (sample_2) begin
      show_2_reg     <= show_1_reg;
      centre_x_2_reg <= centre_x_1_reg;
      centre_y_2_reg <= centre_y_1_reg;
      tip_x_2_reg    <= tip_x_1_reg;
      tip_y_2_reg    <= tip_y_1_reg;
      dx_2_reg       <= tip_x_1_reg - centre_x_1_reg;
      dy_2_reg       <= tip_y_1_reg - centre_y_1_reg;
    end
    if (sample_3) begin
      show_3_reg     <= show_2_reg;
      centre_x_3_reg <= centre_x_2_reg;
      centre_y_3_reg <= centre_y_2_reg;
      low_x_3_reg    <= dx_2_reg[14] ? tip_x_2_reg : centre_x_2_reg;
      high_x_3_reg   <= dx_2_reg[14] ? centre_x_2_reg : tip_x_2_reg;
      low_y_3_reg    <= dy_2_reg[14] ? tip_y_2_reg : centre_y_2_reg;
      high_y_3_reg   <= dy_2_reg[14] ? centre_y_2_reg : tip_y_2_reg;
      dx_3_reg       <= dx_2_reg;
      dy_3_reg       <= dy_2_reg;
      dx_size_3_reg  <= dx_2_reg[14] ? -dx_2_reg : dx_2_reg;
      dy_size_3_reg  <= dy_2_reg[14] ? -dy_2_reg : dy_2_reg;
      cx_dy_3_reg    <= centre_x_2_reg * dy_2_reg;
      cy_dx_3_reg    <= centre_y_2_reg * dx_2_reg;
    end
    if (sample_4) begin
      show_4_reg     <= show_3_reg;
      long_left_4_reg   <= centre_x_3_reg - ARM;
      long_right_4_reg  <= centre_x_3_reg + ARM;
      long_top_4_reg    <= centre_y_3_reg - ARM;
      long_bottom_4_reg <= centre_y_3_reg + ARM;
      thin_left_4_reg   <= centre_x_3_reg - 15'sd1;
      thin_right_4_reg  <= centre_x_3_reg + 15'sd1;
      thin_top_4_reg    <= centre_y_3_reg - 15'sd1;
      thin_bottom_4_reg <= centre_y_3_reg + 15'sd1;
      low_x_4_reg    <= low_x_3_reg - 15'sd1;
      high_x_4_reg   <= high_x_3_reg + 15'sd1;
      low_y_4_reg    <= low_y_3_reg - 15'sd1;
      high_y_4_reg   <= high_y_3_reg + 15'sd1;
      dx_4_reg       <= dx_3_reg;
      dy_4_reg       <= dy_3_reg;
      first_4_reg    <= first;
      reach_4_reg    <= dx_size_3_reg > dy_size_3_reg ? dx_size_3_reg : dy_size_3_reg;
    end
    if (rst) show_4_reg <= 1'b0;
  end

  // ---- The product at the pixel of stage 4, and at the first pixel of its line.

  reg signed  [30:0] product_reg;
  reg signed  [30:0] line_reg;
  wire signed [30:0] next_line = line_reg - {{16{dx_4_reg[14]}}, dx_4_reg};

  always @(posedge clk) begin
    if (advance && valid_3) begin
      if (starts_3_reg[1]) begin
        product_reg <= starts_3_reg[2] ? first : first_4_reg;
        line_reg    <= starts_3_reg[2] ? first : first_4_reg;
      end else if (starts_3_reg[0]) begin
        product_reg <= next_line;
        line_reg    <= next_line;
      end else begin
        product_reg <= product_reg + {{16{dy_4_reg[14]}}, dy_4_reg};
      end
    end
  end

  // Whether the product lies beyond the reach to either side, by the sign of one sum each.
  wire beyond_low, beyond_high;
  wire [30:0] unused_low, unused_high;

  assign {beyond_low, unused_low}   = {17'd0, reach_4_reg} + {product_reg[30], product_reg};
  assign {beyond_high, unused_high} = {17'd0, reach_4_reg} - {product_reg[30], product_reg};

  wire near = !beyond_low && !beyond_high;
  wire signed [14:0] at_x = {x_4_reg[13], x_4_reg};
  wire signed [14:0] at_y = {y_4_reg[13], y_4_reg};
  wire near_ends = at_x >= low_x_4_reg && at_x <= high_x_4_reg && at_y >= low_y_4_reg && at_y <= high_y_4_reg;

  wire wide = at_x >= long_left_4_reg && at_x <= long_right_4_reg;
  wire narrow = at_x >= thin_left_4_reg && at_x <= thin_right_4_reg;
  wire tall = at_y >= long_top_4_reg && at_y <= long_bottom_4_reg;
  wire flat = at_y >= thin_top_4_reg && at_y <= thin_bottom_4_reg;

  assign covers = show_4_reg && ((near && near_ends) || (wide && flat) || (narrow && tall));

endmodule

`default_nettype wire
