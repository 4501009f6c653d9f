// SPDX-License-Identifier: Apache-2.0
// Ports of Digilent's transmitter as scripts/vivado/digilent.tcl configures it.

`default_nettype none (* blackbox *)
module rgb2dvi_0 (
    output wire TMDS_Clk_p,
    output wire TMDS_Clk_n,
    output wire [2:0] TMDS_Data_p,
    output wire [2:0] TMDS_Data_n,
    input wire aRst,
    input wire [23:0] vid_pData,
    input wire vid_pVDE,
    input wire vid_pHSync,
    input wire vid_pVSync,
    input wire PixelClk
);

endmodule

`default_nettype wire
