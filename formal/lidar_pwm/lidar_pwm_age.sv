// SPDX-License-Identifier: Apache-2.0
// lidar_pwm: what is shown is never older than it says, nor valid when too old; a stuck pin is told in time; no counter
// wraps. For any state that the registers can be in, so also for a core that has run for years.
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

  // A microsecond has some clocks, so that a change of state, which costs one, never meets the next tick.
  localparam CLK_PER_US = 4;
  reg [2:0] since_tick;
  always @(posedge clk) since_tick <= tick_us || rst ? 3'd1 : since_tick + {2'd0, since_tick != CLK_PER_US};
  always @* if (known && tick_us) assume (since_tick == CLK_PER_US);

  (* hierconn *) wire [31:0] \dut.time_reg ;
  (* hierconn *) wire [2:0] \dut.state_reg ;
  (* hierconn *) wire [15:0] \dut.filter_reg ;
  (* hierconn *) wire [1:0] \dut.sync_reg ;
  (* hierconn *) wire \dut.level_reg ;

  localparam [2:0] OFF = 3'd0;
  localparam [2:0] WAIT_LOW = 3'd1;
  localparam [2:0] WAIT_HIGH = 3'd2;
  localparam [2:0] MEASURE = 3'd3;
  localparam [2:0] RELEASE = 3'd4;

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

  // How long the pin has been at its level: in clocks until the filter must follow, then in microseconds.
  localparam [31:0] FILTER_DELAY = FILTER_CYCLES + 2;
  localparam [31:0] FOREVER = 32'hFFFFFFFF;
  reg  pin_level;
  reg [31:0] pin_clocks, stuck_us;
  wire [31:0] pin_clocks_next = lidar_in != pin_level ? 32'd1 : pin_clocks + {31'd0, pin_clocks != FILTER_DELAY};
  always @(posedge clk) begin
    pin_level  <= lidar_in;
    pin_clocks <= pin_clocks_next;
    stuck_us   <= !enable || pin_clocks_next != FILTER_DELAY ? 32'd0 : stuck_us + {31'd0, tick_us && stuck_us != FOREVER};
    if (rst) {pin_clocks, stuck_us} <= 64'd0;
  end

  localparam LOW_LIMIT = START_TIMEOUT_US + RELEASE_US + 3;
  localparam HIGH_LIMIT = MAX_MM + RELEASE_US + 3;

  always @(posedge clk)
    if (known) begin
      if (stuck_us > LOW_LIMIT && !pin_level) assert (timeout);
      if (stuck_us > HIGH_LIMIT && pin_level) assert (too_long);
      // For induction: what the filter must hold, and how long the pin can have stuck by now without a word of it.
      assert (since_tick >= 3'd1 && since_tick <= CLK_PER_US);
      assert (pin_clocks <= FILTER_DELAY);
      if (pin_clocks >= 32'd1) assert (\dut.sync_reg [0] == pin_level);
      if (pin_clocks >= 32'd2) begin
        assert (\dut.sync_reg [1] == pin_level);
        assert (\dut.level_reg == pin_level || {16'd0, \dut.filter_reg } >= pin_clocks - 32'd2);
      end
      if (stuck_us != 32'd0) assert (pin_clocks == FILTER_DELAY);
      if (stuck_us != 32'd0 && !(pin_level ? too_long : timeout))
        case (\dut.state_reg )
          WAIT_LOW: begin
            assert (!pin_level || stuck_us <= RELEASE_US + 2 + \dut.time_reg );
            assert (pin_level || stuck_us <= 32'd2 || stuck_us <= RELEASE_US + 2 && since_tick == 3'd2);
          end
          WAIT_HIGH: assert (pin_level ? stuck_us <= 32'd2 : stuck_us <= RELEASE_US + 2 + \dut.time_reg );
          MEASURE: assert (pin_level ? stuck_us <= RELEASE_US + 2 + \dut.time_reg : stuck_us <= 32'd2);
          RELEASE: assert (stuck_us <= \dut.time_reg + 32'd1);
          default: assert (1'b0);
        endcase
    end

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
        OFF: ;
        WAIT_LOW: assert (\dut.time_reg <= MAX_MM + (since_tick == 3'd1));
        MEASURE: assert (\dut.time_reg <= MAX_MM + (since_tick == 3'd1));
        WAIT_HIGH: assert (\dut.time_reg <= START_TIMEOUT_US + (since_tick == 3'd1));
        RELEASE: assert (\dut.time_reg <= RELEASE_US + (since_tick == 3'd1));
        default: assert (1'b0);
      endcase
      assert (\dut.filter_reg < FILTER_CYCLES);
    end

endmodule

`default_nettype wire
