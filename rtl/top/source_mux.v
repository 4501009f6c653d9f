// SPDX-License-Identifier: Apache-2.0
// One of three sources of raw video, all on pix_clk, or blanking while hold is 1. source and hold come from clk; source
// changes only while hold is 1 (source_switch), long before it falls, so its bits need no more than a synchroniser.
//
// Latency     2 cycles of pix_clk from the camera, 1 from the others. The first of the camera's is a register next to the
//             receiver, whose own clock drives pix_clk through the clock switch.
// Throughput  a pixel a cycle. Border, rounding, overflow: none. Limits: source 3 is blank.

`default_nettype none

module source_mux (
    input wire       pix_clk,
    input wire       hold,
    input wire [1:0] source,

    input wire [26:0] camera,   // {data, de, hsync, vsync}, as all of these
    input wire [26:0] pattern,
    input wire [26:0] stored,

    output wire        pix_hold,  // hold, on pix_clk: rises at once, also when pix_clk stands still
    output reg  [23:0] data,
    output reg         de,
    output reg         hsync,
    output reg         vsync
);

  wire [ 1:0] source_in_pix;
  reg  [26:0] camera_reg;
  reg  [26:0] chosen;

  reset_sync hold_sync (
      .clk    (pix_clk),
      .rst_in (hold),
      .rst_out(pix_hold)
  );

  sync_bits #(
      .WIDTH(2)
  ) source_sync (
      .clk(pix_clk),
      .rst(1'b0),
      .d  (source),
      .q  (source_in_pix)
  );

  always @* begin
    case (source_in_pix)
      2'd0: chosen = camera_reg;
      2'd1: chosen = pattern;
      2'd2: chosen = stored;
      default: chosen = 27'd0;
    endcase
  end

  always @(posedge pix_clk) begin
    camera_reg <= camera;
    {data, de, hsync, vsync} <= pix_hold ? 27'd0 : chosen;
  end

endmodule

`default_nettype wire
