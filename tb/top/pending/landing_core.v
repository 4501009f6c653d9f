// SPDX-License-Identifier: Apache-2.0
// Ports and the cell that constraints name, for tests of the board while rtl/ has no such core, or one without all of them.

`default_nettype none
module landing_core #(
    parameter MAX_WIDTH  = 1280,
    parameter MAX_HEIGHT = 720,
    parameter CLK_PER_US = 100
) (
    input wire clk,
    input wire rst,
    input wire pix_clk,
    input wire [23:0] vid_data,
    input wire vid_de,
    input wire vid_hsync,
    input wire vid_vsync,
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
    output wire [31:0] m_axi_awaddr,
    output wire [7:0] m_axi_awlen,
    output wire [2:0] m_axi_awsize,
    output wire [1:0] m_axi_awburst,
    output wire [3:0] m_axi_awcache,
    output wire [2:0] m_axi_awprot,
    output wire m_axi_awvalid,
    input wire m_axi_awready,
    output wire [63:0] m_axi_wdata,
    output wire [7:0] m_axi_wstrb,
    output wire m_axi_wlast,
    output wire m_axi_wvalid,
    input wire m_axi_wready,
    input wire [1:0] m_axi_bresp,
    input wire m_axi_bvalid,
    output wire m_axi_bready,
    output wire [15:0] view_width,
    output wire [15:0] view_height,
    output wire [23:0] view_rgb_tdata,
    output wire view_rgb_tvalid,
    output wire view_rgb_tuser,
    output wire view_rgb_tlast,
    output wire [7:0] view_gray_tdata,
    output wire view_gray_tvalid,
    output wire view_gray_tuser,
    output wire view_gray_tlast,
    output wire view_binary_tdata,
    output wire view_binary_tvalid,
    output wire view_binary_tuser,
    output wire view_binary_tlast,
    output wire [7:0] view_label_tdata,
    output wire view_label_tvalid,
    output wire view_label_tuser,
    output wire view_label_tlast,
    input wire lidar_in,
    output wire lidar_drive_low,
    output wire irq
);

  assign s_axil_awready = 0;
  assign s_axil_wready = 0;
  assign s_axil_bresp = 0;
  assign s_axil_bvalid = 0;
  assign s_axil_arready = 0;
  assign s_axil_rdata = 0;
  assign s_axil_rresp = 0;
  assign s_axil_rvalid = 0;
  assign m_axi_awaddr = 0;
  assign m_axi_awlen = 0;
  assign m_axi_awsize = 0;
  assign m_axi_awburst = 0;
  assign m_axi_awcache = 0;
  assign m_axi_awprot = 0;
  assign m_axi_awvalid = 0;
  assign m_axi_wdata = 0;
  assign m_axi_wstrb = 0;
  assign m_axi_wlast = 0;
  assign m_axi_wvalid = 0;
  assign m_axi_bready = 0;
  assign view_width = 0;
  assign view_height = 0;
  assign view_rgb_tdata = 0;
  assign view_rgb_tvalid = 0;
  assign view_rgb_tuser = 0;
  assign view_rgb_tlast = 0;
  assign view_gray_tdata = 0;
  assign view_gray_tvalid = 0;
  assign view_gray_tuser = 0;
  assign view_gray_tlast = 0;
  assign view_binary_tdata = 0;
  assign view_binary_tvalid = 0;
  assign view_binary_tuser = 0;
  assign view_binary_tlast = 0;
  assign view_label_tdata = 0;
  assign view_label_tvalid = 0;
  assign view_label_tuser = 0;
  assign view_label_tlast = 0;
  assign irq = 0;

  // Its two flip-flops are in constraints/video_in.xdc.
  wire [31:0] unused_distance_mm;
  wire unused_valid;
  wire [31:0] unused_age_us;
  wire unused_updated;
  wire unused_timeout;
  wire unused_too_long;
  wire unused_too_short;

  lidar_pwm lidar (
      .clk(clk),
      .rst(rst),
      .tick_us(1'b1),
      .enable(1'b1),
      .lidar_in(lidar_in),
      .lidar_drive_low(lidar_drive_low),
      .distance_mm(unused_distance_mm),
      .valid(unused_valid),
      .age_us(unused_age_us),
      .updated(unused_updated),
      .timeout(unused_timeout),
      .too_long(unused_too_long),
      .too_short(unused_too_short)
  );

endmodule

`default_nettype wire
