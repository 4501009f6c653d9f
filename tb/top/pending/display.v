// SPDX-License-Identifier: Apache-2.0
// Ports only, for tests of the board while rtl/ has no such core, or one without all of them.

`default_nettype none (* blackbox *)
module display #(
    parameter CLK_PER_US = 100
) (
    input wire clk,
    input wire rst,
    input wire [11:0] s_axil_awaddr,
    input wire [2:0] s_axil_awprot,
    input wire s_axil_awvalid,
    output wire s_axil_awready,
    input wire [31:0] s_axil_wdata,
    input wire [3:0] s_axil_wstrb,
    input wire s_axil_wvalid,
    output wire s_axil_wready,
    output wire [1:0] s_axil_bresp,
    output wire s_axil_bvalid,
    input wire s_axil_bready,
    input wire [11:0] s_axil_araddr,
    input wire [2:0] s_axil_arprot,
    input wire s_axil_arvalid,
    output wire s_axil_arready,
    output wire [31:0] s_axil_rdata,
    output wire [1:0] s_axil_rresp,
    output wire s_axil_rvalid,
    input wire s_axil_rready,
    input wire [15:0] view_width,
    input wire [15:0] view_height,
    input wire [23:0] view_rgb_tdata,
    input wire view_rgb_tvalid,
    input wire view_rgb_tuser,
    input wire view_rgb_tlast,
    input wire [7:0] view_gray_tdata,
    input wire view_gray_tvalid,
    input wire view_gray_tuser,
    input wire view_gray_tlast,
    input wire view_binary_tdata,
    input wire view_binary_tvalid,
    input wire view_binary_tuser,
    input wire view_binary_tlast,
    input wire [7:0] view_label_tdata,
    input wire view_label_tvalid,
    input wire view_label_tuser,
    input wire view_label_tlast,
    input wire pix_clk,
    input wire vid_de,
    input wire vid_hsync,
    input wire vid_vsync,
    output wire [23:0] out_data,
    output wire out_de,
    output wire out_hsync,
    output wire out_vsync,
    input wire pix_clk_locked,
    input wire monitor_present,
    input wire [3:0] buttons,
    input wire [1:0] switches,
    output wire [3:0] leds,
    output wire [1:0] source,
    output wire pattern_move,
    output wire [31:0] stored_base,
    input wire stored_underflow,
    input wire stored_error
);

endmodule

`default_nettype wire
