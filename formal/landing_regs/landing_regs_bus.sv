// SPDX-License-Identifier: Apache-2.0
// landing_regs: the rules of AXI4-Lite; a request is answered in one clock; what a read gives; no event is lost.
`default_nettype none

module landing_regs_bus (
    input wire clk,
    input wire rst,
    input wire [11:0] s_axil_awaddr,
    input wire [2:0] s_axil_awprot,
    input wire s_axil_awvalid,
    input wire [31:0] s_axil_wdata,
    input wire [3:0] s_axil_wstrb,
    input wire s_axil_wvalid,
    input wire s_axil_bready,
    input wire [11:0] s_axil_araddr,
    input wire [2:0] s_axil_arprot,
    input wire s_axil_arvalid,
    input wire s_axil_rready,
    input wire [7:0] ring_info_buffers,
    input wire [15:0] ring_info_max_objects,
    input wire [7:0] ring_head_index,
    input wire ring_head_valid,
    input wire [31:0] frame_number_number,
    input wire irq_status_frame_done_set,
    input wire irq_status_frame_malformed_set,
    input wire irq_status_frame_overflow_set,
    input wire irq_status_axi_error_set,
    input wire irq_status_lidar_fault_set,
    input wire [31:0] frames_seen_count,
    input wire [31:0] frames_malformed_count,
    input wire [31:0] frames_overflow_count,
    input wire [31:0] frames_unwritten_count,
    input wire [15:0] measured_size_width,
    input wire [15:0] measured_size_height,
    input wire [31:0] lidar_distance_mm,
    input wire [31:0] lidar_age_us,
    input wire lidar_status_valid,
    input wire lidar_status_timeout,
    input wire lidar_status_too_long,
    input wire lidar_status_too_short,
    input wire [31:0] time_lo_us,
    input wire [31:0] time_hi_us,
    input wire features_display
);

  wire s_axil_awready;
  wire s_axil_wready;
  wire [1:0] s_axil_bresp;
  wire s_axil_bvalid;
  wire s_axil_arready;
  wire [31:0] s_axil_rdata;
  wire [1:0] s_axil_rresp;
  wire s_axil_rvalid;
  wire ctrl_enable;
  wire ctrl_dark_is_one;
  wire ctrl_label_zeros;
  wire [15:0] frame_size_width;
  wire [15:0] frame_size_height;
  wire [8:0] threshold_factor;
  wire [7:0] threshold_flat_limit;
  wire [31:0] min_area_pixels;
  wire [31:0] ring_base_address;
  wire lidar_ctrl_enable;
  wire irq;

  landing_regs dut (.*);

  power_up start (.*);

  wire [3:0] addresses_open, data_open, reads_open;

  axil_rules rules (
      .clk           (clk),
      .rst           (rst),
      .awvalid       (s_axil_awvalid),
      .awready       (s_axil_awready),
      .wvalid        (s_axil_wvalid),
      .wready        (s_axil_wready),
      .bresp         (s_axil_bresp),
      .bvalid        (s_axil_bvalid),
      .bready        (s_axil_bready),
      .arvalid       (s_axil_arvalid),
      .arready       (s_axil_arready),
      .rdata         (s_axil_rdata),
      .rresp         (s_axil_rresp),
      .rvalid        (s_axil_rvalid),
      .rready        (s_axil_rready),
      .addresses_open(addresses_open),
      .data_open     (data_open),
      .reads_open    (reads_open)
  );

  // Offsets in words; docs/registers.md.
  localparam [9:0] IRQ_STATUS = 10'h0A;
  localparam [9:0] IRQ_ENABLE = 10'h0B;
  localparam [9:0] SCRATCH = 10'h17;
  localparam [9:0] LAST = 10'h18;

  // What the master has asked for, in order of asking; at most one of each waits.
  reg known = 1'b0, was_rst;
  reg [9:0] aw_word, ar_word;
  reg [31:0] w_data;
  reg [3:0] w_strobe;
  reg address_waits, data_waits;
  wire write_now = address_waits && data_waits && (!s_axil_bvalid || s_axil_bready);
  reg [31:0] scratch, scratch_at_read;
  reg [4:0] status, status_at_read, enable;
  wire [4:0] events = {
    irq_status_lidar_fault_set,
    irq_status_axi_error_set,
    irq_status_frame_overflow_set,
    irq_status_frame_malformed_set,
    irq_status_frame_done_set
  };
  reg write_known, expect_irq;
  integer i;

  always @(posedge clk) begin
    known   <= 1'b1;
    was_rst <= rst;
    expect_irq <= |(status & enable);
    if (s_axil_awvalid && s_axil_awready) {address_waits, aw_word} <= {1'b1, s_axil_awaddr[11:2]};
    if (s_axil_wvalid && s_axil_wready) {data_waits, w_data, w_strobe} <= {1'b1, s_axil_wdata, s_axil_wstrb};
    if (s_axil_arvalid && s_axil_arready) begin
      ar_word         <= s_axil_araddr[11:2];
      scratch_at_read <= scratch;
      status_at_read  <= status;
    end
    status <= status | events;
    if (write_now) begin
      {address_waits, data_waits} <= 2'b00;
      write_known <= aw_word <= LAST;
      for (i = 0; i < 4; i = i + 1)
        if (aw_word == SCRATCH && w_strobe[i]) scratch[i*8+:8] <= w_data[i*8+:8];
      if (aw_word == IRQ_STATUS && w_strobe[0]) status <= (status & ~w_data[4:0]) | events;
      if (aw_word == IRQ_ENABLE && w_strobe[0]) enable <= w_data[4:0];
    end
    if (rst) begin
      {address_waits, data_waits, scratch, status, enable, expect_irq} <= 45'd0;
    end
  end

  (* hierconn *) wire [9:0] \dut.aw_word_reg ;
  (* hierconn *) wire [31:0] \dut.w_data_reg ;
  (* hierconn *) wire [3:0] \dut.w_strb_reg ;
  (* hierconn *) wire [31:0] \dut.scratch_value_reg ;
  (* hierconn *) wire \dut.irq_status_lidar_fault_reg ;
  (* hierconn *) wire \dut.irq_status_axi_error_reg ;
  (* hierconn *) wire \dut.irq_status_frame_overflow_reg ;
  (* hierconn *) wire \dut.irq_status_frame_malformed_reg ;
  (* hierconn *) wire \dut.irq_status_frame_done_reg ;
  (* hierconn *) wire \dut.irq_enable_lidar_fault_reg ;
  (* hierconn *) wire \dut.irq_enable_axi_error_reg ;
  (* hierconn *) wire \dut.irq_enable_frame_overflow_reg ;
  (* hierconn *) wire \dut.irq_enable_frame_malformed_reg ;
  (* hierconn *) wire \dut.irq_enable_frame_done_reg ;
  reg write_was_now;
  always @(posedge clk) write_was_now <= write_now && !rst;

  always @(posedge clk)
    if (known) begin
      // One answer a request: what is open is what waits and what is being answered, no more and no less.
      assert (addresses_open == {3'd0, address_waits} + {3'd0, s_axil_bvalid});
      assert (data_open == {3'd0, data_waits} + {3'd0, s_axil_bvalid});
      assert (reads_open == {3'd0, s_axil_rvalid});
      assert (s_axil_awready == !address_waits && s_axil_wready == !data_waits && s_axil_arready == !s_axil_rvalid);
      if (write_was_now) assert (s_axil_bvalid);

      if (s_axil_bvalid) assert (s_axil_bresp == (write_known ? 2'b00 : 2'b10));
      if (s_axil_rvalid) begin
        assert (s_axil_rresp == (ar_word <= LAST ? 2'b00 : 2'b10));
        if (ar_word > LAST) assert (s_axil_rdata == 32'd0);
        if (ar_word == SCRATCH) assert (s_axil_rdata == scratch_at_read);
        if (ar_word == IRQ_STATUS) assert (s_axil_rdata == {27'd0, status_at_read});
      end
      assert (irq == expect_irq);

      // For induction: both hold the same.
      if (address_waits) assert (aw_word == \dut.aw_word_reg );
      if (data_waits) assert (w_data == \dut.w_data_reg && w_strobe == \dut.w_strb_reg );
      assert (scratch == \dut.scratch_value_reg );
      assert (status == {\dut.irq_status_lidar_fault_reg , \dut.irq_status_axi_error_reg ,
                         \dut.irq_status_frame_overflow_reg , \dut.irq_status_frame_malformed_reg ,
                         \dut.irq_status_frame_done_reg });
      assert (enable == {\dut.irq_enable_lidar_fault_reg , \dut.irq_enable_axi_error_reg ,
                         \dut.irq_enable_frame_overflow_reg , \dut.irq_enable_frame_malformed_reg ,
                         \dut.irq_enable_frame_done_reg });
    end

endmodule

`default_nettype wire
