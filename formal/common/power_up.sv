// SPDX-License-Identifier: Apache-2.0
// All that is assumed of reset: it is active in the first cycle. Registers hold anything before; it may come again.
`default_nettype none

module power_up (
    input wire clk,
    input wire rst
);

  reg running = 1'b0;

  always @(posedge clk) running <= 1'b1;
  always @* if (!running) assume (rst);

endmodule

`default_nettype wire
