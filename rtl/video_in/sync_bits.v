// SPDX-License-Identifier: Apache-2.0
// Two-flop synchroniser. Bits of a bus arrive in different cycles: use it for single bits and gray code only.
// Latency: 2 cycles of clk. rst is asynchronous to be effective without a clock.
`default_nettype none

module sync_bits #(
    parameter WIDTH = 1
) (
    input  wire             clk,
    input  wire             rst,
    input  wire [WIDTH-1:0] d,
    output wire [WIDTH-1:0] q
);

  (* ASYNC_REG = "TRUE" *)reg [WIDTH-1:0] first_reg;
  (* ASYNC_REG = "TRUE" *)reg [WIDTH-1:0] second_reg;

  assign q = second_reg;

  always @(posedge clk or posedge rst) begin
    if (rst) begin
      first_reg  <= {WIDTH{1'b0}};
      second_reg <= {WIDTH{1'b0}};
    end else begin
      first_reg  <= d;
      second_reg <= first_reg;
    end
  end

endmodule

`default_nettype wire
