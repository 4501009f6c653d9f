// SPDX-License-Identifier: Apache-2.0
// Ports of the vendor's buffer of a pin for both directions; it drives I while T is 0.

`default_nettype none (* blackbox *)
module IOBUF (
    input  wire I,
    output wire O,
    input  wire T,
    inout  wire IO
);

endmodule

`default_nettype wire
