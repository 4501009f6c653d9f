// SPDX-License-Identifier: Apache-2.0
// Reset for another clock: rises at once, also when that clock stands still, and falls with its second edge after
// rst_in fell. rst_in comes from a flip-flop, so that it has no glitches.
`default_nettype none

module reset_sync (
    input  wire clk,
    input  wire rst_in,
    output wire rst_out
);

  (* ASYNC_REG = "TRUE" *)reg first_reg;
  (* ASYNC_REG = "TRUE" *)reg second_reg;

  assign rst_out = second_reg;

  always @(posedge clk or posedge rst_in) begin
    if (rst_in) begin
      first_reg  <= 1'b1;
      second_reg <= 1'b1;
    end else begin
      first_reg  <= 1'b0;
      second_reg <= first_reg;
    end
  end

endmodule

`default_nettype wire
