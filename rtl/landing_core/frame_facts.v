// SPDX-License-Identifier: Apache-2.0
// What the record says of a frame besides its objects, from the frame's start in ccl until its trailer is written.
//
// The values at the inputs are taken with frame_started; with last_pixel they are queued, together with the time that
// the frame took. The outputs are those of the oldest frame queued, until pop. Only complete frames have a trailer, and
// only they are queued: what was taken of a frame that is cut off is overwritten by the next one.
// Latency: the outputs hold a frame's values in the clock after its last_pixel, if it is the oldest; ccl offers its
// trailer later than that.
// Overflow: none. Each entry has its trailer in the queue of ccl or in the pipeline before it, for which that queue
// keeps room; so there are never more entries than DEPTH, the depth of that queue (ccl_send). A test fills it.
// Limits: frame_number and frame_start_us must still be those of the frame in the clock of its frame_started.

`default_nettype none

module frame_facts (
    input wire clk,
    input wire rst,

    input wire frame_started,
    input wire last_pixel,
    input wire pop,

    input wire [31:0] time_us,
    input wire [31:0] frame_number,
    input wire [63:0] frame_start_us,
    input wire [15:0] width,
    input wire [15:0] height,
    input wire [8:0]  factor,
    input wire [31:0] min_area,
    input wire        thresholds_missing,

    output wire [31:0] queued_number,
    output wire [63:0] queued_start_us,
    output wire [15:0] queued_width,
    output wire [15:0] queued_height,
    output wire [8:0]  queued_factor,
    output wire [31:0] queued_min_area,
    output wire        queued_missing,
    output wire        queued_stale,
    output wire [31:0] queued_scan_time_us
);

    localparam DEPTH_BITS = 5;
    localparam DEPTH = 1 << DEPTH_BITS;
    localparam ENTRY_BITS = 32 + 64 + 16 + 16 + 9 + 32 + 1 + 1 + 32;

    reg [31:0] number_reg;
    reg [63:0] start_us_reg;
    reg [15:0] width_reg;
    reg [15:0] height_reg;
    reg [8:0]  factor_reg;
    reg [31:0] min_area_reg;
    reg        missing_reg;
    reg        stale_reg;

    // Thresholds come from the last complete frame. threshold_apply would say whether they are stale, but does not see
    // frames that end before it; the camera numbers them all.
    reg [31:0] complete_number_reg;
    wire       stale = !thresholds_missing && frame_number != complete_number_reg + 32'd1;

    always @(posedge clk) begin
        if (frame_started) begin
            number_reg <= frame_number;
            start_us_reg <= frame_start_us;
            width_reg <= width;
            height_reg <= height;
            factor_reg <= factor;
            min_area_reg <= min_area;
            missing_reg <= thresholds_missing;
            stale_reg <= stale;
        end
        if (last_pixel) complete_number_reg <= number_reg;
    end

    wire [31:0] scan_time_us = time_us - start_us_reg[31:0];

    reg [ENTRY_BITS-1:0] queue[0:DEPTH-1];
    reg [DEPTH_BITS-1:0] write_reg, read_reg;

    always @(posedge clk) begin
        if (last_pixel) begin
            queue[write_reg] <= {
                number_reg, start_us_reg, width_reg, height_reg, factor_reg, min_area_reg, missing_reg, stale_reg,
                scan_time_us
            };
        end
    end

    always @(posedge clk) begin
        if (last_pixel) write_reg <= write_reg + 1'b1;
        if (pop) read_reg <= read_reg + 1'b1;
        if (rst) begin
            write_reg <= 0;
            read_reg <= 0;
        end
    end

    assign {
        queued_number, queued_start_us, queued_width, queued_height, queued_factor, queued_min_area, queued_missing,
        queued_stale, queued_scan_time_us
    } = queue[read_reg];

endmodule

`default_nettype wire
