// SPDX-License-Identifier: Apache-2.0
// Ports and parameters of the vendor's clock synthesiser that are used here.

`default_nettype none (* blackbox *)
module MMCME2_ADV #(
    parameter BANDWIDTH = "OPTIMIZED",
    parameter COMPENSATION = "ZHOLD",
    parameter CLKIN1_PERIOD = 0.0,
    parameter DIVCLK_DIVIDE = 1,
    parameter CLKFBOUT_MULT_F = 5.0,
    parameter CLKOUT0_DIVIDE_F = 1.0
) (
    input wire CLKIN1,
    input wire CLKIN2,
    input wire CLKINSEL,
    input wire CLKFBIN,
    output wire CLKFBOUT,
    output wire CLKOUT0,
    output wire LOCKED,
    input wire RST,
    input wire PWRDWN,
    input wire [6:0] DADDR,
    input wire DCLK,
    input wire DEN,
    input wire [15:0] DI,
    input wire DWE,
    input wire PSCLK,
    input wire PSEN,
    input wire PSINCDEC
);

endmodule

`default_nettype wire
