// SPDX-License-Identifier: Apache-2.0
// Ports and parameters of the vendor's clock switch that are used here.

`default_nettype none (* blackbox *)
module BUFGCTRL #(
    parameter INIT_OUT = 0,
    parameter PRESELECT_I0 = "FALSE",
    parameter PRESELECT_I1 = "FALSE"
) (
    input  wire I0,
    input  wire I1,
    input  wire S0,
    input  wire S1,
    input  wire CE0,
    input  wire CE1,
    input  wire IGNORE0,
    input  wire IGNORE1,
    output wire O
);

endmodule

`default_nettype wire
