// SPDX-License-Identifier: Apache-2.0
// lidar_pwm: reads a LIDAR-Lite v3 through its mode-control pin. While the pin is held low through 1 kOhm the sensor
// measures continuously and drives the pin high for 1 us per millimetre.
//
// lidar_drive_low = 1 pulls the pin low, 0 lets it float; it is never driven high.
// Latency: edge at the pin to its effect: FILTER_CYCLES + 3 clocks. updated pulses with the new distance_mm.
// Throughput: every pulse of the sensor, back to back.
// Rounding: distance_mm counts the tick_us pulses within the pulse: error less than 1 mm.
// Overflow: none; age_us saturates, and a pulse beyond MAX_MM ends as too_long. Border: none, no picture.
// Accepted pulses: MIN_MM to MAX_MM. A level that lasts less than FILTER_CYCLES clocks is a glitch and is ignored.
// A pulse counts only if its start was seen while measuring; so one that is under way at enable, reset or re-trigger
// is never used.
// age_us: microseconds since the end of the last accepted pulse; saturates; all ones before the first.
// valid: there is a reading since enable, and it is at most MAX_AGE_US old.
// Status, one bit for the last event, all 0 after an accepted pulse and while disabled:
//   timeout    no pulse started within START_TIMEOUT_US (stuck low, no return, not connected)
//   too_long   high for more than MAX_MM us (stuck high, or out of range)
//   too_short  the last pulse was shorter than MIN_MM us
// After timeout and too_long the pin is released for RELEASE_US and pulled low again: a new trigger.
// Stuck high is reported within MAX_MM + RELEASE_US + 3 us, stuck low within START_TIMEOUT_US + RELEASE_US + 3 us after
// the filter has seen it, with 4 clocks or more in a microsecond.
// Limits: a constant offset of the sensor looks like a good pulse.

`default_nettype none

module lidar_pwm #(
    parameter MIN_MM = 50,
    parameter MAX_MM = 40000,
    parameter MAX_AGE_US = 60000,
    parameter START_TIMEOUT_US = 18000,
    parameter RELEASE_US = 1000,
    parameter FILTER_CYCLES = 100
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        tick_us,
    input  wire        enable,
    input  wire        lidar_in,
    output wire        lidar_drive_low,
    output wire [31:0] distance_mm,
    output wire        valid,
    output wire [31:0] age_us,
    output wire        updated,
    output wire        timeout,
    output wire        too_long,
    output wire        too_short
);

    generate
        if (MIN_MM < 1 || MAX_MM <= MIN_MM || MAX_MM > 1000000) begin : g_range
            ERROR_min_mm_must_be_at_least_1_and_below_max_mm error_instance();
        end
        if (MAX_AGE_US < 1 || START_TIMEOUT_US < 1 || RELEASE_US < 1) begin : g_times
            ERROR_times_must_be_at_least_1_us error_instance();
        end
        if (FILTER_CYCLES < 1 || FILTER_CYCLES > 65535) begin : g_filter
            ERROR_filter_cycles_must_be_1_to_65535 error_instance();
        end
    endgenerate

    localparam [31:0] MIN_US = MIN_MM;
    localparam [31:0] MAX_US = MAX_MM;
    localparam [31:0] MAX_AGE = MAX_AGE_US;
    localparam [31:0] START_TIMEOUT = START_TIMEOUT_US;
    localparam [31:0] RELEASE_TIME = RELEASE_US;
    localparam [31:0] FILTER_LAST = FILTER_CYCLES - 1;

    // ---- The pin. Resets to high: a pin that is high then, in mid-pulse, must not look like a rising edge.

    (* ASYNC_REG = "TRUE" *) reg [1:0] sync_reg;
    reg level_reg;
    reg [15:0] filter_reg;

    always @(posedge clk) begin
        sync_reg <= {sync_reg[0], lidar_in};
        if (sync_reg[1] == level_reg) begin
            filter_reg <= 16'd0;
        end else if (filter_reg == FILTER_LAST[15:0]) begin
            level_reg <= sync_reg[1];
            filter_reg <= 16'd0;
        end else begin
            filter_reg <= filter_reg + 16'd1;
        end
        if (rst) begin
            sync_reg <= 2'b11;
            level_reg <= 1'b1;
            filter_reg <= 16'd0;
        end
    end

    // ---- The measurement.

    localparam [2:0] OFF = 3'd0;
    localparam [2:0] WAIT_LOW = 3'd1;   // so that the start of the next pulse is seen
    localparam [2:0] WAIT_HIGH = 3'd2;
    localparam [2:0] MEASURE = 3'd3;
    localparam [2:0] RELEASE = 3'd4;

    reg [2:0] state_reg;
    reg [31:0] time_reg;  // microseconds in this state
    reg [31:0] distance_reg;
    reg [31:0] age_reg;
    reg fresh_reg;
    reg updated_reg;
    reg timeout_reg;
    reg too_long_reg;
    reg too_short_reg;
    reg drive_low_reg;

    assign lidar_drive_low = drive_low_reg;
    assign distance_mm = distance_reg;
    assign valid = fresh_reg;
    assign age_us = age_reg;
    assign updated = updated_reg;
    assign timeout = timeout_reg;
    assign too_long = too_long_reg;
    assign too_short = too_short_reg;

    wire pulse_end = state_reg == MEASURE && !level_reg;
    wire accepted = pulse_end && time_reg >= MIN_US && time_reg <= MAX_US;

    always @(posedge clk) begin
        updated_reg <= 1'b0;
        if (tick_us) begin
            time_reg <= time_reg + 32'd1;
            if (age_reg != 32'hFFFFFFFF) age_reg <= age_reg + 32'd1;
        end
        // Falls in the clock in which age_us passes the limit, so an old reading is never shown as valid.
        if (tick_us && age_reg >= MAX_AGE) fresh_reg <= 1'b0;

        case (state_reg)
            WAIT_LOW: begin
                if (!level_reg) begin
                    state_reg <= WAIT_HIGH;
                    time_reg <= 32'd0;
                end else if (time_reg > MAX_US) begin
                    state_reg <= RELEASE;
                    time_reg <= 32'd0;
                    {timeout_reg, too_long_reg, too_short_reg} <= 3'b010;
                end
            end
            WAIT_HIGH: begin
                if (level_reg) begin
                    state_reg <= MEASURE;
                    time_reg <= {31'd0, tick_us};
                end else if (time_reg > START_TIMEOUT) begin
                    state_reg <= RELEASE;
                    time_reg <= 32'd0;
                    {timeout_reg, too_long_reg, too_short_reg} <= 3'b100;
                end
            end
            MEASURE: begin
                if (!level_reg) begin
                    state_reg <= WAIT_HIGH;
                    time_reg <= 32'd0;
                    {timeout_reg, too_long_reg, too_short_reg} <= {1'b0, time_reg > MAX_US, time_reg < MIN_US};
                end else if (time_reg > MAX_US) begin
                    state_reg <= RELEASE;
                    time_reg <= 32'd0;
                    {timeout_reg, too_long_reg, too_short_reg} <= 3'b010;
                end
            end
            RELEASE: begin
                if (time_reg > RELEASE_TIME) begin
                    state_reg <= WAIT_LOW;
                    time_reg <= 32'd0;
                end
            end
            default: begin  // OFF
                state_reg <= WAIT_LOW;
                time_reg <= 32'd0;
            end
        endcase

        if (accepted) begin
            distance_reg <= time_reg;
            age_reg <= 32'd0;
            fresh_reg <= 1'b1;
            updated_reg <= 1'b1;
        end

        drive_low_reg <= enable && state_reg != RELEASE;

        if (rst || !enable) begin
            state_reg <= OFF;
            fresh_reg <= 1'b0;
            updated_reg <= 1'b0;
            timeout_reg <= 1'b0;
            too_long_reg <= 1'b0;
            too_short_reg <= 1'b0;
            drive_low_reg <= 1'b0;
        end
        if (rst) begin
            age_reg <= 32'hFFFFFFFF;
            distance_reg <= 32'd0;
        end
    end

endmodule

`default_nettype wire
