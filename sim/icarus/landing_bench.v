// SPDX-License-Identifier: Apache-2.0
// landing_core in a simulator of four states: a camera, a LiDAR, memory and the register writes of a CPU around it, and
// a tap on each stream inside. Files are read and written in the working folder; sim/icarus/run.py makes and starts it.
//
// registers.txt holds what is written to the registers, in order: offset and value of each, in hexadecimal.
// A run that came to its end prints "clocks <n>" and ends events.txt with "end <ns>"; any other prints "fault: ...".
`timescale 1ns / 1ps
`default_nettype none

module landing_bench #(
    // A microsecond has this many clocks of clk: 100 on the board; fewer make the LiDAR's milliseconds cheap.
    parameter CLK_PER_US = 100,
    parameter MAX_WIDTH = 1280,
    parameter MAX_HEIGHT = 720,
    parameter H_FRONT = 110,
    parameter H_SYNC = 40,
    parameter H_BACK = 220,
    parameter LIDAR_ACQUISITION_US = 1000
);

  localparam [31:0] RING_ADDRESS = 32'h1000_0000;
  localparam real HALF_CLK_NS = 500.0 / CLK_PER_US;
  localparam real HALF_PIX_NS = HALF_CLK_NS / 0.7425;
  localparam RESET_CLOCKS = 16;
  localparam BUS_LIMIT_CLOCKS = 1000;
  localparam LIDAR_LIMIT_CLOCKS = 60_000 * CLK_PER_US;
  // Flushing borders and ccl takes a few lines, writing 256 objects 10 clocks each.
  localparam RECORD_LIMIT_CLOCKS = 200_000;
  localparam TAIL_CLOCKS = 1000;

  reg clk = 1'b0;
  reg pix_clk = 1'b0;
  reg rst = 1'b1;
  reg start = 1'b0;
  reg lidar_pin = 1'b0;
  integer events;
  integer clocks = 0;

  always #HALF_CLK_NS clk = !clk;
  always #HALF_PIX_NS pix_clk = !pix_clk;
  always @(posedge clk) clocks <= clocks + 1;
  initial events = $fopen("events.txt", "w");

  // ---- Camera.

  wire [23:0] vid_data;
  wire vid_de, vid_hsync, vid_vsync;
  wire [31:0] width, height, count, altitude_mm;
  wire camera_finished;

  camera #(
      .H_FRONT(H_FRONT),
      .H_SYNC (H_SYNC),
      .H_BACK (H_BACK)
  ) source (
      .pix_clk    (pix_clk),
      .start      (start),
      .events     (events),
      .vid_data   (vid_data),
      .vid_de     (vid_de),
      .vid_hsync  (vid_hsync),
      .vid_vsync  (vid_vsync),
      .width      (width),
      .height     (height),
      .count      (count),
      .altitude_mm(altitude_mm),
      .finished   (camera_finished)
  );

  // ---- landing_core.

  reg [11:0] awaddr = 12'd0;
  reg [31:0] wdata = 32'd0;
  reg awvalid = 1'b0;
  reg wvalid = 1'b0;
  reg bready = 1'b0;
  wire awready, wready, bvalid;
  wire [1:0] bresp;

  wire [31:0] m_awaddr;
  wire [7:0] m_awlen;
  wire [2:0] m_awsize;
  wire [1:0] m_awburst;
  wire [63:0] m_wdata;
  wire [7:0] m_wstrb;
  wire m_awvalid, m_awready, m_wlast, m_wvalid, m_wready, m_bvalid, m_bready;
  wire lidar_drive_low;

  landing_core #(
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT),
      .CLK_PER_US(CLK_PER_US)
  ) dut (
      .clk            (clk),
      .rst            (rst),
      .pix_clk        (pix_clk),
      .vid_data       (vid_data),
      .vid_de         (vid_de),
      .vid_hsync      (vid_hsync),
      .vid_vsync      (vid_vsync),
      .s_axil_awaddr  (awaddr),
      .s_axil_awprot  (3'd0),
      .s_axil_awvalid (awvalid),
      .s_axil_awready (awready),
      .s_axil_wdata   (wdata),
      .s_axil_wstrb   (4'hF),
      .s_axil_wvalid  (wvalid),
      .s_axil_wready  (wready),
      .s_axil_bresp   (bresp),
      .s_axil_bvalid  (bvalid),
      .s_axil_bready  (bready),
      .s_axil_araddr  (12'd0),
      .s_axil_arprot  (3'd0),
      .s_axil_arvalid (1'b0),
      .s_axil_arready (),
      .s_axil_rdata   (),
      .s_axil_rresp   (),
      .s_axil_rvalid  (),
      .s_axil_rready  (1'b0),
      .m_axi_awaddr   (m_awaddr),
      .m_axi_awlen    (m_awlen),
      .m_axi_awsize   (m_awsize),
      .m_axi_awburst  (m_awburst),
      .m_axi_awcache  (),
      .m_axi_awprot   (),
      .m_axi_awvalid  (m_awvalid),
      .m_axi_awready  (m_awready),
      .m_axi_wdata    (m_wdata),
      .m_axi_wstrb    (m_wstrb),
      .m_axi_wlast    (m_wlast),
      .m_axi_wvalid   (m_wvalid),
      .m_axi_wready   (m_wready),
      .m_axi_bresp    (2'b00),
      .m_axi_bvalid   (m_bvalid),
      .m_axi_bready   (m_bready),
      .lidar_in       (lidar_pin),
      .lidar_drive_low(lidar_drive_low),
      .irq            ()
  );

  // ---- Memory.

  wire [31:0] records;

  ring_memory #(
      .RING_ADDRESS(RING_ADDRESS)
  ) memory (
      .clk        (clk),
      .rst        (rst),
      .events     (events),
      .awaddr     (m_awaddr),
      .awlen      (m_awlen),
      .awsize     (m_awsize),
      .awburst    (m_awburst),
      .awvalid    (m_awvalid),
      .awready    (m_awready),
      .wdata      (m_wdata),
      .wstrb      (m_wstrb),
      .wlast      (m_wlast),
      .wvalid     (m_wvalid),
      .wready     (m_wready),
      .bvalid     (m_bvalid),
      .bready     (m_bready),
      .record_done(dut.frame_done),
      .ring_head  (dut.ring_head),
      .records    (records)
  );

  // ---- LiDAR, as sim/verilated/lidar_pin.h has it: 1 us a millimetre, over and over while its pin is held low.

  initial
    forever begin
      wait (lidar_drive_low === 1'b1);
      #(1000.0 * LIDAR_ACQUISITION_US);
      lidar_pin = 1'b1;
      #(1000.0 * altitude_mm);
      lidar_pin = 1'b0;
    end

  // ---- A tap on each stream. The beats of a stream of one bit are written as bytes.

  stage_tap #(
      .NAME ("rgb"),
      .BYTES(3)
  ) rgb_tap (
      .clk   (clk),
      .rst   (rst),
      .tdata (dut.rgb_tdata),
      .tvalid(dut.rgb_tvalid),
      .tready(dut.rgb_tready),
      .tuser (dut.rgb_tuser),
      .tlast (dut.rgb_tlast)
  );

  stage_tap #(
      .NAME ("gray"),
      .BYTES(1)
  ) gray_tap (
      .clk   (clk),
      .rst   (rst),
      .tdata (dut.chain.gray_tdata),
      .tvalid(dut.chain.gray_tvalid),
      .tready(dut.chain.gray_tready),
      .tuser (dut.chain.gray_tuser),
      .tlast (dut.chain.gray_tlast)
  );

  stage_tap #(
      .NAME ("smooth"),
      .BYTES(1)
  ) smooth_tap (
      .clk   (clk),
      .rst   (rst),
      .tdata (dut.chain.smooth_tdata),
      .tvalid(dut.chain.smooth_tvalid),
      .tready(dut.chain.smooth_tready),
      .tuser (dut.chain.smooth_tuser),
      .tlast (dut.chain.smooth_tlast)
  );

  stage_tap #(
      .NAME ("checked"),
      .BYTES(1)
  ) checked_tap (
      .clk   (clk),
      .rst   (rst),
      .tdata (dut.chain.checked_tdata),
      .tvalid(dut.chain.checked_tvalid),
      .tready(dut.chain.checked_tready),
      .tuser (dut.chain.checked_tuser),
      .tlast (dut.chain.checked_tlast)
  );

  stage_tap #(
      .NAME ("stats"),
      .BYTES(4)
  ) stats_tap (
      .clk   (clk),
      .rst   (rst),
      .tdata (dut.chain.stats_tdata),
      .tvalid(dut.chain.stats_tvalid),
      .tready(dut.chain.stats_tready),
      .tuser (dut.chain.stats_tuser),
      .tlast (dut.chain.stats_tlast)
  );

  stage_tap #(
      .NAME ("binary"),
      .BYTES(1)
  ) binary_tap (
      .clk   (clk),
      .rst   (rst),
      .tdata ({7'd0, dut.chain.binary_tdata}),
      .tvalid(dut.chain.binary_tvalid),
      .tready(dut.chain.binary_tready),
      .tuser (dut.chain.binary_tuser),
      .tlast (dut.chain.binary_tlast)
  );

  stage_tap #(
      .NAME ("eroded"),
      .BYTES(1)
  ) eroded_tap (
      .clk   (clk),
      .rst   (rst),
      .tdata ({7'd0, dut.chain.eroded_tdata}),
      .tvalid(dut.chain.eroded_tvalid),
      .tready(dut.chain.eroded_tready),
      .tuser (dut.chain.eroded_tuser),
      .tlast (dut.chain.eroded_tlast)
  );

  stage_tap #(
      .NAME ("median"),
      .BYTES(1)
  ) median_tap (
      .clk   (clk),
      .rst   (rst),
      .tdata ({7'd0, dut.chain.median_tdata}),
      .tvalid(dut.chain.median_tvalid),
      .tready(dut.chain.median_tready),
      .tuser (dut.chain.median_tuser),
      .tlast (dut.chain.median_tlast)
  );

  stage_tap #(
      .NAME ("dilated"),
      .BYTES(1)
  ) dilated_tap (
      .clk   (clk),
      .rst   (rst),
      .tdata ({7'd0, dut.dilated_tdata}),
      .tvalid(dut.dilated_tvalid),
      .tready(dut.dilated_tready),
      .tuser (dut.dilated_tuser),
      .tlast (dut.dilated_tlast)
  );

  stage_tap #(
      .NAME ("objects"),
      .BYTES(64)
  ) objects_tap (
      .clk   (clk),
      .rst   (rst),
      .tdata (dut.objects_tdata),
      .tvalid(dut.objects_tvalid),
      .tready(dut.objects_tready),
      .tuser (dut.objects_tuser),
      .tlast (dut.objects_tlast)
  );

  // ---- The run.

  integer registers, fields, waited;
  reg [31:0] offset;
  reg [31:0] value;
  reg        address_left;
  reg        data_left;

  task next_clock;
    input [31:0] limit;
    begin
      @(posedge clk);
      waited = waited + 1;
      if (waited > limit) begin
        $display("fault: landing_core does not answer at %0d ns", $time);
        $finish;
      end
    end
  endtask

  task write_register;
    begin
      awaddr <= offset[11:0];
      wdata <= value;
      awvalid <= 1'b1;
      wvalid <= 1'b1;
      bready <= 1'b1;
      address_left = 1'b1;
      data_left = 1'b1;
      waited = 0;
      while (address_left || data_left) begin
        next_clock(BUS_LIMIT_CLOCKS);
        if (awready) begin
          address_left = 1'b0;
          awvalid <= 1'b0;
        end
        if (wready) begin
          data_left = 1'b0;
          wvalid <= 1'b0;
        end
      end
      while (bvalid !== 1'b1) next_clock(BUS_LIMIT_CLOCKS);
      bready <= 1'b0;
      if (bresp !== 2'b00) begin
        $display("fault: writing register %h was answered %b", offset, bresp);
        $finish;
      end
    end
  endtask

  initial begin
    repeat (RESET_CLOCKS) @(posedge clk);
    rst <= 1'b0;
    registers = $fopen("registers.txt", "r");
    fields = $fscanf(registers, "%h %h", offset, value);
    while (fields == 2) begin
      write_register;
      fields = $fscanf(registers, "%h %h", offset, value);
    end
    // The camera waits for the first reading, as a pilot does.
    waited = 0;
    while (!dut.lidar_valid) next_clock(LIDAR_LIMIT_CLOCKS);
    start = 1'b1;
    wait (camera_finished);
    // A record that does not come is for the comparison to tell.
    waited = 0;
    while (records < count && waited < RECORD_LIMIT_CLOCKS) begin
      @(posedge clk);
      waited = waited + 1;
    end
    repeat (TAIL_CLOCKS) @(posedge clk);
    $fwrite(events, "end %0d\n", $time);
    $display("clocks %0d", clocks);
    $finish;
  end

endmodule

`default_nettype wire
