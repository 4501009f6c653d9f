// SPDX-License-Identifier: Apache-2.0
// Places and syncs of raw video: one pixel of a fixed frame a cycle. 1280x720 at 60 Hz by default, as CTA-861 has it, with
// syncs that are 1 while active.
//
// Latency: none; all outputs are of one cycle. The first pixel of a frame comes one cycle after reset. Throughput: a pixel a
// cycle. Border, rounding, overflow: none. Limits: 65535 pixels a line and lines a frame, blanking included.

`default_nettype none

module video_timing #(
    parameter WIDTH   = 1280,
    parameter H_FRONT = 110,
    parameter H_SYNC  = 40,
    parameter H_TOTAL = 1650,
    parameter HEIGHT  = 720,
    parameter V_FRONT = 5,
    parameter V_SYNC  = 5,
    parameter V_TOTAL = 750
) (
    input wire pix_clk,
    input wire pix_rst,

    output reg [15:0] x,      // from 0; beyond WIDTH - 1: blanking
    output reg [15:0] y,
    output wire       de,
    output wire       hsync,
    output wire       vsync
);

  localparam [31:0] LAST_X = H_TOTAL - 1;
  localparam [31:0] LAST_Y = V_TOTAL - 1;
  localparam [31:0] COLUMNS = WIDTH;
  localparam [31:0] ROWS = HEIGHT;
  localparam [31:0] H_SYNC_FROM = WIDTH + H_FRONT;
  localparam [31:0] H_SYNC_TO = WIDTH + H_FRONT + H_SYNC;
  localparam [31:0] V_SYNC_FROM = HEIGHT + V_FRONT;
  localparam [31:0] V_SYNC_TO = HEIGHT + V_FRONT + V_SYNC;
  localparam H_LEAST = WIDTH + H_FRONT + H_SYNC;
  localparam V_LEAST = HEIGHT + V_FRONT + V_SYNC;

  generate
    if (WIDTH < 1 || H_FRONT < 0 || H_SYNC < 1 || H_TOTAL < H_LEAST || H_TOTAL > 65535) begin : g_line
      ERROR_a_line_must_hold_its_pixels_and_its_sync_in_at_most_65535_cycles error_instance ();
    end
    if (HEIGHT < 1 || V_FRONT < 0 || V_SYNC < 1 || V_TOTAL < V_LEAST || V_TOTAL > 65535) begin : g_frame
      ERROR_a_frame_must_hold_its_lines_and_its_sync_in_at_most_65535_lines error_instance ();
    end
  endgenerate

  assign de = !pix_rst && x < COLUMNS[15:0] && y < ROWS[15:0];
  assign hsync = x >= H_SYNC_FROM[15:0] && x < H_SYNC_TO[15:0];
  assign vsync = y >= V_SYNC_FROM[15:0] && y < V_SYNC_TO[15:0];

  always @(posedge pix_clk) begin
    x <= x == LAST_X[15:0] ? 16'd0 : x + 16'd1;
    if (x == LAST_X[15:0]) y <= y == LAST_Y[15:0] ? 16'd0 : y + 16'd1;
    if (pix_rst) begin
      x <= 16'd0;
      y <= 16'd0;
    end
  end

endmodule

`default_nettype wire
