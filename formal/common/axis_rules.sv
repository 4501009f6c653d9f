// SPDX-License-Identifier: Apache-2.0
// AXI4-Stream rules of a source: after reset tvalid is 0; once 1 it stays 1, and the payload with it, until tready.
`default_nettype none

module axis_rules #(
    parameter WIDTH = 1
) (
    input wire             clk,
    input wire             rst,
    input wire             valid,
    input wire             ready,
    input wire [WIDTH-1:0] payload
);

  reg             known = 1'b0;
  reg             was_rst;
  reg             waits;
  reg [WIDTH-1:0] payload_reg;

  always @(posedge clk) begin
    known       <= 1'b1;
    was_rst     <= rst;
    waits       <= valid && !ready && !rst;
    payload_reg <= payload;
  end

  always @(posedge clk) begin
    if (known && was_rst) assert (!valid);
    if (known && waits) assert (valid);
    if (known && waits && valid) assert (payload == payload_reg);
  end

endmodule

`default_nettype wire
