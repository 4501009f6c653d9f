// SPDX-License-Identifier: Apache-2.0
// Ports only, for tests of the board while rtl/ has no such core, or one without all of them.

`default_nettype none (* blackbox *)
module frame_source (
    input wire clk,
    input wire rst,
    input wire cfg_enable,
    input wire [31:0] cfg_base,
    output wire [31:0] m_axi_araddr,
    output wire [7:0] m_axi_arlen,
    output wire [2:0] m_axi_arsize,
    output wire [1:0] m_axi_arburst,
    output wire [3:0] m_axi_arcache,
    output wire [2:0] m_axi_arprot,
    output wire m_axi_arvalid,
    input wire m_axi_arready,
    input wire [63:0] m_axi_rdata,
    input wire [1:0] m_axi_rresp,
    input wire m_axi_rlast,
    input wire m_axi_rvalid,
    output wire m_axi_rready,
    output wire underflow,
    output wire read_error,
    input wire pix_clk,
    output wire [23:0] out_data,
    output wire out_de,
    output wire out_hsync,
    output wire out_vsync
);

endmodule

`default_nettype wire
