// SPDX-License-Identifier: Apache-2.0
// frame_reader of frame_source: the AXI rules of its read channels, and the order of its words: a header when nothing of a
// frame before is under way, then each beat of the picture from its first on, up to the next frame or an error of memory.
// In every order of events, at full size.
`default_nettype none

module frame_source_reads #(
    parameter PIXELS = 921600
) (
    input wire        clk,
    input wire        rst,
    input wire        next_frame,
    input wire        cfg_enable,
    input wire [31:0] cfg_base,
    input wire        m_axi_arready,
    input wire [63:0] m_axi_rdata,
    input wire [ 1:0] m_axi_rresp,
    input wire        m_axi_rlast,
    input wire        m_axi_rvalid,
    input wire        word_full
);

  localparam [31:0] BEATS = (PIXELS + 1) / 2;
  localparam [31:0] BURSTS = (BEATS + 15) / 16;
  localparam [31:0] LAST_LEN = BEATS - 16 * (BURSTS - 1) - 1;

  wire [31:0] m_axi_araddr;
  wire [7:0] m_axi_arlen;
  wire [2:0] m_axi_arsize;
  wire [1:0] m_axi_arburst;
  wire [3:0] m_axi_arcache;
  wire [2:0] m_axi_arprot;
  wire m_axi_arvalid;
  wire m_axi_rready;
  wire word_valid;
  wire [48:0] word;
  wire read_error;

  frame_reader #(
      .PIXELS         (PIXELS),
      .MAX_OUTSTANDING(2)
  ) dut (
      .*
  );

  power_up start (.*);

  wire starts, waits;
  wire [1:0] unanswered, taken;
  wire [7:0] first_length, next_length, beat;

  axi_read_rules rules (
      .clk         (clk),
      .rst         (rst),
      .araddr      (m_axi_araddr),
      .arlen       (m_axi_arlen),
      .arsize      (m_axi_arsize),
      .arburst     (m_axi_arburst),
      .arvalid     (m_axi_arvalid),
      .arready     (m_axi_arready),
      .rlast       (m_axi_rlast),
      .rvalid      (m_axi_rvalid),
      .rready      (m_axi_rready),
      .starts      (starts),
      .unanswered  (unanswered),
      .taken       (taken),
      .waits       (waits),
      .first_length(first_length),
      .next_length (next_length),
      .beat        (beat)
  );

  wire header = word_valid && word[48];
  wire begins = header && word[0];
  wire pixels = word_valid && !word[48];
  wire answer = m_axi_rvalid && m_axi_rready;
  wire bad = answer && m_axi_rresp[1];

  reg known = 1'b0;
  reg begun;  // a picture was begun since reset
  reg open;  // words of it may come
  reg was_open;
  reg failed, told;
  reg [3:0] number;
  reg [31:0] base;
  reg [31:0] issued, ended;  // bursts of it whose address was taken; that ended
  reg [31:0] words;
  reg failed_once;

  always @(posedge clk) begin
    known    <= 1'b1;
    was_open <= open;
    if (begins) begun <= 1'b1;
    open <= (open || begins) && !next_frame && !bad;
    failed <= (failed && !begins) || bad;
    told <= bad && !failed;
    failed_once <= failed_once || told;
    number <= number + {3'd0, next_frame};
    issued <= issued + {31'd0, m_axi_arvalid && m_axi_arready};
    ended <= ended + {31'd0, answer && m_axi_rlast};
    words <= words + {31'd0, pixels && !word_full};
    if (begins) begin
      base   <= {cfg_base[31:12], 12'd0};
      issued <= 32'd0;
      ended  <= 32'd0;
      words  <= 32'd0;
    end
    if (rst) {begun, open, was_open, failed, told, number, failed_once} <= 10'd0;
  end

  // A header is due: frames came of which none was told.
  reg due;
  always @(posedge clk) begin
    due <= (due && !header) || next_frame;
    if (rst) due <= 1'b0;
  end

  always @(posedge clk)
    if (known && !rst) begin
      if (header) begin
        assert (due && !word_full && word[4:1] == number && word[0] == cfg_enable);
        assert (!open);
      end
      // Nothing of a picture before can come into the next one.
      if (begins) assert (unanswered == 2'd0 && !m_axi_arvalid && beat == 8'd0);
      if (pixels) begin
        assert (open && m_axi_rvalid && !m_axi_rresp[1]);
        assert (word[23:0] == m_axi_rdata[23:0] && word[47:24] == m_axi_rdata[55:32]);
        assert (m_axi_rready == !word_full);
        assert (words < BEATS && words == {ended[27:0], beat[3:0]});
      end
      // No beat of an open frame is lost, and what is not wanted is not kept waiting.
      if (open && answer && !m_axi_rresp[1]) assert (pixels && !word_full);
      if (!open) assert (m_axi_rready);
      if (starts) begin
        assert (was_open && issued < BURSTS);
        assert (m_axi_araddr == base + {issued[24:0], 7'd0});
        assert (m_axi_arlen == (issued == BURSTS - 1 ? LAST_LEN : 32'd15));
      end
      assert (read_error == told);
      // The ends are reached: of a picture, and of one after an error.
      cover (words == BEATS);
      cover (words == BEATS && failed_once);
    end

  // For induction.
  (* hierconn *) wire [3:0] \dut.outstanding_reg ;
  (* hierconn *) wire [31:0] \dut.left_reg ;
  (* hierconn *) wire [24:0] \dut.address_reg ;
  (* hierconn *) wire [3:0] \dut.number_reg ;
  (* hierconn *) wire \dut.drop_reg ;
  (* hierconn *) wire \dut.pending_reg ;
  (* hierconn *) wire \dut.error_reg ;
  localparam COUNT = $clog2(BURSTS + 1);
  wire [31:0] left = BURSTS - issued;

  always @(posedge clk)
    if (known && !rst) begin
      assert (\dut.outstanding_reg == {2'd0, unanswered} + {3'd0, starts});
      assert (\dut.number_reg == number);
      assert (\dut.drop_reg == !open);
      assert (\dut.pending_reg == due && !(due && open));
      assert (\dut.error_reg == failed);
      if (open || m_axi_arvalid || taken != 2'd0) assert (begun);
      if (m_axi_arvalid) assert (issued < BURSTS);
      if (begun) begin
        assert (issued <= BURSTS && ended <= BURSTS && issued == ended + {30'd0, taken});
        assert (\dut.left_reg [COUNT-1:0] == left[COUNT-1:0]);
        assert (\dut.address_reg == base[31:7] + issued[24:0]);
        assert (base[11:0] == 12'd0);
        if (taken != 2'd0) assert (first_length == (ended == BURSTS - 1 ? LAST_LEN : 32'd15));
        if (taken == 2'd2) assert (next_length == (ended == BURSTS - 2 ? LAST_LEN : 32'd15));
      end
      if (open) assert (words == (ended == BURSTS ? BEATS : {ended[27:0], beat[3:0]}));
    end

endmodule

`default_nettype wire
