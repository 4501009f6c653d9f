// SPDX-License-Identifier: Apache-2.0
// Touchdown on the Arty Z7-20, and the only file with cells of a vendor: HDMI receiver and transmitter (Digilent's dvi2rgb
// and rgb2dvi), processor (zynq_ps, a block design that scripts/vivado/zynq_ps.tcl makes), clocks and pins. All else is
// board_video. docs/board.md says what is wired to which pin; constraints/arty_z7.xdc says it to Vivado.
//
// Clocks: clk, 100 MHz, and clk_200, from the processor; camera_clk from the receiver; local_clk, 74.25 MHz, from clk by
// an MMCM whose output is 100 / 5 * 37.125 / 10 MHz. The clock switch pix_clk_switch makes pix_clk of the last two. The
// receiver is told to leave out its own global buffer (kAddBUFG), since the switch is one.
// The 125 MHz at pin H16 are not used: on sister boards they come from the Ethernet chip, and stop while it has no cable.
// clk is behind a global buffer, so that the MMCM may lie anywhere: the one next to the pins of the HDMI output belongs to
// the transmitter. It is in reset until the processor has released the logic, since before that clk does not run.
// Latency, throughput, border, rounding, overflow: those of board_video.
// Limits: 1280x720 at 60 Hz; rgb2dvi and dvi2rgb are built for 60 to 120 MHz (kClkRange).

`default_nettype none

module arty_z7_top (
    input  wire       hdmi_rx_clk_p,
    input  wire       hdmi_rx_clk_n,
    input  wire [2:0] hdmi_rx_d_p,
    input  wire [2:0] hdmi_rx_d_n,
    output wire       hdmi_rx_hpd,
    inout  wire       hdmi_rx_scl,
    inout  wire       hdmi_rx_sda,

    output wire       hdmi_tx_clk_p,
    output wire       hdmi_tx_clk_n,
    output wire [2:0] hdmi_tx_d_p,
    output wire [2:0] hdmi_tx_d_n,
    input  wire       hdmi_tx_hpdn,

    input  wire autopilot_rxd,
    output wire autopilot_txd,
    input  wire ground_rxd,
    output wire ground_txd,
    input  wire lidar_mode,
    output wire lidar_pull,

    input  wire [3:0] btn,
    input  wire [1:0] sw,
    output wire [3:0] led,

    inout wire [14:0] DDR_addr,
    inout wire [ 2:0] DDR_ba,
    inout wire        DDR_cas_n,
    inout wire        DDR_ck_n,
    inout wire        DDR_ck_p,
    inout wire        DDR_cke,
    inout wire        DDR_cs_n,
    inout wire [ 3:0] DDR_dm,
    inout wire [31:0] DDR_dq,
    inout wire [ 3:0] DDR_dqs_n,
    inout wire [ 3:0] DDR_dqs_p,
    inout wire        DDR_odt,
    inout wire        DDR_ras_n,
    inout wire        DDR_reset_n,
    inout wire        DDR_we_n,
    inout wire        FIXED_IO_ddr_vrn,
    inout wire        FIXED_IO_ddr_vrp,
    inout wire [53:0] FIXED_IO_mio,
    inout wire        FIXED_IO_ps_clk,
    inout wire        FIXED_IO_ps_porb,
    inout wire        FIXED_IO_ps_srstb
);

  // ---- Processor.

  wire        clk;
  wire        clk_200;
  wire        ps_reset_n;
  wire        irq;
  wire [31:0] axil_landing_awaddr;
  wire [ 2:0] axil_landing_awprot;
  wire        axil_landing_awvalid;
  wire        axil_landing_awready;
  wire [31:0] axil_landing_wdata;
  wire [ 3:0] axil_landing_wstrb;
  wire        axil_landing_wvalid;
  wire        axil_landing_wready;
  wire [ 1:0] axil_landing_bresp;
  wire        axil_landing_bvalid;
  wire        axil_landing_bready;
  wire [31:0] axil_landing_araddr;
  wire [ 2:0] axil_landing_arprot;
  wire        axil_landing_arvalid;
  wire        axil_landing_arready;
  wire [31:0] axil_landing_rdata;
  wire [ 1:0] axil_landing_rresp;
  wire        axil_landing_rvalid;
  wire        axil_landing_rready;
  wire [31:0] axil_display_awaddr;
  wire [ 2:0] axil_display_awprot;
  wire        axil_display_awvalid;
  wire        axil_display_awready;
  wire [31:0] axil_display_wdata;
  wire [ 3:0] axil_display_wstrb;
  wire        axil_display_wvalid;
  wire        axil_display_wready;
  wire [ 1:0] axil_display_bresp;
  wire        axil_display_bvalid;
  wire        axil_display_bready;
  wire [31:0] axil_display_araddr;
  wire [ 2:0] axil_display_arprot;
  wire        axil_display_arvalid;
  wire        axil_display_arready;
  wire [31:0] axil_display_rdata;
  wire [ 1:0] axil_display_rresp;
  wire        axil_display_rvalid;
  wire        axil_display_rready;
  wire [31:0] axi_results_awaddr;
  wire [ 7:0] axi_results_awlen;
  wire [ 2:0] axi_results_awsize;
  wire [ 1:0] axi_results_awburst;
  wire [ 3:0] axi_results_awcache;
  wire [ 2:0] axi_results_awprot;
  wire        axi_results_awvalid;
  wire        axi_results_awready;
  wire [63:0] axi_results_wdata;
  wire [ 7:0] axi_results_wstrb;
  wire        axi_results_wlast;
  wire        axi_results_wvalid;
  wire        axi_results_wready;
  wire [ 1:0] axi_results_bresp;
  wire        axi_results_bvalid;
  wire        axi_results_bready;
  wire [31:0] axi_frames_araddr;
  wire [ 7:0] axi_frames_arlen;
  wire [ 2:0] axi_frames_arsize;
  wire [ 1:0] axi_frames_arburst;
  wire [ 3:0] axi_frames_arcache;
  wire [ 2:0] axi_frames_arprot;
  wire        axi_frames_arvalid;
  wire        axi_frames_arready;
  wire [63:0] axi_frames_rdata;
  wire [ 1:0] axi_frames_rresp;
  wire        axi_frames_rlast;
  wire        axi_frames_rvalid;
  wire        axi_frames_rready;

  zynq_ps zynq_ps (
      .DDR_addr(DDR_addr),
      .DDR_ba(DDR_ba),
      .DDR_cas_n(DDR_cas_n),
      .DDR_ck_n(DDR_ck_n),
      .DDR_ck_p(DDR_ck_p),
      .DDR_cke(DDR_cke),
      .DDR_cs_n(DDR_cs_n),
      .DDR_dm(DDR_dm),
      .DDR_dq(DDR_dq),
      .DDR_dqs_n(DDR_dqs_n),
      .DDR_dqs_p(DDR_dqs_p),
      .DDR_odt(DDR_odt),
      .DDR_ras_n(DDR_ras_n),
      .DDR_reset_n(DDR_reset_n),
      .DDR_we_n(DDR_we_n),
      .FIXED_IO_ddr_vrn(FIXED_IO_ddr_vrn),
      .FIXED_IO_ddr_vrp(FIXED_IO_ddr_vrp),
      .FIXED_IO_mio(FIXED_IO_mio),
      .FIXED_IO_ps_clk(FIXED_IO_ps_clk),
      .FIXED_IO_ps_porb(FIXED_IO_ps_porb),
      .FIXED_IO_ps_srstb(FIXED_IO_ps_srstb),
      .clk(clk),
      .clk_200(clk_200),
      .reset_n(ps_reset_n),
      .m_axil_landing_awaddr(axil_landing_awaddr),
      .m_axil_landing_awprot(axil_landing_awprot),
      .m_axil_landing_awvalid(axil_landing_awvalid),
      .m_axil_landing_awready(axil_landing_awready),
      .m_axil_landing_wdata(axil_landing_wdata),
      .m_axil_landing_wstrb(axil_landing_wstrb),
      .m_axil_landing_wvalid(axil_landing_wvalid),
      .m_axil_landing_wready(axil_landing_wready),
      .m_axil_landing_bresp(axil_landing_bresp),
      .m_axil_landing_bvalid(axil_landing_bvalid),
      .m_axil_landing_bready(axil_landing_bready),
      .m_axil_landing_araddr(axil_landing_araddr),
      .m_axil_landing_arprot(axil_landing_arprot),
      .m_axil_landing_arvalid(axil_landing_arvalid),
      .m_axil_landing_arready(axil_landing_arready),
      .m_axil_landing_rdata(axil_landing_rdata),
      .m_axil_landing_rresp(axil_landing_rresp),
      .m_axil_landing_rvalid(axil_landing_rvalid),
      .m_axil_landing_rready(axil_landing_rready),
      .m_axil_display_awaddr(axil_display_awaddr),
      .m_axil_display_awprot(axil_display_awprot),
      .m_axil_display_awvalid(axil_display_awvalid),
      .m_axil_display_awready(axil_display_awready),
      .m_axil_display_wdata(axil_display_wdata),
      .m_axil_display_wstrb(axil_display_wstrb),
      .m_axil_display_wvalid(axil_display_wvalid),
      .m_axil_display_wready(axil_display_wready),
      .m_axil_display_bresp(axil_display_bresp),
      .m_axil_display_bvalid(axil_display_bvalid),
      .m_axil_display_bready(axil_display_bready),
      .m_axil_display_araddr(axil_display_araddr),
      .m_axil_display_arprot(axil_display_arprot),
      .m_axil_display_arvalid(axil_display_arvalid),
      .m_axil_display_arready(axil_display_arready),
      .m_axil_display_rdata(axil_display_rdata),
      .m_axil_display_rresp(axil_display_rresp),
      .m_axil_display_rvalid(axil_display_rvalid),
      .m_axil_display_rready(axil_display_rready),
      .s_axi_results_awaddr(axi_results_awaddr),
      .s_axi_results_awlen(axi_results_awlen),
      .s_axi_results_awsize(axi_results_awsize),
      .s_axi_results_awburst(axi_results_awburst),
      .s_axi_results_awcache(axi_results_awcache),
      .s_axi_results_awprot(axi_results_awprot),
      .s_axi_results_awvalid(axi_results_awvalid),
      .s_axi_results_awready(axi_results_awready),
      .s_axi_results_wdata(axi_results_wdata),
      .s_axi_results_wstrb(axi_results_wstrb),
      .s_axi_results_wlast(axi_results_wlast),
      .s_axi_results_wvalid(axi_results_wvalid),
      .s_axi_results_wready(axi_results_wready),
      .s_axi_results_bresp(axi_results_bresp),
      .s_axi_results_bvalid(axi_results_bvalid),
      .s_axi_results_bready(axi_results_bready),
      .s_axi_frames_araddr(axi_frames_araddr),
      .s_axi_frames_arlen(axi_frames_arlen),
      .s_axi_frames_arsize(axi_frames_arsize),
      .s_axi_frames_arburst(axi_frames_arburst),
      .s_axi_frames_arcache(axi_frames_arcache),
      .s_axi_frames_arprot(axi_frames_arprot),
      .s_axi_frames_arvalid(axi_frames_arvalid),
      .s_axi_frames_arready(axi_frames_arready),
      .s_axi_frames_rdata(axi_frames_rdata),
      .s_axi_frames_rresp(axi_frames_rresp),
      .s_axi_frames_rlast(axi_frames_rlast),
      .s_axi_frames_rvalid(axi_frames_rvalid),
      .s_axi_frames_rready(axi_frames_rready),
      .irq(irq),
      .uart0_rxd(autopilot_rxd),
      .uart0_txd(autopilot_txd),
      .uart1_rxd(ground_rxd),
      .uart1_txd(ground_txd)
  );

  // ---- Reset, from a flip-flop of clk.

  wire rst_in_clk;
  reg  rst_reg;

  reset_sync reset (
      .clk    (clk),
      .rst_in (!ps_reset_n),
      .rst_out(rst_in_clk)
  );

  always @(posedge clk) rst_reg <= rst_in_clk;

  // ---- Clocks of pixels.

  wire local_feedback;
  wire local_clk;
  wire local_locked;
  wire camera_clk;
  wire camera_locked;
  wire pix_clk;
  wire select_local;
  wire ignore_camera;
  wire ignore_local;

  MMCME2_ADV #(
      .BANDWIDTH       ("OPTIMIZED"),
      .COMPENSATION    ("INTERNAL"),
      .CLKIN1_PERIOD   (10.0),
      .DIVCLK_DIVIDE   (5),
      .CLKFBOUT_MULT_F (37.125),
      .CLKOUT0_DIVIDE_F(10.0)
  ) local_mmcm (
      .CLKIN1  (clk),
      .CLKIN2  (1'b0),
      .CLKINSEL(1'b1),
      .CLKFBIN (local_feedback),
      .CLKFBOUT(local_feedback),
      .CLKOUT0 (local_clk),
      .LOCKED  (local_locked),
      .RST     (rst_reg),
      .PWRDWN  (1'b0),
      .DADDR   (7'd0),
      .DCLK    (1'b0),
      .DEN     (1'b0),
      .DI      (16'd0),
      .DWE     (1'b0),
      .PSCLK   (1'b0),
      .PSEN    (1'b0),
      .PSINCDEC(1'b0)
  );

  BUFGCTRL #(
      .INIT_OUT    (0),
      .PRESELECT_I0("TRUE"),
      .PRESELECT_I1("FALSE")
  ) pix_clk_switch (
      .I0     (camera_clk),
      .I1     (local_clk),
      .S0     (!select_local),
      .S1     (select_local),
      .CE0    (1'b1),
      .CE1    (1'b1),
      .IGNORE0(ignore_camera),
      .IGNORE1(ignore_local),
      .O      (pix_clk)
  );

  // ---- HDMI in. The IP orders the bytes {R, B, G}.

  wire [23:0] camera_rbg;
  wire        camera_de;
  wire        camera_hsync;
  wire        camera_vsync;
  wire scl_in, scl_out, scl_release;
  wire sda_in, sda_out, sda_release;

  IOBUF hdmi_rx_scl_buffer (
      .I (scl_out),
      .O (scl_in),
      .T (scl_release),
      .IO(hdmi_rx_scl)
  );

  IOBUF hdmi_rx_sda_buffer (
      .I (sda_out),
      .O (sda_in),
      .T (sda_release),
      .IO(hdmi_rx_sda)
  );

  dvi2rgb_0 dvi2rgb_0 (
      .TMDS_Clk_p   (hdmi_rx_clk_p),
      .TMDS_Clk_n   (hdmi_rx_clk_n),
      .TMDS_Data_p  (hdmi_rx_d_p),
      .TMDS_Data_n  (hdmi_rx_d_n),
      .RefClk       (clk_200),
      .aRst         (rst_reg),
      .vid_pData    (camera_rbg),
      .vid_pVDE     (camera_de),
      .vid_pHSync   (camera_hsync),
      .vid_pVSync   (camera_vsync),
      .PixelClk     (camera_clk),
      .aPixelClkLckd(camera_locked),
      .SDA_I        (sda_in),
      .SDA_O        (sda_out),
      .SDA_T        (sda_release),
      .SCL_I        (scl_in),
      .SCL_O        (scl_out),
      .SCL_T        (scl_release),
      .pRst         (1'b0)
  );

  // A camera that sees the line rise reads what the receiver can do, and starts.
  assign hdmi_rx_hpd = !rst_reg;

  // ---- LiDAR. Its line comes in direct; another pin pulls it low through 1 kOhm or leaves it alone, and never drives it
  // high. One pin for both would be deaf: while it pulls, it holds its own end of the resistor low.

  wire lidar_drive_low;

  OBUFT lidar_buffer (
      .I(1'b0),
      .O(lidar_pull),
      .T(!lidar_drive_low)
  );

  // ---- All that is not the vendor's.

  wire tx_reset;
  wire [23:0] out_data;
  wire out_de;
  wire out_hsync;
  wire out_vsync;

  // The registers are 4 KiB each; the block design decodes what lies above.
  wire        unused_address = &{
    1'b0, axil_landing_awaddr[31:12], axil_landing_araddr[31:12], axil_display_awaddr[31:12], axil_display_araddr[31:12]
  };

  board_video board (
      .clk(clk),
      .rst(rst_reg),
      .pix_clk(pix_clk),
      .camera_data({camera_rbg[23:16], camera_rbg[7:0], camera_rbg[15:8]}),
      .camera_de(camera_de),
      .camera_hsync(camera_hsync),
      .camera_vsync(camera_vsync),
      .camera_locked(camera_locked),
      .local_locked(local_locked),
      .select_local(select_local),
      .ignore_camera(ignore_camera),
      .ignore_local(ignore_local),
      .tx_reset(tx_reset),
      .out_data(out_data),
      .out_de(out_de),
      .out_hsync(out_hsync),
      .out_vsync(out_vsync),
      .monitor_present(!hdmi_tx_hpdn),
      .s_axil_landing_awaddr(axil_landing_awaddr[11:0]),
      .s_axil_landing_awprot(axil_landing_awprot),
      .s_axil_landing_awvalid(axil_landing_awvalid),
      .s_axil_landing_awready(axil_landing_awready),
      .s_axil_landing_wdata(axil_landing_wdata),
      .s_axil_landing_wstrb(axil_landing_wstrb),
      .s_axil_landing_wvalid(axil_landing_wvalid),
      .s_axil_landing_wready(axil_landing_wready),
      .s_axil_landing_bresp(axil_landing_bresp),
      .s_axil_landing_bvalid(axil_landing_bvalid),
      .s_axil_landing_bready(axil_landing_bready),
      .s_axil_landing_araddr(axil_landing_araddr[11:0]),
      .s_axil_landing_arprot(axil_landing_arprot),
      .s_axil_landing_arvalid(axil_landing_arvalid),
      .s_axil_landing_arready(axil_landing_arready),
      .s_axil_landing_rdata(axil_landing_rdata),
      .s_axil_landing_rresp(axil_landing_rresp),
      .s_axil_landing_rvalid(axil_landing_rvalid),
      .s_axil_landing_rready(axil_landing_rready),
      .s_axil_display_awaddr(axil_display_awaddr[11:0]),
      .s_axil_display_awprot(axil_display_awprot),
      .s_axil_display_awvalid(axil_display_awvalid),
      .s_axil_display_awready(axil_display_awready),
      .s_axil_display_wdata(axil_display_wdata),
      .s_axil_display_wstrb(axil_display_wstrb),
      .s_axil_display_wvalid(axil_display_wvalid),
      .s_axil_display_wready(axil_display_wready),
      .s_axil_display_bresp(axil_display_bresp),
      .s_axil_display_bvalid(axil_display_bvalid),
      .s_axil_display_bready(axil_display_bready),
      .s_axil_display_araddr(axil_display_araddr[11:0]),
      .s_axil_display_arprot(axil_display_arprot),
      .s_axil_display_arvalid(axil_display_arvalid),
      .s_axil_display_arready(axil_display_arready),
      .s_axil_display_rdata(axil_display_rdata),
      .s_axil_display_rresp(axil_display_rresp),
      .s_axil_display_rvalid(axil_display_rvalid),
      .s_axil_display_rready(axil_display_rready),
      .m_axi_results_awaddr(axi_results_awaddr),
      .m_axi_results_awlen(axi_results_awlen),
      .m_axi_results_awsize(axi_results_awsize),
      .m_axi_results_awburst(axi_results_awburst),
      .m_axi_results_awcache(axi_results_awcache),
      .m_axi_results_awprot(axi_results_awprot),
      .m_axi_results_awvalid(axi_results_awvalid),
      .m_axi_results_awready(axi_results_awready),
      .m_axi_results_wdata(axi_results_wdata),
      .m_axi_results_wstrb(axi_results_wstrb),
      .m_axi_results_wlast(axi_results_wlast),
      .m_axi_results_wvalid(axi_results_wvalid),
      .m_axi_results_wready(axi_results_wready),
      .m_axi_results_bresp(axi_results_bresp),
      .m_axi_results_bvalid(axi_results_bvalid),
      .m_axi_results_bready(axi_results_bready),
      .m_axi_frames_araddr(axi_frames_araddr),
      .m_axi_frames_arlen(axi_frames_arlen),
      .m_axi_frames_arsize(axi_frames_arsize),
      .m_axi_frames_arburst(axi_frames_arburst),
      .m_axi_frames_arcache(axi_frames_arcache),
      .m_axi_frames_arprot(axi_frames_arprot),
      .m_axi_frames_arvalid(axi_frames_arvalid),
      .m_axi_frames_arready(axi_frames_arready),
      .m_axi_frames_rdata(axi_frames_rdata),
      .m_axi_frames_rresp(axi_frames_rresp),
      .m_axi_frames_rlast(axi_frames_rlast),
      .m_axi_frames_rvalid(axi_frames_rvalid),
      .m_axi_frames_rready(axi_frames_rready),
      .lidar_in(lidar_mode),
      .lidar_drive_low(lidar_drive_low),
      .buttons(btn),
      .switches(sw),
      .leds(led),
      .irq(irq)
  );

  // ---- HDMI out, in the same order of bytes.

  rgb2dvi_0 rgb2dvi_0 (
      .TMDS_Clk_p (hdmi_tx_clk_p),
      .TMDS_Clk_n (hdmi_tx_clk_n),
      .TMDS_Data_p(hdmi_tx_d_p),
      .TMDS_Data_n(hdmi_tx_d_n),
      .aRst       (tx_reset),
      .vid_pData  ({out_data[23:16], out_data[7:0], out_data[15:8]}),
      .vid_pVDE   (out_de),
      .vid_pHSync (out_hsync),
      .vid_pVSync (out_vsync),
      .PixelClk   (pix_clk)
  );

endmodule

`default_nettype wire
