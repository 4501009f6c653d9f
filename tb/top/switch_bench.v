// SPDX-License-Identifier: Apache-2.0
// source_switch and source_mux as board_video joins them; the clock switch between them is the test's.

`default_nettype none

module switch_bench #(
    parameter CLK_PER_US = 10,
    parameter QUIET_US   = 3,
    parameter HOLD_US    = 12
) (
    input  wire        clk,
    input  wire        rst,
    input  wire [ 1:0] want,
    input  wire        camera_locked,
    input  wire        local_locked,
    output wire        select_local,
    output wire        ignore_camera,
    output wire        ignore_local,
    output wire [ 1:0] source,
    output wire        hold,
    input  wire        pix_clk,
    input  wire [26:0] camera,
    input  wire [26:0] pattern,
    input  wire [26:0] stored,
    output wire        pix_hold,
    output wire [23:0] data,
    output wire        de,
    output wire        hsync,
    output wire        vsync
);

  source_switch #(
      .CLK_PER_US(CLK_PER_US),
      .QUIET_US  (QUIET_US),
      .HOLD_US   (HOLD_US)
  ) switch (
      .clk          (clk),
      .rst          (rst),
      .want         (want),
      .camera_locked(camera_locked),
      .local_locked (local_locked),
      .select_local (select_local),
      .ignore_camera(ignore_camera),
      .ignore_local (ignore_local),
      .source       (source),
      .hold         (hold)
  );

  source_mux mux (
      .pix_clk (pix_clk),
      .hold    (hold),
      .source  (source),
      .camera  (camera),
      .pattern (pattern),
      .stored  (stored),
      .pix_hold(pix_hold),
      .data    (data),
      .de      (de),
      .hsync   (hsync),
      .vsync   (vsync)
  );

endmodule

`default_nettype wire
