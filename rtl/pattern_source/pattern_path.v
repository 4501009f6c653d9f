// SPDX-License-Identifier: Apache-2.0
// Where the pad stands along one axis: to and fro around MIDDLE, one pixel a step, TRAVEL to either side.
//
// Latency: one cycle from step. Throughput: a step a cycle. Border, rounding, overflow: none, with TRAVEL at most MIDDLE and
// their sum less than 2^BITS. Limits: the caller's to keep.

`default_nettype none

module pattern_path #(
    parameter BITS   = 11,
    parameter MIDDLE = 640,
    parameter TRAVEL = 278
) (
    input wire pix_clk,
    input wire pix_rst,

    input wire step,

    output reg [BITS-1:0] place
);

  localparam [31:0] START = MIDDLE;
  localparam [31:0] LEAST = MIDDLE - TRAVEL;
  localparam [31:0] MOST = MIDDLE + TRAVEL;

  reg  up_reg;
  wire up_next = place == LEAST[BITS-1:0] || (up_reg && place != MOST[BITS-1:0]);

  always @(posedge pix_clk) begin
    if (step && TRAVEL != 0) begin
      up_reg <= up_next;
      place  <= up_next ? place + 1'b1 : place - 1'b1;
    end
    if (pix_rst) begin
      up_reg <= 1'b1;
      place  <= START[BITS-1:0];
    end
  end

endmodule

`default_nettype wire
