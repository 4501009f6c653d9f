// SPDX-License-Identifier: Apache-2.0
// lidar_pwm: what is shown is never older than it says, nor valid when too old; no counter wraps. For any state that
// the registers can be in, so also for a core that has run for years.
`default_nettype none

module lidar_pwm_age #(
    parameter MIN_MM = 50,
    parameter MAX_MM = 40000,
    parameter MAX_AGE_US = 60000,
    parameter START_TIMEOUT_US = 18000,
    parameter RELEASE_US = 1000,
    parameter FILTER_CYCLES = 100
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

  (* hierconn *) wire [31:0] \dut.time_reg ;
  (* hierconn *) wire [2:0] \dut.state_reg ;
  (* hierconn *) wire [15:0] \dut.filter_reg ;

  reg known = 1'b0;
  reg was_rst, was_enabled, was_tick, was_valid;
  reg [31:0] was_age, was_distance;

  always @(posedge clk) begin
    known        <= 1'b1;
    was_rst      <= rst;
    was_enabled  <= enable;
    was_tick     <= tick_us;
    was_valid    <= valid;
    was_age      <= age_us;
    was_distance <= distance_mm;
  end

  wire [31:0] grown = was_tick && was_age != 32'hFFFFFFFF ? was_age + 32'd1 : was_age;

  always @(posedge clk)
    if (known) begin
      // The age starts with the reading, counts each microsecond since, and stops at its greatest value.
      if (was_rst) assert (age_us == 32'hFFFFFFFF && distance_mm == 32'd0);
      else if (updated) assert (age_us == 32'd0);
      else if (was_enabled) assert (age_us == grown);
      else assert (age_us == grown || age_us == 32'd0);
      if (valid) assert (age_us <= MAX_AGE_US);
      // A value is a reading; it is valid from there on, not before, and not across a pause.
      if (updated) assert (valid && distance_mm >= MIN_MM && distance_mm <= MAX_MM);
      if (valid && !was_valid) assert (updated);
      if (distance_mm != was_distance) assert (updated || was_rst || !was_enabled);
      if (was_rst || !was_enabled) assert (!valid && !updated && !timeout && !too_long && !too_short);
      // The pin floats while nothing is measured.
      if (was_rst || !was_enabled) assert (!lidar_drive_low);
      assert ({1'b0, timeout} + {1'b0, too_long} + {1'b0, too_short} <= 2'd1);
      // Counters: far below the end of their range.
      case (\dut.state_reg )
        3'd0: ;
        3'd1, 3'd3: assert (\dut.time_reg <= MAX_MM + 1);
        3'd2: assert (\dut.time_reg <= START_TIMEOUT_US + 1);
        3'd4: assert (\dut.time_reg <= RELEASE_US + 1);
        default: assert (1'b0);
      endcase
      assert (\dut.filter_reg < FILTER_CYCLES);
    end

endmodule

`default_nettype wire
