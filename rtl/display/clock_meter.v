// SPDX-License-Identifier: Apache-2.0
// Whether a clock runs, and how fast: its cycles are counted over a millisecond of clk, each millisecond.
//
// Latency: a millisecond. Throughput: one measurement a millisecond. Border: none, no picture. Rounding: khz comes in steps of
// 16. Overflow: khz counts modulo 2^20. Limits: meter_clk is less than 5 times as fast as clk.

`default_nettype none

module clock_meter #(
    parameter CLK_PER_US = 100
) (
    input wire clk,
    input wire rst,

    input wire meter_clk,

    output reg  [19:0] khz,
    output wire        runs,
    output reg         lost   // one cycle: it ran, and now stands still
);

  localparam [31:0] LAST_CLK_OF_MS = CLK_PER_US * 1000 - 1;

  // A wave of 32 cycles of meter_clk is slow enough for clk to see each edge.
  reg crossing_rst_reg;
  wire meter_rst;
  reg [4:0] wave_reg;
  wire wave;
  reg wave_seen_reg;
  reg [19:0] ms_reg;
  reg [15:0] edges_reg;
  wire edge_seen = wave != wave_seen_reg;
  wire last_of_ms = ms_reg == LAST_CLK_OF_MS[19:0];

  assign runs = khz != 20'd0;

  reset_sync meter_reset (
      .clk    (meter_clk),
      .rst_in (crossing_rst_reg),
      .rst_out(meter_rst)
  );

  always @(posedge meter_clk or posedge meter_rst) begin
    if (meter_rst) wave_reg <= 5'd0;
    else wave_reg <= wave_reg + 5'd1;
  end

  sync_bits #(
      .WIDTH(1)
  ) wave_sync (
      .clk(clk),
      .rst(crossing_rst_reg),
      .d  (wave_reg[4]),
      .q  (wave)
  );

  always @(posedge clk) begin
    crossing_rst_reg <= rst;
    wave_seen_reg    <= wave;
    lost             <= 1'b0;
    edges_reg        <= edges_reg + {15'd0, edge_seen};
    ms_reg           <= ms_reg + 20'd1;
    if (last_of_ms) begin
      ms_reg    <= 20'd0;
      edges_reg <= {15'd0, edge_seen};
      khz       <= {edges_reg, 4'd0};
      lost      <= runs && edges_reg == 16'd0;
    end
    if (rst) begin
      wave_seen_reg <= 1'b0;
      ms_reg        <= 20'd0;
      edges_reg     <= 16'd0;
      khz           <= 20'd0;
      lost          <= 1'b0;
    end
  end

endmodule

`default_nettype wire
