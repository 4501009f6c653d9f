// SPDX-License-Identifier: Apache-2.0
// Ports of the vendor's global clock buffer.

`default_nettype none (* blackbox *)
module BUFG (
    input  wire I,
    output wire O
);

endmodule

`default_nettype wire
