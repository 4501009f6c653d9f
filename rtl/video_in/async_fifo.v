// SPDX-License-Identifier: Apache-2.0
// FIFO between two clocks with gray-coded pointers; the memory maps to block RAM.
// Reading shows the next word (first word falls through): rd_data is a word while rd_valid, taken with rd_ready.
// Latency: a word is seen 3 edges of rd_clk after the edge of wr_clk that took it. Throughput: one word a cycle.
// Holds 2**DEPTH_LOG2 words in the memory and one in the output register. Overflow: wr_en while wr_full is ignored.
// Resets are asynchronous and overlap; a word written before a reset is never read after it.
`default_nettype none

module async_fifo #(
    parameter WIDTH      = 33,
    parameter DEPTH_LOG2 = 10
) (
    input  wire             wr_clk,
    input  wire             wr_rst,
    input  wire             wr_en,
    input  wire [WIDTH-1:0] wr_data,
    output reg              wr_full,

    input  wire             rd_clk,
    input  wire             rd_rst,
    output reg              rd_valid,
    output reg  [WIDTH-1:0] rd_data,
    input  wire             rd_ready
);

  generate
    if (DEPTH_LOG2 < 2) begin : g_depth
      ERROR_depth_log2_must_be_at_least_2 error_instance ();
    end
  endgenerate

  // Pointers have one bit more than an address: equal means empty, equal but for the top bit means full.
  localparam POINTER = DEPTH_LOG2 + 1;

  reg [WIDTH-1:0] memory[0:(1<<DEPTH_LOG2)-1];

  reg [POINTER-1:0] wr_pointer_reg;
  reg [POINTER-1:0] wr_gray_reg;
  reg [POINTER-1:0] rd_pointer_reg;
  reg [POINTER-1:0] rd_gray_reg;
  wire [POINTER-1:0] wr_gray_in_rd;
  wire [POINTER-1:0] rd_gray_in_wr;

  wire write = wr_en && !wr_full;
  wire [POINTER-1:0] wr_pointer_plus_1 = wr_pointer_reg + 1'b1;
  wire [POINTER-1:0] wr_gray_plus_1 = wr_pointer_plus_1 ^ (wr_pointer_plus_1 >> 1);

  // In gray code, "equal but for the top bit" shows as both top bits different.
  wire [POINTER-1:0] full_gray = {~rd_gray_in_wr[POINTER-1:POINTER-2], rd_gray_in_wr[POINTER-3:0]};

  wire fetch = wr_gray_in_rd != rd_gray_reg && (!rd_valid || rd_ready);
  wire [POINTER-1:0] rd_pointer_next = rd_pointer_reg + {{DEPTH_LOG2{1'b0}}, fetch};

  sync_bits #(
      .WIDTH(POINTER)
  ) wr_gray_sync (
      .clk(rd_clk),
      .rst(rd_rst),
      .d  (wr_gray_reg),
      .q  (wr_gray_in_rd)
  );

  sync_bits #(
      .WIDTH(POINTER)
  ) rd_gray_sync (
      .clk(wr_clk),
      .rst(wr_rst),
      .d  (rd_gray_reg),
      .q  (rd_gray_in_wr)
  );

  always @(posedge wr_clk) begin
    if (write) memory[wr_pointer_reg[DEPTH_LOG2-1:0]] <= wr_data;
  end

  always @(posedge wr_clk or posedge wr_rst) begin
    if (wr_rst) begin
      wr_pointer_reg <= {POINTER{1'b0}};
      wr_gray_reg    <= {POINTER{1'b0}};
      wr_full        <= 1'b0;
    end else begin
      if (write) begin
        wr_pointer_reg <= wr_pointer_plus_1;
        wr_gray_reg    <= wr_gray_plus_1;
      end
      // Both are compared before it is known whether a word comes.
      wr_full <= write ? wr_gray_plus_1 == full_gray : wr_gray_reg == full_gray;
    end
  end

  always @(posedge rd_clk) begin
    if (fetch) rd_data <= memory[rd_pointer_reg[DEPTH_LOG2-1:0]];
  end

  always @(posedge rd_clk or posedge rd_rst) begin
    if (rd_rst) begin
      rd_pointer_reg <= {POINTER{1'b0}};
      rd_gray_reg    <= {POINTER{1'b0}};
      rd_valid       <= 1'b0;
    end else begin
      rd_pointer_reg <= rd_pointer_next;
      rd_gray_reg    <= rd_pointer_next ^ (rd_pointer_next >> 1);
      if (fetch) rd_valid <= 1'b1;
      else if (rd_ready) rd_valid <= 1'b0;
    end
  end

endmodule

`default_nettype wire
