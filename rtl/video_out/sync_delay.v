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
    if (CYCLES < 15 || CYCLES > 65537) begin : g_cycles
      ERROR_delay_must_be_16_to_65538_cycles error_instance ();
    end
  endgenerate

  // One cycle passes in front of the ring, two behind it.
  localparam RING = CYCLES - 3;
  localparam ADDRESS = $clog2(RING);
  localparam [31:0] LAST = RING - 1;
  localparam [2:0] IDLE = {2'b00, VSYNC_ACTIVE == 0};

  reg [2:0] ring[0:RING-1];
  reg [2:0] in_reg;
  reg [2:0] ring_reg;
  reg [2:0] out_reg;
  reg [ADDRESS-1:0] place_reg;
  reg starting_reg;
  reg filled_reg;
  reg valid_reg;

  assign {out_de, out_hsync, out_vsync} = out_reg;

  // The place addresses memory, so it has no asynchronous reset; starting_reg has.
  always @(posedge pix_clk) begin
    in_reg <= {de, hsync, vsync};
    ring_reg <= ring[place_reg];
    ring[place_reg] <= in_reg;
    place_reg       <= starting_reg || place_reg == LAST[ADDRESS-1:0] ? {ADDRESS{1'b0}} : place_reg + 1'b1;
  end

  always @(posedge pix_clk or posedge pix_rst) begin
    if (pix_rst) begin
      starting_reg <= 1'b1;
      filled_reg   <= 1'b0;
      valid_reg  <= 1'b0;
      out_reg    <= IDLE;
    end else begin
      starting_reg <= 1'b0;
      if (!starting_reg && place_reg == LAST[ADDRESS-1:0]) filled_reg <= 1'b1;
      valid_reg <= filled_reg;
      if (valid_reg) out_reg <= ring_reg;
    end
  end

endmodule

`default_nettype wire
