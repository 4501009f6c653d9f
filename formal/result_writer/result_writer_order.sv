// SPDX-License-Identifier: Apache-2.0
// result_writer: a frame number is written only after everything else of its frame was answered OKAY.
`default_nettype none

module result_writer_order #(
    parameter MAX_OBJECTS = 2,
    parameter MAX_OUTSTANDING = 2
) (
    input wire clk,
    input wire rst,
    input wire [31:0] frame_number,
    input wire s_axis_tvalid,
    input wire s_axis_tuser,
    input wire s_axis_tlast,
    input wire m_axi_awready,
    input wire m_axi_wready,
    input wire [1:0] m_axi_bresp,
    input wire m_axi_bvalid
);

  // Contents stand still, so that what is proven is the order; each word of an object is another.
  wire [31:0] ring_base = 32'h1000_0000;
  wire [63:0] frame_start_us = 0;
  wire [15:0] frame_width = 0;
  wire [15:0] frame_height = 0;
  wire [8:0] threshold_factor = 0;
  wire [31:0] min_area = 0;
  wire thresholds_missing = 0;
  wire thresholds_stale = 0;
  wire [31:0] scan_time_us = 0;
  wire [31:0] altitude_mm = 0;
  wire [31:0] altitude_age_us = 0;
  wire altitude_valid = 0;
  wire [31:0] frames_malformed = 0;
  wire [31:0] frames_overflow = 0;
  wire [511:0] s_axis_tdata = {64'd8, 64'd7, 64'd6, 64'd5, 64'd4, 64'd3, 64'd2, 64'd1};
  wire s_axis_tready;
  wire [31:0] m_axi_awaddr;
  wire [7:0] m_axi_awlen;
  wire [2:0] m_axi_awsize;
  wire [1:0] m_axi_awburst;
  wire [3:0] m_axi_awcache;
  wire [2:0] m_axi_awprot;
  wire m_axi_awvalid;
  wire [63:0] m_axi_wdata;
  wire [7:0] m_axi_wstrb;
  wire m_axi_wlast;
  wire m_axi_wvalid;
  wire m_axi_bready;
  wire [7:0] ring_head_index;
  wire ring_head_valid;
  wire [31:0] written_frame_number;
  wire [31:0] frames_unwritten;
  wire frame_done;
  wire axi_error;

  result_writer #(
      .MAX_OBJECTS    (MAX_OBJECTS),
      .MAX_OUTSTANDING(MAX_OUTSTANDING)
  ) dut (.*);

  power_up start (.*);

  wire starts;
  wire [7:0] beat;
  wire [3:0] unanswered;

  axi_write_rules rules (
      .clk       (clk),
      .rst       (rst),
      .awaddr    (m_axi_awaddr),
      .awlen     (m_axi_awlen),
      .awsize    (m_axi_awsize),
      .awburst   (m_axi_awburst),
      .awvalid   (m_axi_awvalid),
      .awready   (m_axi_awready),
      .wdata     (m_axi_wdata),
      .wstrb     (m_axi_wstrb),
      .wlast     (m_axi_wlast),
      .wvalid    (m_axi_wvalid),
      .wready    (m_axi_wready),
      .bvalid    (m_axi_bvalid),
      .bready    (m_axi_bready),
      .starts    (starts),
      .beat      (beat),
      .unanswered(unanswered)
  );

  // What the master does, read off its bus: the address and the first data of a burst are valid together.
  wire zeroes = starts && m_axi_awlen == 8'd0 && m_axi_wdata == 64'd0;
  wire publishes = starts && m_axi_awlen == 8'd0 && m_axi_wdata != 64'd0;
  wire heads = starts && m_axi_awlen == 8'd6;
  wire writes_object = starts && m_axi_awlen == 8'd7;

  reg known = 1'b0;
  reg open;       // the frame number of a buffer was set to 0, and the frame is not published or given up
  reg headed;     // ... and its header was sent
  reg failed;     // ... and a response said no
  reg failed_before;  // a burst that is begun in the clock of the response still goes out
  reg published;  // ... and its frame number was sent
  reg [31:0] base;
  reg [1:0] objects;
  reg [31:0] number;
  wire take = s_axis_tvalid && s_axis_tready;
  wire no = m_axi_bvalid && m_axi_bresp[1];

  // Frames are counted from 1.
  always @* assume (frame_number != 32'd0);

  always @(posedge clk) begin
    known <= 1'b1;
    if (take && s_axis_tlast) number <= frame_number;
    // Also while the frame number of the next one is set to 0.
    if (frame_done || axi_error) open <= 1'b0;
    if (zeroes) begin
      {open, headed, failed, published} <= 4'b1000;
      base    <= m_axi_awaddr - 32'd56;
      objects <= 2'd0;
    end
    if (heads) headed <= 1'b1;
    if (publishes) published <= 1'b1;
    if (writes_object) objects <= objects + 2'd1;
    failed_before <= failed && !zeroes;
    if (no) failed <= 1'b1;
    if (rst) {open, headed, failed, failed_before, published} <= 5'd0;
  end

  always @(posedge clk)
    if (known && !rst) begin
      // The frame number goes to 0 first, and nothing of the frame before is then under way.
      if (zeroes) assert (unanswered == 4'd0 && m_axi_awaddr[11:0] == 12'd56);
      if (writes_object) begin
        assert (open && !headed && !failed_before && !published);
        assert (objects < MAX_OBJECTS);
        assert (m_axi_awaddr == base + 32'd64 + {24'd0, objects, 6'd0});
      end
      if (heads) begin
        assert (open && !headed && !failed_before && !published);
        assert (m_axi_awaddr == base);
      end
      if (publishes) begin
        assert (open && headed && !failed && !published);
        assert (unanswered == 4'd0);
        assert (m_axi_awaddr == base + 32'd56);
        assert (m_axi_wdata == {number, 32'd0});
      end
      // The words of an object, in order.
      if (m_axi_wvalid && m_axi_awlen == 8'd7) assert (m_axi_wdata == {61'd0, beat[2:0]} + 64'd1);
      // What the processor is told.
      if (frame_done) begin
        assert (published && !failed && unanswered == 4'd0);
        assert (written_frame_number == number && ring_head_valid);
      end
      assert (!(frame_done && axi_error));
    end

endmodule

`default_nettype wire
