// SPDX-License-Identifier: Apache-2.0
// AXI4 rules of a write master that has one burst at a time on AW and W: what is valid stays, unchanged, until ready;
// bursts are legal; data belongs to a burst that was offered, and WLAST stands on its last beat and nowhere else.
// Of the slave it assumes what AXI asks: a response comes only to a burst whose address and data were taken.
`default_nettype none

module axi_write_rules (
    input wire        clk,
    input wire        rst,
    input wire [31:0] awaddr,
    input wire [ 7:0] awlen,
    input wire [ 2:0] awsize,
    input wire [ 1:0] awburst,
    input wire        awvalid,
    input wire        awready,
    input wire [63:0] wdata,
    input wire [ 7:0] wstrb,
    input wire        wlast,
    input wire        wvalid,
    input wire        wready,
    input wire        bvalid,
    input wire        bready,

    output wire       starts,     // a burst is offered for the first time
    output wire [7:0] beat,       // index of the beat on W
    output reg  [3:0] unanswered  // bursts offered before this cycle whose response has not come
);

  axis_rules #(
      .WIDTH(45)
  ) address (
      .clk    (clk),
      .rst    (rst),
      .valid  (awvalid),
      .ready  (awready),
      .payload({awaddr, awlen, awsize, awburst})
  );

  axis_rules #(
      .WIDTH(73)
  ) data (
      .clk    (clk),
      .rst    (rst),
      .valid  (wvalid),
      .ready  (wready),
      .payload({wdata, wstrb, wlast})
  );

  reg known = 1'b0;
  reg address_waits, data_open;
  reg [7:0] length, beat_reg;
  reg [3:0] addresses_taken, data_taken;  // of bursts whose response has not come
  wire ends = wvalid && wready && wlast;
  wire answered = bvalid && bready;
  wire [12:0] bytes = {1'b0, awaddr[11:0]} + ({5'd0, awlen} + 13'd1) * 13'd8;

  assign starts = awvalid && !address_waits;
  assign beat = starts ? 8'd0 : beat_reg;

  always @(posedge clk) begin
    known         <= 1'b1;
    address_waits <= awvalid && !awready;
    if (starts) length <= awlen;
    if (starts) data_open <= 1'b1;
    if (ends) data_open <= 1'b0;
    beat_reg        <= beat + {7'd0, wvalid && wready};
    unanswered      <= unanswered + {3'd0, starts} - {3'd0, answered};
    addresses_taken <= addresses_taken + {3'd0, awvalid && awready} - {3'd0, answered};
    data_taken      <= data_taken + {3'd0, ends} - {3'd0, answered};
    if (rst) {address_waits, data_open, unanswered, addresses_taken, data_taken} <= 14'd0;
  end

  always @* if (known && bvalid) assume (addresses_taken != 4'd0 && data_taken != 4'd0);

  always @(posedge clk)
    if (known && !rst) begin
      if (starts) begin
        assert (!data_open);
        assert (awlen <= 8'd15);
        assert (awsize == 3'd3 && awburst == 2'b01);
        assert (awaddr[2:0] == 3'd0);
        assert (bytes <= 13'd4096);
      end
      if (wvalid) begin
        assert (starts || data_open);
        assert (wlast == (beat == (starts ? awlen : length)));
        assert (&wstrb);
      end
      assert (!(unanswered == 4'd15 && starts));
      // For induction.
      assert (unanswered == addresses_taken + {3'd0, awvalid && address_waits});
      assert (unanswered == data_taken + {3'd0, data_open});
      assert (addresses_taken <= unanswered && data_taken <= unanswered);
      assert (!address_waits || awvalid);
      if (data_open) assert (wvalid && beat_reg <= length);
    end

endmodule

`default_nettype wire
