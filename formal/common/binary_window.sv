// SPDX-License-Identifier: Apache-2.0
// How many ones a square around a pixel of a small frame holds: the slow and obvious way. Outside the frame, RULE 0
// repeats the border pixel, 1 reads zeros, 2 reads ones.
`default_nettype none

module binary_window #(
    parameter REACH = 1,
    parameter RULE  = 0
) (
    input  wire [15:0] cfg_width,
    input  wire [15:0] cfg_height,
    input  wire [31:0] pixels,
    input  wire        frame,
    input  wire [ 1:0] column,
    input  wire [ 1:0] line,
    output reg  [ 4:0] ones
);

  integer dx, dy, x, y, width, height;
  reg outside, pixel;

  always @* begin
    ones   = 5'd0;
    width  = cfg_width;
    height = cfg_height;
    for (dy = -REACH; dy <= REACH; dy = dy + 1)
      for (dx = -REACH; dx <= REACH; dx = dx + 1) begin
        x = column + dx;
        y = line + dy;
        outside = x < 0 || y < 0 || x >= width || y >= height;
        if (x < 0) x = 0;
        if (y < 0) y = 0;
        if (x >= width) x = width - 1;
        if (y >= height) y = height - 1;
        pixel = pixels[{frame, y[1:0], x[1:0]}];
        if (outside && RULE == 1) pixel = 1'b0;
        if (outside && RULE == 2) pixel = 1'b1;
        ones = ones + {4'd0, pixel};
      end
  end

endmodule

`default_nettype wire
