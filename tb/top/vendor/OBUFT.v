// SPDX-License-Identifier: Apache-2.0
// Ports of the vendor's output buffer that can leave its pin alone; it drives I while T is 0.

`default_nettype none (* blackbox *)
module OBUFT (
    input  wire I,
    output wire O,
    input  wire T
);

endmodule

`default_nettype wire
