// SPDX-License-Identifier: Apache-2.0
// The camera's syncs a fixed time later: a ring of memory that is read where it is written next.
//
// Latency: CYCLES of pix_clk. Throughput: a sample a cycle. Border, rounding, overflow: none. Limits: until the ring has been
// filled after a reset, it gives blanking. Reset is asynchronous.

`default_nettype none

module sync_delay #(
    parameter CYCLES       = 13199,
    parameter VSYNC_ACTIVE = 1
) (
    input wire pix_clk,
    input wire pix_rst,

    input wire de,
    input wire hsync,
    input wire vsync,

    output wire out_de,
    output wire out_hsync,
    output wire out_vsync
);

  generate
    if (CYCLES < 4 || CYCLES > 65537) begin : g_cycles
      ERROR_delay_must_be_5_to_65538_cycles error_instance ();
    end
  endgenerate

  // One cycle passes in front of the ring, one behind it.
  localparam RING = CYCLES - 2;
  localparam ADDRESS = RING > 1 ? $clog2(RING) : 1;
  localparam [31:0] LAST = RING - 1;
  localparam [2:0] IDLE = {2'b00, VSYNC_ACTIVE == 0};

  reg [2:0] ring[0:RING-1];
  reg [2:0] in_reg;
  reg [2:0] out_reg;
  reg [ADDRESS-1:0] place_reg;
  reg filled_reg;
  reg shown_reg;

  assign {out_de, out_hsync, out_vsync} = shown_reg ? out_reg : IDLE;

  always @(posedge pix_clk) begin
    in_reg          <= {de, hsync, vsync};
    out_reg         <= ring[place_reg];
    ring[place_reg] <= in_reg;
  end

  always @(posedge pix_clk or posedge pix_rst) begin
    if (pix_rst) begin
      place_reg  <= {ADDRESS{1'b0}};
      filled_reg <= 1'b0;
      shown_reg  <= 1'b0;
    end else begin
      place_reg <= place_reg == LAST[ADDRESS-1:0] ? {ADDRESS{1'b0}} : place_reg + 1'b1;
      if (place_reg == LAST[ADDRESS-1:0]) filled_reg <= 1'b1;
      shown_reg <= filled_reg;
    end
  end

endmodule

`default_nettype wire
