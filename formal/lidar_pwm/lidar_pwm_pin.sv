// SPDX-License-Identifier: Apache-2.0
// lidar_pwm with short times against every waveform at the pin: glitches, edges at any clock (what a synchroniser that
// was metastable settles to), arming in mid-pulse.
`default_nettype none

module lidar_pwm_pin #(
    parameter MIN_MM = 2,
    parameter MAX_MM = 5,
    parameter MAX_AGE_US = 6,
    parameter START_TIMEOUT_US = 4,
    parameter RELEASE_US = 2,
    parameter FILTER_CYCLES = 2
) (
    input wire clk,
    input wire rst,
    input wire tick_us,
    input wire enable,
    input wire lidar_in
);

  wire lidar_drive_low, valid, updated, timeout, too_long, too_short;
  wire [31:0] distance_mm, age_us;

  lidar_pwm #(
      .MIN_MM          (MIN_MM),
      .MAX_MM          (MAX_MM),
      .MAX_AGE_US      (MAX_AGE_US),
      .START_TIMEOUT_US(START_TIMEOUT_US),
      .RELEASE_US      (RELEASE_US),
      .FILTER_CYCLES   (FILTER_CYCLES)
  ) dut (.*);

  power_up start (.*);

  reg known = 1'b0;
  always @(posedge clk) known <= 1'b1;

  // The level at the pin without glitches: what FILTER_CYCLES samples in a row agree on, two clocks after the pin.
  reg [FILTER_CYCLES+1:0] samples;
  reg level_before;
  wire level = &samples[FILTER_CYCLES+1:2] ? 1'b1 : ~|samples[FILTER_CYCLES+1:2] ? 1'b0 : level_before;

  always @(posedge clk) begin
    samples      <= {samples[FILTER_CYCLES:0], lidar_in};
    level_before <= level;
    if (rst) begin
      samples      <= {(FILTER_CYCLES + 2) {1'b1}};
      level_before <= 1'b1;
    end
  end

  // A whole pulse: its start, out of a low level, while the pin is pulled; and pulled until its end.
  reg low_seen, whole, was_pulled;
  reg [5:0] width;
  // How long the pin is let go, in microseconds.
  reg [5:0] released_for;
  reg expect_update, may_update;

  always @(posedge clk) begin
    was_pulled <= lidar_drive_low;
    // whole, width: of the pulse up to and with this cycle.
    if (!enable || rst) {low_seen, whole} <= 2'b00;
    else begin
      low_seen <= !level;
      if (level && low_seen) {whole, width} <= {1'b1, 5'd0, tick_us};
      else if (level) width <= width + {5'd0, tick_us && width != 6'h3F};
      else whole <= 1'b0;
    end
    may_update    <= enable && !rst && !level && whole && width >= MIN_MM && width <= MAX_MM;
    expect_update <= enable && !rst && !level && whole && width >= MIN_MM && width <= MAX_MM && lidar_drive_low &&
                     pulled_since_start;
    released_for <= lidar_drive_low ? 6'd0 : released_for + {5'd0, tick_us && released_for != 6'h3F};
    distance_due <= width;
  end

  // Pulled in the cycle of the start, two before it, and ever since.
  reg [2:0] pulled;
  reg pulled_since_start;
  reg [5:0] distance_due;
  always @(posedge clk) begin
    pulled <= {pulled[1:0], lidar_drive_low && enable && !rst};
    if (level && low_seen) pulled_since_start <= &pulled && lidar_drive_low;
    else if (!lidar_drive_low) pulled_since_start <= 1'b0;
  end

  always @(posedge clk)
    if (known && !rst) begin
      // A reading is a whole pulse, with its width to the tick; and each whole pulse is a reading.
      if (updated) assert (may_update && distance_mm == {26'd0, distance_due});
      if (expect_update) assert (updated);
      // Once let go while measuring, the pin floats long enough to be a new trigger.
      if (lidar_drive_low && !was_pulled && enabled_for_all) assert (released_for >= RELEASE_US);
      cover (updated && distance_mm == MAX_MM);
      cover (released_for > 6'd1 && lidar_drive_low && !was_pulled && enabled_for_all);
    end

  // Enabled without a pause since the pin was pulled last.
  reg enabled_for_all;
  always @(posedge clk)
    if (rst || !enable) enabled_for_all <= 1'b0;
    else if (lidar_drive_low) enabled_for_all <= 1'b1;

endmodule

`default_nettype wire
