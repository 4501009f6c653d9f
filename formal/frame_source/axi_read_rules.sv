// SPDX-License-Identifier: Apache-2.0
// AXI4 rules of a read master whose bursts are answered in their order: what is valid stays, unchanged, until ready;
// bursts are legal. Of the slave it assumes what AXI asks: a beat comes only of a burst whose address was taken, and
// rlast stands on its last beat. At most two bursts may be under way.
`default_nettype none

module axi_read_rules (
    input wire        clk,
    input wire        rst,
    input wire [31:0] araddr,
    input wire [ 7:0] arlen,
    input wire [ 2:0] arsize,
    input wire [ 1:0] arburst,
    input wire        arvalid,
    input wire        arready,
    input wire        rlast,
    input wire        rvalid,
    input wire        rready,

    output wire       starts,        // a burst is offered for the first time
    output reg  [1:0] unanswered,    // bursts offered before this cycle of which beats are to come
    output reg  [1:0] taken,         // those of them whose address was taken
    output reg        waits,         // an address was offered and not taken
    output reg  [7:0] first_length,  // arlen of the oldest burst that was taken
    output reg  [7:0] next_length,   // of the one after it
    output reg  [7:0] beat           // index of the next beat of the oldest burst
);

  axis_rules #(
      .WIDTH(45)
  ) address (
      .clk    (clk),
      .rst    (rst),
      .valid  (arvalid),
      .ready  (arready),
      .payload({araddr, arlen, arsize, arburst})
  );

  reg known = 1'b0;
  wire takes = arvalid && arready;
  wire answers = rvalid && rready;
  wire ends = answers && rlast;
  wire [12:0] bytes = {1'b0, araddr[11:0]} + ({5'd0, arlen} + 13'd1) * 13'd8;

  assign starts = arvalid && !waits;

  always @(posedge clk) begin
    known      <= 1'b1;
    waits      <= arvalid && !arready;
    unanswered <= unanswered + {1'b0, starts} - {1'b0, ends};
    taken      <= taken + {1'b0, takes} - {1'b0, ends};
    if (answers) beat <= rlast ? 8'd0 : beat + 8'd1;
    if (ends) first_length <= next_length;
    if (takes && (taken - {1'b0, ends}) == 2'd0) first_length <= arlen;
    if (takes && (taken - {1'b0, ends}) == 2'd1) next_length <= arlen;
    if (rst) begin
      waits      <= 1'b0;
      unanswered <= 2'd0;
      taken      <= 2'd0;
      beat       <= 8'd0;
    end
  end

  always @* if (known && rvalid) assume (taken != 2'd0 && rlast == (beat == first_length));

  always @(posedge clk)
    if (known && !rst) begin
      if (starts) begin
        assert (unanswered != 2'd2);
        assert (arlen <= 8'd15);
        assert (arsize == 3'd3 && arburst == 2'b01);
        assert (araddr[2:0] == 3'd0);
        assert (bytes <= 13'd4096);
      end
      // For induction.
      assert (!waits || arvalid);
      assert (unanswered <= 2'd2 && taken <= unanswered);
      assert (unanswered == taken + {1'b0, waits});
      assert (beat == 8'd0 || taken != 2'd0);
      if (taken != 2'd0) assert (beat <= first_length);
    end

endmodule

`default_nettype wire
