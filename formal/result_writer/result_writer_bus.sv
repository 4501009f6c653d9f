// SPDX-License-Identifier: Apache-2.0
// result_writer: the AXI rules of its write channels, in every order of events and for records of any length.
`default_nettype none

module result_writer_bus #(
    parameter MAX_OBJECTS = 256,
    parameter MAX_OUTSTANDING = 8
) (
    input wire clk,
    input wire rst,
    input wire [31:0] ring_base,
    input wire [31:0] frame_number,
    input wire [63:0] frame_start_us,
    input wire [15:0] frame_width,
    input wire [15:0] frame_height,
    input wire [8:0] threshold_factor,
    input wire [31:0] min_area,
    input wire thresholds_missing,
    input wire thresholds_stale,
    input wire [31:0] scan_time_us,
    input wire [31:0] altitude_mm,
    input wire [31:0] altitude_age_us,
    input wire altitude_valid,
    input wire [31:0] frames_malformed,
    input wire [31:0] frames_overflow,
    input wire [511:0] s_axis_tdata,
    input wire s_axis_tvalid,
    input wire s_axis_tuser,
    input wire s_axis_tlast,
    input wire m_axi_awready,
    input wire m_axi_wready,
    input wire [1:0] m_axi_bresp,
    input wire m_axi_bvalid
);

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

  (* hierconn *) wire [7:0] \rules.length ;
  (* hierconn *) wire \rules.address_waits ;
  (* hierconn *) wire [7:0] \dut.outstanding_reg ;
  (* hierconn *) wire [7:0] \dut.beats_left_reg ;
  (* hierconn *) wire [2:0] \dut.state_reg ;
  (* hierconn *) wire [8:0] \dut.object_count_reg ;
  (* hierconn *) wire [31:0] \dut.offset_reg ;
  (* hierconn *) wire [31:0] \dut.base_reg ;
  (* hierconn *) wire [31:0] \dut.awaddr_reg ;
  (* hierconn *) wire [7:0] \dut.awlen_reg ;
  (* hierconn *) wire [7:0] \dut.index_reg ;
  reg known = 1'b0;
  always @(posedge clk) known <= 1'b1;

  always @(posedge clk)
    if (known && !rst) begin
      assert (\dut.outstanding_reg <= MAX_OUTSTANDING);
      // For induction.
      assert (\dut.outstanding_reg == {4'd0, unanswered} + {7'd0, starts});
      if (m_axi_wvalid) assert (\dut.beats_left_reg <= 8'd7);
      if (m_axi_wvalid) assert (\dut.beats_left_reg + beat == (starts ? m_axi_awlen : \rules.length ));
      if (m_axi_awvalid && \rules.address_waits ) assert (m_axi_awlen == \rules.length );
      if (starts) assert (m_axi_wvalid);
      if (\dut.state_reg == 3'd0) assert (!m_axi_awvalid && !m_axi_wvalid && unanswered == 4'd0);
      if (\dut.state_reg != 3'd0) begin
        assert (\dut.base_reg [11:0] == 12'd0);
        assert (\dut.offset_reg == 32'd64 + {17'd0, \dut.object_count_reg , 6'd0});
        assert (\dut.object_count_reg <= MAX_OBJECTS);
        if (\dut.state_reg <= 3'd2) assert (\dut.object_count_reg == 9'd0);
      end
      if (m_axi_awvalid) assert (m_axi_awlen == 8'd7 ? m_axi_awaddr[5:0] == 6'd0 :
                                 m_axi_awlen == 8'd6 ? m_axi_awaddr[11:0] == 12'd0 :
                                 m_axi_awlen == 8'd0 && m_axi_awaddr[11:0] == 12'd56);
    end

endmodule

`default_nettype wire
