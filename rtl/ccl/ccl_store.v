// SPDX-License-Identifier: Apache-2.0
// The records of the components of ccl: one memory, and one accumulator for the class at hand.
//
// Takes one command a clock from ccl_lists, never stalls. Stage 0 reads the memory at `read_slot` (while ccl_lists decides),
// stage 1 receives the command, stage 2 adds the record from the memory and that of the run, stage 3 adds the sum to the
// accumulator or replaces it, stage 4 compares: `found` is valid with `found_record`, combinational.
// A record that was saved less than four clocks before it is read is taken from the pipeline.

`default_nettype none

module ccl_store #(
    parameter AREA        = 1,
    parameter MOMENTS     = 2,
    parameter X_BITS      = 11,
    parameter Y_BITS      = 10,
    parameter AREA_BITS   = 20,
    parameter SUM_X_BITS  = 30,
    parameter SUM_Y_BITS  = 29,
    parameter SUM_XX_BITS = 39,
    parameter SUM_YY_BITS = 38,
    parameter SUM_XY_BITS = 38,
    parameter RECORD_BITS = 226,
    parameter SLOT_BITS   = 10
) (
    input wire clk,
    input wire rst,

    input wire [SLOT_BITS-1:0] read_slot,

    // Commands of ccl_lists, stage 1.
    input wire                 load,
    input wire [SLOT_BITS-1:0] load_slot,
    input wire                 keep,
    input wire                 add_run,
    input wire                 complete,
    input wire                 save,
    input wire [SLOT_BITS-1:0] save_slot,
    input wire                 start_frame,
    input wire                 end_frame,

    input wire [RECORD_BITS-1:0] run_record,  // stage 2
    input wire [     Y_BITS-1:0] line,        // stage 2
    input wire [    AREA_BITS:0] min_area,    // of the frame that starts next; counts from its start_frame on

    output wire                   found,
    output wire                   found_start,  // start of frame
    output wire                   found_end,    // end of frame; the record is that of no pixels, found_max_y is 0
    output wire [RECORD_BITS-1:0] found_record,
    output wire [     Y_BITS-1:0] found_max_y
);
    localparam SLOTS = 1 << SLOT_BITS;

    reg load_2_reg, keep_2_reg, add_run_2_reg, complete_2_reg, save_2_reg, start_2_reg, end_2_reg;
    reg keep_3_reg, complete_3_reg, save_3_reg, start_3_reg, end_3_reg;
    reg complete_4_reg, save_4_reg, start_4_reg, end_4_reg;
    reg [SLOT_BITS-1:0] save_slot_2_reg, save_slot_3_reg, save_slot_4_reg;

    reg [RECORD_BITS-1:0] memory[0:SLOTS-1];
    reg [RECORD_BITS-1:0] read_1_reg, read_2_reg, sum_3_reg, accumulator_reg, saved_4_reg;
    reg take_accumulator_2_reg;

    always @(posedge clk) begin
        read_1_reg <= memory[read_slot];
        if (save_3_reg) memory[save_slot_3_reg] <= accumulator_reg;
    end

    // Newest first: the command before this one saves when this one is in stage 2, the one before it now, the one before
    // that saved a clock ago, at the same edge at which this one read.
    always @(posedge clk) begin
        take_accumulator_2_reg <= save_2_reg && save_slot_2_reg == load_slot;
        if (save_3_reg && save_slot_3_reg == load_slot) read_2_reg <= accumulator_reg;
        else if (save_4_reg && save_slot_4_reg == load_slot) read_2_reg <= saved_4_reg;
        else read_2_reg <= read_1_reg;
    end

    wire [RECORD_BITS-1:0] loaded = take_accumulator_2_reg ? accumulator_reg : read_2_reg;
    wire [RECORD_BITS-1:0] sum_2, sum_3;

    ccl_merge #(
        .AREA(AREA),
        .MOMENTS(MOMENTS),
        .X_BITS(X_BITS),
        .Y_BITS(Y_BITS),
        .AREA_BITS(AREA_BITS),
        .SUM_X_BITS(SUM_X_BITS),
        .SUM_Y_BITS(SUM_Y_BITS),
        .SUM_XX_BITS(SUM_XX_BITS),
        .SUM_YY_BITS(SUM_YY_BITS),
        .SUM_XY_BITS(SUM_XY_BITS),
        .RECORD_BITS(RECORD_BITS)
    ) merge_run (
        .a(loaded),
        .use_a(load_2_reg),
        .b(run_record),
        .use_b(add_run_2_reg),
        .y(sum_2)
    );

    ccl_merge #(
        .AREA(AREA),
        .MOMENTS(MOMENTS),
        .X_BITS(X_BITS),
        .Y_BITS(Y_BITS),
        .AREA_BITS(AREA_BITS),
        .SUM_X_BITS(SUM_X_BITS),
        .SUM_Y_BITS(SUM_Y_BITS),
        .SUM_XX_BITS(SUM_XX_BITS),
        .SUM_YY_BITS(SUM_YY_BITS),
        .SUM_XY_BITS(SUM_XY_BITS),
        .RECORD_BITS(RECORD_BITS)
    ) merge_accumulator (
        .a(accumulator_reg),
        .use_a(keep_3_reg),
        .b(sum_3_reg),
        .use_b(1'b1),
        .y(sum_3)
    );

    // Payload.
    always @(posedge clk) begin
        load_2_reg      <= load;
        keep_2_reg      <= keep && !end_frame;
        add_run_2_reg   <= add_run;
        save_slot_2_reg <= save_slot;

        sum_3_reg       <= sum_2;
        keep_3_reg      <= keep_2_reg;
        save_slot_3_reg <= save_slot_2_reg;

        accumulator_reg <= sum_3;
        save_slot_4_reg <= save_slot_3_reg;

        // What a load that collided with the save in the memory takes.
        saved_4_reg     <= accumulator_reg;
    end

    // A component is complete in the line after its last one.
    reg [Y_BITS-1:0] max_y_3_reg, max_y_4_reg;
    always @(posedge clk) begin
        max_y_3_reg <= line - 1'b1;
        max_y_4_reg <= max_y_3_reg;
        if (end_3_reg) max_y_4_reg <= 0;
    end

    wire large_4;
    generate
        if (AREA != 0) begin : g_area
            // Components of a frame that was cut off are still on their way when the next one starts.
            reg [AREA_BITS:0] min_area_4_reg;
            always @(posedge clk) begin
                if (start_4_reg) min_area_4_reg <= min_area;
            end
            assign large_4 = {1'b0, accumulator_reg[2*X_BITS+Y_BITS+:AREA_BITS]} >= min_area_4_reg;
        end else begin : g_no_area
            assign large_4 = 1'b1;
        end
    endgenerate

    always @(posedge clk) begin
        save_2_reg     <= save;
        complete_2_reg <= complete;
        start_2_reg    <= start_frame;
        end_2_reg      <= end_frame;

        save_3_reg     <= save_2_reg;
        complete_3_reg <= complete_2_reg;
        start_3_reg    <= start_2_reg;
        end_3_reg      <= end_2_reg;

        save_4_reg     <= save_3_reg;
        complete_4_reg <= complete_3_reg;
        start_4_reg    <= start_3_reg;
        end_4_reg      <= end_3_reg;
        if (rst) begin
            save_2_reg     <= 1'b0;
            complete_2_reg <= 1'b0;
            start_2_reg    <= 1'b0;
            end_2_reg      <= 1'b0;
            save_3_reg     <= 1'b0;
            complete_3_reg <= 1'b0;
            start_3_reg    <= 1'b0;
            end_3_reg      <= 1'b0;
            save_4_reg     <= 1'b0;
            complete_4_reg <= 1'b0;
            start_4_reg    <= 1'b0;
            end_4_reg      <= 1'b0;
        end
    end

    assign found        = complete_4_reg && large_4;
    assign found_start  = start_4_reg;
    assign found_end    = end_4_reg;
    assign found_record = accumulator_reg;
    assign found_max_y  = max_y_4_reg;
endmodule

`default_nettype wire
