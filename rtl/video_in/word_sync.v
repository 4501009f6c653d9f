// SPDX-License-Identifier: Apache-2.0
// Carries a word between clocks, again and again: dst_data is a value that src_data had, never a mixture of two.
// Latency: at most 4 cycles of each clock after a change of src_data once a transfer begins, and transfers follow each
// other, so at most 8 of each. While either clock stands still, dst_data keeps its last value. 0 after reset.
// Resets are asynchronous and overlap.
`default_nettype none

module word_sync #(
    parameter WIDTH = 1
) (
    input  wire             src_clk,
    input  wire             src_rst,
    input  wire [WIDTH-1:0] src_data,
    input  wire             dst_clk,
    input  wire             dst_rst,
    output reg  [WIDTH-1:0] dst_data
);

  // The word stands still in hold_reg from the toggle of request_reg until acknowledge_reg has followed.
  reg  [WIDTH-1:0] hold_reg;
  reg              request_reg;
  reg              acknowledge_reg;
  wire             request_in_dst;
  wire             acknowledge_in_src;

  sync_bits request_sync (
      .clk(dst_clk),
      .rst(dst_rst),
      .d  (request_reg),
      .q  (request_in_dst)
  );

  sync_bits acknowledge_sync (
      .clk(src_clk),
      .rst(src_rst),
      .d  (acknowledge_reg),
      .q  (acknowledge_in_src)
  );

  always @(posedge src_clk or posedge src_rst) begin
    if (src_rst) begin
      hold_reg    <= {WIDTH{1'b0}};
      request_reg <= 1'b0;
    end else if (acknowledge_in_src == request_reg) begin
      hold_reg    <= src_data;
      request_reg <= !request_reg;
    end
  end

  always @(posedge dst_clk or posedge dst_rst) begin
    if (dst_rst) begin
      dst_data        <= {WIDTH{1'b0}};
      acknowledge_reg <= 1'b0;
    end else if (request_in_dst != acknowledge_reg) begin
      dst_data        <= hold_reg;
      acknowledge_reg <= request_in_dst;
    end
  end

endmodule

`default_nettype wire
