// SPDX-License-Identifier: Apache-2.0
// Carries events between clocks: one cycle of dst_pulse for each cycle of src_event, also when they come in bursts or
// when dst_clk is slower, as they are counted, not toggled. Limit: fewer than 16 events on the way at a time.
// Latency: 1 cycle of src_clk and 3 of dst_clk. Resets are asynchronous and overlap.
`default_nettype none

module event_sync (
    input  wire src_clk,
    input  wire src_rst,
    input  wire src_event,
    input  wire dst_clk,
    input  wire dst_rst,
    output reg  dst_pulse
);

  reg  [3:0] src_count_reg;
  reg  [3:0] src_gray_reg;
  reg  [3:0] dst_count_reg;
  wire [3:0] src_count_next = src_count_reg + 4'd1;
  wire [3:0] src_gray_in_dst;
  wire       behind = src_gray_in_dst != (dst_count_reg ^ (dst_count_reg >> 1));

  sync_bits #(
      .WIDTH(4)
  ) gray_sync (
      .clk(dst_clk),
      .rst(dst_rst),
      .d  (src_gray_reg),
      .q  (src_gray_in_dst)
  );

  always @(posedge src_clk or posedge src_rst) begin
    if (src_rst) begin
      src_count_reg <= 4'd0;
      src_gray_reg  <= 4'd0;
    end else if (src_event) begin
      src_count_reg <= src_count_next;
      src_gray_reg  <= src_count_next ^ (src_count_next >> 1);
    end
  end

  always @(posedge dst_clk or posedge dst_rst) begin
    if (dst_rst) begin
      dst_count_reg <= 4'd0;
      dst_pulse     <= 1'b0;
    end else begin
      dst_count_reg <= dst_count_reg + {3'd0, behind};
      dst_pulse     <= behind;
    end
  end

endmodule

`default_nettype wire
