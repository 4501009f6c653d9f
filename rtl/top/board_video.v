// SPDX-License-Identifier: Apache-2.0
// The board without its vendor's cells: sources of pixels, landing_core, display, and what switches between the sources.
// rtl/top/arty_z7_top.v puts receiver, transmitter, clocks and processor around it; docs/board.md draws the whole.
//
// Clocks: clk never stops. pix_clk is what a clock switch outside gives for select_local and ignore_*: the camera's clock or
// a local one of 74.25 MHz; it may stop. camera_* belong to the camera's clock, so they count only while that is selected.
// rst is synchronous to clk, from a flip-flop. tx_reset holds the transmitter while pix_clk is changed or not to be trusted.
// Latency     2 cycles of pix_clk before landing_core for the camera, 1 for the built-in sources, then that of display.
// Throughput  a pixel a cycle. Border, rounding, overflow: those of the cores.
// Limits      those of the cores; the firmware never gets pixels of another source than display names.

`default_nettype none

module board_video #(
    parameter MAX_WIDTH    = 1280,
    parameter MAX_HEIGHT   = 720,
    parameter CAMERA_FIFO  = 1024,
    parameter DELAY        = 13200,
    parameter MONITOR_FIFO = 16384,
    // Timing of the built-in sources.
    parameter WIDTH        = 1280,
    parameter H_FRONT      = 110,
    parameter H_SYNC       = 40,
    parameter H_TOTAL      = 1650,
    parameter HEIGHT       = 720,
    parameter V_FRONT      = 5,
    parameter V_SYNC       = 5,
    parameter V_TOTAL      = 750,
    parameter CLK_PER_US   = 100,
    parameter QUIET_US     = 100,
    parameter HOLD_US      = 1000
) (
    input wire clk,
    input wire rst,

    input wire        pix_clk,
    input wire [23:0] camera_data,
    input wire        camera_de,
    input wire        camera_hsync,
    input wire        camera_vsync,
    input wire        camera_locked,
    input wire        local_locked,

    output wire select_local,
    output wire ignore_camera,
    output wire ignore_local,

    output wire        tx_reset,
    output wire [23:0] out_data,
    output wire        out_de,
    output wire        out_hsync,
    output wire        out_vsync,
    input  wire        monitor_present,

    input  wire [11:0] s_axil_landing_awaddr,
    input  wire [ 2:0] s_axil_landing_awprot,
    input  wire        s_axil_landing_awvalid,
    output wire        s_axil_landing_awready,
    input  wire [31:0] s_axil_landing_wdata,
    input  wire [ 3:0] s_axil_landing_wstrb,
    input  wire        s_axil_landing_wvalid,
    output wire        s_axil_landing_wready,
    output wire [ 1:0] s_axil_landing_bresp,
    output wire        s_axil_landing_bvalid,
    input  wire        s_axil_landing_bready,
    input  wire [11:0] s_axil_landing_araddr,
    input  wire [ 2:0] s_axil_landing_arprot,
    input  wire        s_axil_landing_arvalid,
    output wire        s_axil_landing_arready,
    output wire [31:0] s_axil_landing_rdata,
    output wire [ 1:0] s_axil_landing_rresp,
    output wire        s_axil_landing_rvalid,
    input  wire        s_axil_landing_rready,

    input  wire [11:0] s_axil_display_awaddr,
    input  wire [ 2:0] s_axil_display_awprot,
    input  wire        s_axil_display_awvalid,
    output wire        s_axil_display_awready,
    input  wire [31:0] s_axil_display_wdata,
    input  wire [ 3:0] s_axil_display_wstrb,
    input  wire        s_axil_display_wvalid,
    output wire        s_axil_display_wready,
    output wire [ 1:0] s_axil_display_bresp,
    output wire        s_axil_display_bvalid,
    input  wire        s_axil_display_bready,
    input  wire [11:0] s_axil_display_araddr,
    input  wire [ 2:0] s_axil_display_arprot,
    input  wire        s_axil_display_arvalid,
    output wire        s_axil_display_arready,
    output wire [31:0] s_axil_display_rdata,
    output wire [ 1:0] s_axil_display_rresp,
    output wire        s_axil_display_rvalid,
    input  wire        s_axil_display_rready,

    output wire [31:0] m_axi_results_awaddr,
    output wire [ 7:0] m_axi_results_awlen,
    output wire [ 2:0] m_axi_results_awsize,
    output wire [ 1:0] m_axi_results_awburst,
    output wire [ 3:0] m_axi_results_awcache,
    output wire [ 2:0] m_axi_results_awprot,
    output wire        m_axi_results_awvalid,
    input  wire        m_axi_results_awready,
    output wire [63:0] m_axi_results_wdata,
    output wire [ 7:0] m_axi_results_wstrb,
    output wire        m_axi_results_wlast,
    output wire        m_axi_results_wvalid,
    input  wire        m_axi_results_wready,
    input  wire [ 1:0] m_axi_results_bresp,
    input  wire        m_axi_results_bvalid,
    output wire        m_axi_results_bready,

    output wire [31:0] m_axi_frames_araddr,
    output wire [ 7:0] m_axi_frames_arlen,
    output wire [ 2:0] m_axi_frames_arsize,
    output wire [ 1:0] m_axi_frames_arburst,
    output wire [ 3:0] m_axi_frames_arcache,
    output wire [ 2:0] m_axi_frames_arprot,
    output wire        m_axi_frames_arvalid,
    input  wire        m_axi_frames_arready,
    input  wire [63:0] m_axi_frames_rdata,
    input  wire [ 1:0] m_axi_frames_rresp,
    input  wire        m_axi_frames_rlast,
    input  wire        m_axi_frames_rvalid,
    output wire        m_axi_frames_rready,

    input  wire       lidar_in,
    output wire       lidar_drive_low,
    input  wire [3:0] buttons,
    input  wire [1:0] switches,
    output wire [3:0] leds,
    output wire       irq
);

  // ---- Which source, which clock.

  wire [1:0] picked;
  wire [1:0] want = picked == 2'd3 ? 2'd0 : picked;
  wire [1:0] source;
  wire       hold;

  assign tx_reset = hold;

  source_switch #(
      .CLK_PER_US(CLK_PER_US),
      .QUIET_US  (QUIET_US),
      .HOLD_US   (HOLD_US)
  ) switch (
      .clk          (clk),
      .rst          (rst),
      .want         (want),
      .camera_locked(camera_locked),
      .local_locked (local_locked),
      .select_local (select_local),
      .ignore_camera(ignore_camera),
      .ignore_local (ignore_local),
      .source       (source),
      .hold         (hold)
  );

  // ---- Built-in sources.

  wire        pattern_move;
  wire        move_in_pix;
  wire        pix_hold;
  wire [26:0] pattern;
  wire [26:0] stored;
  wire [31:0] stored_base;
  wire        stored_underflow;
  wire        stored_error;

  sync_bits move_sync (
      .clk(pix_clk),
      .rst(hold),
      .d  (pattern_move),
      .q  (move_in_pix)
  );

  pattern_source #(
      .WIDTH  (WIDTH),
      .H_FRONT(H_FRONT),
      .H_SYNC (H_SYNC),
      .H_TOTAL(H_TOTAL),
      .HEIGHT (HEIGHT),
      .V_FRONT(V_FRONT),
      .V_SYNC (V_SYNC),
      .V_TOTAL(V_TOTAL)
  ) pattern_camera (
      .pix_clk  (pix_clk),
      .pix_rst  (pix_hold),
      .move     (move_in_pix),
      .out_data (pattern[26:3]),
      .out_de   (pattern[2]),
      .out_hsync(pattern[1]),
      .out_vsync(pattern[0])
  );

  frame_source #(
      .WIDTH  (WIDTH),
      .H_FRONT(H_FRONT),
      .H_SYNC (H_SYNC),
      .H_TOTAL(H_TOTAL),
      .HEIGHT (HEIGHT),
      .V_FRONT(V_FRONT),
      .V_SYNC (V_SYNC),
      .V_TOTAL(V_TOTAL)
  ) stored_camera (
      .clk(clk),
      .rst(rst),
      .cfg_enable(source == 2'd2 && !hold),
      .cfg_base(stored_base),
      .m_axi_araddr(m_axi_frames_araddr),
      .m_axi_arlen(m_axi_frames_arlen),
      .m_axi_arsize(m_axi_frames_arsize),
      .m_axi_arburst(m_axi_frames_arburst),
      .m_axi_arcache(m_axi_frames_arcache),
      .m_axi_arprot(m_axi_frames_arprot),
      .m_axi_arvalid(m_axi_frames_arvalid),
      .m_axi_arready(m_axi_frames_arready),
      .m_axi_rdata(m_axi_frames_rdata),
      .m_axi_rresp(m_axi_frames_rresp),
      .m_axi_rlast(m_axi_frames_rlast),
      .m_axi_rvalid(m_axi_frames_rvalid),
      .m_axi_rready(m_axi_frames_rready),
      .underflow(stored_underflow),
      .read_error(stored_error),
      .pix_clk(pix_clk),
      .out_data(stored[26:3]),
      .out_de(stored[2]),
      .out_hsync(stored[1]),
      .out_vsync(stored[0])
  );

  // ---- The one that counts.

  wire [23:0] vid_data;
  wire        vid_de;
  wire        vid_hsync;
  wire        vid_vsync;

  source_mux mux (
      .pix_clk (pix_clk),
      .hold    (hold),
      .source  (source),
      .camera  ({camera_data, camera_de, camera_hsync, camera_vsync}),
      .pattern (pattern),
      .stored  (stored),
      .pix_hold(pix_hold),
      .data    (vid_data),
      .de      (vid_de),
      .hsync   (vid_hsync),
      .vsync   (vid_vsync)
  );

  // ---- Pad and monitor.

  wire [15:0] view_width;
  wire [15:0] view_height;
  wire [23:0] view_rgb_tdata;
  wire view_rgb_tvalid, view_rgb_tuser, view_rgb_tlast;
  wire [7:0] view_gray_tdata;
  wire view_gray_tvalid, view_gray_tuser, view_gray_tlast;
  wire view_binary_tdata;
  wire view_binary_tvalid, view_binary_tuser, view_binary_tlast;

  landing_core #(
      .MAX_WIDTH  (MAX_WIDTH),
      .MAX_HEIGHT (MAX_HEIGHT),
      .FIFO_DEPTH (CAMERA_FIFO),
      .CLK_PER_US (CLK_PER_US),
      .HAS_DISPLAY(1)
  ) landing (
      .clk(clk),
      .rst(rst),
      .pix_clk(pix_clk),
      .vid_data(vid_data),
      .vid_de(vid_de),
      .vid_hsync(vid_hsync),
      .vid_vsync(vid_vsync),
      .s_axil_awaddr(s_axil_landing_awaddr),
      .s_axil_awprot(s_axil_landing_awprot),
      .s_axil_awvalid(s_axil_landing_awvalid),
      .s_axil_awready(s_axil_landing_awready),
      .s_axil_wdata(s_axil_landing_wdata),
      .s_axil_wstrb(s_axil_landing_wstrb),
      .s_axil_wvalid(s_axil_landing_wvalid),
      .s_axil_wready(s_axil_landing_wready),
      .s_axil_bresp(s_axil_landing_bresp),
      .s_axil_bvalid(s_axil_landing_bvalid),
      .s_axil_bready(s_axil_landing_bready),
      .s_axil_araddr(s_axil_landing_araddr),
      .s_axil_arprot(s_axil_landing_arprot),
      .s_axil_arvalid(s_axil_landing_arvalid),
      .s_axil_arready(s_axil_landing_arready),
      .s_axil_rdata(s_axil_landing_rdata),
      .s_axil_rresp(s_axil_landing_rresp),
      .s_axil_rvalid(s_axil_landing_rvalid),
      .s_axil_rready(s_axil_landing_rready),
      .m_axi_awaddr(m_axi_results_awaddr),
      .m_axi_awlen(m_axi_results_awlen),
      .m_axi_awsize(m_axi_results_awsize),
      .m_axi_awburst(m_axi_results_awburst),
      .m_axi_awcache(m_axi_results_awcache),
      .m_axi_awprot(m_axi_results_awprot),
      .m_axi_awvalid(m_axi_results_awvalid),
      .m_axi_awready(m_axi_results_awready),
      .m_axi_wdata(m_axi_results_wdata),
      .m_axi_wstrb(m_axi_results_wstrb),
      .m_axi_wlast(m_axi_results_wlast),
      .m_axi_wvalid(m_axi_results_wvalid),
      .m_axi_wready(m_axi_results_wready),
      .m_axi_bresp(m_axi_results_bresp),
      .m_axi_bvalid(m_axi_results_bvalid),
      .m_axi_bready(m_axi_results_bready),
      .view_width(view_width),
      .view_height(view_height),
      .view_rgb_tdata(view_rgb_tdata),
      .view_rgb_tvalid(view_rgb_tvalid),
      .view_rgb_tuser(view_rgb_tuser),
      .view_rgb_tlast(view_rgb_tlast),
      .view_gray_tdata(view_gray_tdata),
      .view_gray_tvalid(view_gray_tvalid),
      .view_gray_tuser(view_gray_tuser),
      .view_gray_tlast(view_gray_tlast),
      .view_binary_tdata(view_binary_tdata),
      .view_binary_tvalid(view_binary_tvalid),
      .view_binary_tuser(view_binary_tuser),
      .view_binary_tlast(view_binary_tlast),
      .lidar_in(lidar_in),
      .lidar_drive_low(lidar_drive_low),
      .irq(irq)
  );

  display #(
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT),
      .DELAY     (DELAY),
      .FIFO_DEPTH(MONITOR_FIFO),
      .CLK_PER_US(CLK_PER_US)
  ) screen (
      .clk(clk),
      .rst(rst),
      .s_axil_awaddr(s_axil_display_awaddr),
      .s_axil_awprot(s_axil_display_awprot),
      .s_axil_awvalid(s_axil_display_awvalid),
      .s_axil_awready(s_axil_display_awready),
      .s_axil_wdata(s_axil_display_wdata),
      .s_axil_wstrb(s_axil_display_wstrb),
      .s_axil_wvalid(s_axil_display_wvalid),
      .s_axil_wready(s_axil_display_wready),
      .s_axil_bresp(s_axil_display_bresp),
      .s_axil_bvalid(s_axil_display_bvalid),
      .s_axil_bready(s_axil_display_bready),
      .s_axil_araddr(s_axil_display_araddr),
      .s_axil_arprot(s_axil_display_arprot),
      .s_axil_arvalid(s_axil_display_arvalid),
      .s_axil_arready(s_axil_display_arready),
      .s_axil_rdata(s_axil_display_rdata),
      .s_axil_rresp(s_axil_display_rresp),
      .s_axil_rvalid(s_axil_display_rvalid),
      .s_axil_rready(s_axil_display_rready),
      .view_width(view_width),
      .view_height(view_height),
      .view_rgb_tdata(view_rgb_tdata),
      .view_rgb_tvalid(view_rgb_tvalid),
      .view_rgb_tuser(view_rgb_tuser),
      .view_rgb_tlast(view_rgb_tlast),
      .view_gray_tdata(view_gray_tdata),
      .view_gray_tvalid(view_gray_tvalid),
      .view_gray_tuser(view_gray_tuser),
      .view_gray_tlast(view_gray_tlast),
      .view_binary_tdata(view_binary_tdata),
      .view_binary_tvalid(view_binary_tvalid),
      .view_binary_tuser(view_binary_tuser),
      .view_binary_tlast(view_binary_tlast),
      .pix_clk(pix_clk),
      .vid_de(vid_de),
      .vid_hsync(vid_hsync),
      .vid_vsync(vid_vsync),
      .out_data(out_data),
      .out_de(out_de),
      .out_hsync(out_hsync),
      .out_vsync(out_vsync),
      .pix_clk_locked(!hold),
      .monitor_present(monitor_present),
      .buttons(buttons),
      .switches(switches),
      .leds(leds),
      .source(picked),
      .pattern_move(pattern_move),
      .stored_base(stored_base),
      .stored_underflow(stored_underflow),
      .stored_error(stored_error)
  );

endmodule

`default_nettype wire
