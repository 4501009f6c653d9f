// SPDX-License-Identifier: Apache-2.0
// Ports of Digilent's receiver as scripts/vivado/digilent.tcl configures it.

`default_nettype none (* blackbox *)
module dvi2rgb_0 (
    input wire TMDS_Clk_p,
    input wire TMDS_Clk_n,
    input wire [2:0] TMDS_Data_p,
    input wire [2:0] TMDS_Data_n,
    input wire RefClk,
    input wire aRst,
    output wire [23:0] vid_pData,
    output wire vid_pVDE,
    output wire vid_pHSync,
    output wire vid_pVSync,
    output wire PixelClk,
    output wire aPixelClkLckd,
    input wire SDA_I,
    output wire SDA_O,
    output wire SDA_T,
    input wire SCL_I,
    output wire SCL_O,
    output wire SCL_T,
    input wire pRst
);

endmodule

`default_nettype wire
