// SPDX-License-Identifier: Apache-2.0
// result_writer: the AXI rules of its write channels, and the order of a record on them: a frame number is written only
// after everything else of its frame was answered OKAY. In every order of events, for records of any length.
`default_nettype none

module result_writer_record #(
    parameter MAX_OBJECTS = 256,
    parameter MAX_OUTSTANDING = 8,
    // 1: only what a planted fault that shows late needs, so that it is found soon: contents stand still, each word of an
    // object another; objects come and data is taken at once; one reset.
    parameter STILL = 0
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

  wire [31:0] base_in = STILL == 0 ? ring_base : 32'h1000_0000;
  wire [511:0] data_in = STILL == 0 ? s_axis_tdata : {64'd8, 64'd7, 64'd6, 64'd5, 64'd4, 64'd3, 64'd2, 64'd1};

  result_writer #(
      .MAX_OBJECTS    (MAX_OBJECTS),
      .MAX_OUTSTANDING(MAX_OUTSTANDING)
  ) dut (
      .*,
      .ring_base   (base_in),
      .s_axis_tdata(data_in)
  );

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
  wire take = s_axis_tvalid && s_axis_tready;
  wire no = m_axi_bvalid && m_axi_bresp[1];

  reg known = 1'b0;

  // Frames are counted from 1.
  always @* assume (frame_number != 32'd0);
  always @* if (STILL != 0 && known) assume (!rst && s_axis_tvalid && m_axi_wready && frame_number == 32'd1);

  // How far the record has come; _now counts what begins in this clock.
  localparam [1:0] NONE = 2'd0;
  localparam [1:0] OPEN = 2'd1;  // the frame number of the buffer was set to 0
  localparam [1:0] HEADED = 2'd2;
  localparam [1:0] PUBLISHED = 2'd3;
  reg [1:0] phase;
  wire [1:0] phase_now = zeroes ? OPEN : heads ? HEADED : publishes ? PUBLISHED : phase;
  reg failed;  // a response to this record said no
  wire failed_now = failed && !zeroes;
  reg failed_before;  // a burst that is begun in the clock of the response still goes out
  reg [8:0] objects;
  wire [8:0] objects_now = objects + {8'd0, writes_object};
  reg [1:0] buffer;
  wire [1:0] buffer_now = buffer + {1'b0, frame_done};
  reg [31:0] base, number;
  (* anyconst *) reg [2:0] any_word;
  wire [2:0] watched = STILL == 0 ? any_word : 3'd0;  // one word of the objects
  reg [63:0] word;  // of the object taken last

  always @(posedge clk) begin
    known         <= 1'b1;
    // Also in the clock in which the frame number of the next one is set to 0.
    phase         <= (frame_done || axi_error) && !zeroes ? NONE : phase_now;
    failed        <= failed_now || no;
    failed_before <= failed_now;
    objects       <= objects_now;
    buffer        <= buffer_now;
    if (take) word <= data_in[{watched, 6'd0}+:64];
    if (take && s_axis_tlast) number <= frame_number;
    if (take && s_axis_tuser) begin
      base    <= {base_in[31:12], 12'd0} + {15'd0, buffer_now, 15'd0};
      objects <= 9'd0;
    end
    if (rst) {phase, failed, failed_before, buffer} <= 6'd0;
  end

  always @(posedge clk)
    if (known && !rst) begin
      // The frame number goes to 0 first, and nothing of the frame before is then under way.
      if (zeroes) assert (unanswered == 4'd0 && m_axi_awaddr == base + 32'd56);
      if (writes_object) begin
        assert (phase == OPEN && !failed_before && objects < MAX_OBJECTS);
        assert (m_axi_awaddr == base + 32'd64 + {17'd0, objects, 6'd0});
      end
      if (m_axi_wvalid && m_axi_awlen == 8'd7 && beat == watched) assert (m_axi_wdata == word);
      if (heads) assert (phase == OPEN && !failed_before && m_axi_awaddr == base);
      if (publishes) begin
        assert (phase == HEADED && !failed && unanswered == 4'd0);
        assert (m_axi_awaddr == base + 32'd56 && m_axi_wdata == {number, 32'd0});
      end
      if (starts) assert (zeroes || writes_object || heads || publishes);
      // What the processor is told.
      if (frame_done) begin
        assert (phase == PUBLISHED && !failed && unanswered == 4'd0);
        assert (written_frame_number == number && ring_head_valid && ring_head_index == {6'd0, buffer});
      end
      if (axi_error) assert (failed && !frame_done);
      // The end is reached: with an object, after a frame that failed, after one that was cut off.
      cover (frame_done && objects == 9'd1);
      cover (frame_done && failed_once);
      cover (frame_done && frames_unwritten == 32'd1 && !failed_once);
    end

  reg failed_once;
  always @(posedge clk) failed_once <= !rst && (failed_once || axi_error);

  // For induction.
  localparam [2:0] IDLE = 3'd0;
  localparam [2:0] DRAIN = 3'd1;
  localparam [2:0] INVALIDATE = 3'd2;
  localparam [2:0] OBJECTS = 3'd3;
  localparam [2:0] HEADER = 3'd4;
  localparam [2:0] SETTLE = 3'd5;
  localparam [2:0] PUBLISH = 3'd6;
  (* hierconn *) wire [7:0] \rules.length ;
  (* hierconn *) wire \rules.address_waits ;
  (* hierconn *) wire [7:0] \dut.outstanding_reg ;
  (* hierconn *) wire \dut.outstanding_none_reg ;
  (* hierconn *) wire \dut.outstanding_most_reg ;
  (* hierconn *) wire [7:0] \dut.beats_left_reg ;
  (* hierconn *) wire [2:0] \dut.state_reg ;
  (* hierconn *) wire [8:0] \dut.object_count_reg ;
  (* hierconn *) wire [31:0] \dut.offset_reg ;
  (* hierconn *) wire [31:0] \dut.base_reg ;
  (* hierconn *) wire [7:0] \dut.index_reg ;
  (* hierconn *) wire [31:0] \dut.frame_number_reg ;
  (* hierconn *) wire [511:0] \dut.data_reg ;
  wire [2:0] to_watched = watched - beat[2:0];
  wire [63:0] ahead = \dut.data_reg [{to_watched, 6'd0}+:64];
  (* hierconn *) wire \dut.error_reg ;
  (* hierconn *) wire \dut.held_is_trailer_reg ;
  (* hierconn *) wire \dut.zero_reg ;

  always @(posedge clk)
    if (known && !rst) begin
      assert (\dut.outstanding_reg <= MAX_OUTSTANDING);
      assert (\dut.outstanding_none_reg == (\dut.outstanding_reg == 8'd0));
      assert (\dut.outstanding_most_reg == (\dut.outstanding_reg == MAX_OUTSTANDING));
      assert (\dut.outstanding_reg == {4'd0, unanswered} + {7'd0, starts});
      if (m_axi_wvalid) assert (\dut.beats_left_reg <= 8'd7);
      if (m_axi_wvalid) assert (\dut.beats_left_reg + beat == (starts ? m_axi_awlen : \rules.length ));
      if (m_axi_awvalid && \rules.address_waits ) assert (m_axi_awlen == \rules.length );
      if (m_axi_wvalid && !starts) assert (m_axi_awlen == \rules.length );
      if (starts) assert (m_axi_wvalid);
      if (m_axi_wvalid && m_axi_awlen == 8'd7) assert (!\dut.zero_reg && (beat > watched || ahead == word));
      assert (\dut.index_reg == {6'd0, buffer_now});
      if (\dut.state_reg != IDLE) begin
        assert (\dut.base_reg == base && base[11:0] == 12'd0);
        assert (\dut.offset_reg == 32'd64 + {17'd0, \dut.object_count_reg , 6'd0});
        assert (\dut.object_count_reg <= MAX_OBJECTS && \dut.object_count_reg == objects_now);
      end
      if (\dut.state_reg >= HEADER || (\dut.state_reg == DRAIN || \dut.state_reg == INVALIDATE) && \dut.held_is_trailer_reg )
        assert (\dut.frame_number_reg == number && number != 32'd0);
      if (\dut.state_reg >= INVALIDATE) assert (\dut.error_reg == failed_now);
      if (frame_done) assert (\dut.state_reg == IDLE);
      if (axi_error) assert (\dut.state_reg == IDLE || zeroes);
      case (\dut.state_reg )
        IDLE: begin
          assert (!m_axi_awvalid && !m_axi_wvalid && unanswered == 4'd0 && !\dut.error_reg );
          assert (phase == NONE || frame_done || axi_error);
        end
        DRAIN: begin
          assert (!m_axi_awvalid && !m_axi_wvalid);
          assert (phase <= OPEN);
          assert (failed || !\dut.error_reg );
          assert (\dut.object_count_reg == 9'd0 && \dut.data_reg [{watched, 6'd0}+:64] == word);
        end
        INVALIDATE: begin
          assert (phase_now == OPEN && !writes_object);
          if (m_axi_wvalid) assert (\dut.zero_reg && m_axi_awlen == 8'd0);
          assert (\dut.object_count_reg == 9'd0 && \dut.data_reg [{watched, 6'd0}+:64] == word);
        end
        OBJECTS: assert (phase_now == OPEN);
        HEADER: assert (phase_now == OPEN && !starts);
        SETTLE: assert (phase_now == HEADED || phase_now == OPEN && failed);
        PUBLISH: assert (phase_now == PUBLISHED);
        default: assert (1'b0);
      endcase
    end

endmodule

`default_nettype wire
