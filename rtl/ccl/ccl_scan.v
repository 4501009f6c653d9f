// SPDX-License-Identifier: Apache-2.0
// Turns pixels into column events: with one line of memory and one pixel of look-ahead it sees where runs of the line above
// and of the current line end, and whether they touch. One event a column, two clocks after the pixel to its right (three
// after the pixel itself, at the end of a line); after the last line, one event a run that is still open below.
//
// Of two runs that overlap, the one that ends first gives the event. `touch` means that the run that ends is 8-connected to the
// next run of the other line that has not ended: both hold this column or the next one.

`default_nettype none

module ccl_scan #(
    parameter MAX_WIDTH = 1280,
    parameter X_BITS    = 11
) (
    input wire clk,
    input wire rst,

    input wire              run,            // 0: nothing moves, no pixel comes
    input wire              beat,           // a pixel comes
    input wire              pixel_valid,    // and it is one of a good frame
    input wire              pixel,
    input wire [X_BITS-1:0] pixel_x,
    input wire              first_line,
    input wire              start_of_frame,
    input wire              end_of_line,
    input wire              end_of_frame,
    input wire              open_runs,      // not all runs of the last line have ended

    output reg restart,        // a new frame; events of the old one end
    output reg column,         // a column of the frame, in raster order
    output reg column_last,    // of a line
    output reg column_set,     // the pixel is set
    output reg column_begin,   // and the one to the left is not
    output reg end_above,
    output reg end_here,
    output reg touch,
    output reg end_frame       // after the last event of a frame
);
    (* ram_style = "block" *)
    reg line_above[0:MAX_WIDTH-1];

    // a: the newest pixel, b: the one to its left.
    reg a_valid_reg, a_start_reg, a_last_reg, a_end_reg, a_first_line_reg, a_here_reg, a_read_reg;
    reg b_valid_reg, b_last_reg, b_end_reg, b_here_reg, b_above_reg, b_begin_reg;
    wire a_above = a_read_reg && !a_first_line_reg;

    // Pixels of a bad frame may go into the memory: the first line of the next frame replaces what the others look at. So
    // the memory need not wait for what says whether the frame is good.
    always @(posedge clk) begin
        if (beat) begin
            a_read_reg <= line_above[pixel_x];
            line_above[pixel_x] <= pixel;
        end
    end

    // A start of frame while b waits for its right neighbour: b belongs to an unfinished frame.
    wire a_abandons = a_valid_reg && a_start_reg;
    wire b_done = b_valid_reg && !a_abandons && (b_last_reg || a_valid_reg);
    wire right_here = a_here_reg && !b_last_reg;
    wire right_above = a_above && !b_last_reg;
    wire ends_here = b_here_reg && !right_here;
    wire ends_above = b_above_reg && !right_above;
    wire near_here = b_here_reg || right_here;
    wire near_above = b_above_reg || right_above;

    // After the last line its runs end as those above, one a clock.
    reg flush_reg;
    wire flush_run = flush_reg && open_runs;

    always @(posedge clk) begin
        if (beat) begin
            a_start_reg      <= start_of_frame;
            a_last_reg       <= end_of_line;
            a_end_reg        <= end_of_frame;
            a_first_line_reg <= first_line;
            a_here_reg       <= pixel;
        end
        if (run && a_valid_reg) begin
            b_last_reg  <= a_last_reg;
            b_end_reg   <= a_end_reg;
            b_here_reg  <= a_here_reg;
            b_above_reg <= a_above;
            b_begin_reg <= a_here_reg && !(b_done && !b_last_reg && b_here_reg);
        end
        column_last  <= b_last_reg;
        column_set   <= b_here_reg;
        column_begin <= b_begin_reg;
    end

    always @(posedge clk) begin
        restart   <= run && a_abandons;
        column    <= run && b_done;
        end_above <= run && (flush_run || (b_done && ends_above));
        end_here  <= run && b_done && ends_here;
        touch     <= run && b_done && (ends_here || ends_above) && near_here && near_above;
        end_frame <= run && flush_reg && !flush_run;
        if (run) begin
            a_valid_reg <= pixel_valid;
            if (a_valid_reg) b_valid_reg <= 1'b1;
            else if (b_done) b_valid_reg <= 1'b0;
            if (b_done && b_end_reg) flush_reg <= 1'b1;
            else if (!flush_run) flush_reg <= 1'b0;
        end
        if (rst) begin
            restart     <= 1'b0;
            column      <= 1'b0;
            end_above   <= 1'b0;
            end_here    <= 1'b0;
            touch       <= 1'b0;
            end_frame   <= 1'b0;
            a_valid_reg <= 1'b0;
            b_valid_reg <= 1'b0;
            flush_reg   <= 1'b0;
        end
    end
endmodule

`default_nettype wire
