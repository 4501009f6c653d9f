// SPDX-License-Identifier: Apache-2.0
// Which clock pixels run on, and which source gives them: changes both only while the transmitter is held in reset and
// the pixels are blanked, and lets go again HOLD_US after all is steady. Never gives pixels of another source than wanted.
//
// On want != source, or when the clock in force loses its lock: hold rises with the next clock. From QUIET_US
// of hold on, source and select_local become what is wanted, if the wanted clock is locked; until it is, they stay and
// hold stays 1. hold falls HOLD_US after the last of: change of source, of want, return of the lock.
// ignore_* are for a clock switch that waits for an edge of the clock it leaves: 1 for a clock without lock, and for the
// deselected one from QUIET_US after the change on, so a clock that stopped cannot lock the switch.
//
// Latency     lock to hold 3 cycles of clk (2 of them synchroniser); want to hold 1.
// Throughput, border, rounding: none. Overflow: none, the counter stops.
// Limits      A loss of lock shorter than a cycle of clk may pass unseen. The lock signals may change at any time.

`default_nettype none

module source_switch #(
    parameter CLK_PER_US = 100,
    parameter QUIET_US   = 100,
    parameter HOLD_US    = 1000
) (
    input wire clk,
    input wire rst,

    input wire [1:0] want,           // 0: camera; else built-in
    input wire       camera_locked,  // asynchronous, as the next
    input wire       local_locked,

    output reg       select_local,
    output reg       ignore_camera,
    output reg       ignore_local,
    output reg [1:0] source,
    output reg       hold
);

  localparam [31:0] QUIET = QUIET_US * CLK_PER_US;
  localparam [31:0] HOLD = HOLD_US * CLK_PER_US;

  generate
    if (CLK_PER_US < 1 || QUIET_US < 1 || HOLD_US < QUIET_US || HOLD_US > 1000000) begin : g_times
      ERROR_quiet_us_must_be_at_least_1_and_hold_us_from_quiet_us_to_1000000 error_instance ();
    end
  endgenerate

  wire camera_ok;
  wire local_ok;
  reg  crossing_rst_reg;

  always @(posedge clk) crossing_rst_reg <= rst;

  sync_bits #(
      .WIDTH(2)
  ) lock_sync (
      .clk(clk),
      .rst(crossing_rst_reg),
      .d  ({local_locked, camera_locked}),
      .q  ({local_ok, camera_ok})
  );

  reg  [31:0] count_reg;  // cycles since hold rose, then since all is steady
  reg         chosen_reg;  // source and clock are those that are wanted

  wire        want_local = want != 2'd0;
  wire        want_ok = want_local ? local_ok : camera_ok;
  wire        in_force_ok = select_local ? local_ok : camera_ok;
  wire        disturbed = want != source || !in_force_ok;
  wire        quiet = !chosen_reg && count_reg >= QUIET;
  wire        settled = chosen_reg && count_reg >= QUIET;

  always @(posedge clk) begin
    ignore_camera <= !camera_ok || (select_local && settled);
    ignore_local  <= !local_ok || (!select_local && settled);

    if (disturbed && chosen_reg) begin
      hold <= 1'b1;
      chosen_reg <= 1'b0;
      count_reg <= 32'd0;
    end else if (quiet && want_ok) begin
      source <= want;
      select_local <= want_local;
      chosen_reg <= 1'b1;
      count_reg <= 32'd0;
    end else if (count_reg < HOLD) begin
      count_reg <= count_reg + 32'd1;
    end else if (chosen_reg) begin
      hold <= 1'b0;
    end

    if (rst) begin
      select_local <= 1'b0;
      ignore_camera <= 1'b1;
      ignore_local <= 1'b1;
      source <= 2'd0;
      hold <= 1'b1;
      chosen_reg <= 1'b0;
      count_reg <= 32'd0;
    end
  end

endmodule

`default_nettype wire
