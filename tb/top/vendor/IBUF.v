// SPDX-License-Identifier: Apache-2.0
// Ports of the vendor's input buffer.

`default_nettype none (* blackbox *)
module IBUF (
    input  wire I,
    output wire O
);

endmodule

`default_nettype wire
