// SPDX-License-Identifier: Apache-2.0
// Connected-component labelling of a binary video stream, exact for every input: area, bounding box and sums of x, y, xx,
// yy, xy of each 8-connected component, in one pass, without a frame buffer and without labels that point to labels.
//
// Stream in      1 bit a pixel; frame contract of docs/design.md.
// Stream out     object stream of docs/design.md, in the raster order of the components' last pixels.
// Throughput     1 pixel a clock, blanking not needed, for every image. From the last pixel of a frame to the first of the next
//                9 clocks and one for each run of set pixels in the last line: at most 9 + (MAX_WIDTH + 1) / 2.
// Latency        an object comes 8 clocks after the pixel below and to the right of its last pixel (in raster order); 9 after the
//                pixel below if the line ends there; in the last line with the flush. See docs/cores/ccl.md.
// Border         pixels outside the frame are not set.
// Rounding       none: all sums are integers.
// Backpressure   nothing is lost: a stalled output stalls the input. 26 components are queued before that.
// Overflow       none: memories hold the worst case of MAX_WIDTH, sums the worst case of a frame.
// Sampling       cfg_* are sampled with the start of each frame.
// Malformed      all unfinished components are forgotten in one clock; those already sent stay sent, no trailer follows, and
//                tuser marks the first beat of the next frame. A frame cut off within 6 pixels is filtered with the
//                cfg_min_area of the next one.
// Limits         MAX_WIDTH and MAX_HEIGHT 4 to 32768. MOMENTS 0: only area and box; 1: and sums of x, y; 2: and of xx, yy, xy.
//                AREA 0, with MOMENTS 0: only the box, and cfg_min_area is not looked at. What is not built is 0 in the beat.

`default_nettype none

module ccl #(
    parameter MAX_WIDTH  = 1280,
    parameter MAX_HEIGHT = 720,
    parameter AREA       = 1,
    parameter MOMENTS    = 2
) (
    input wire clk,
    input wire rst,

    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
    input wire [31:0] cfg_min_area,
    input wire        cfg_label_zeros,

    input  wire [0:0] s_axis_tdata,
    input  wire       s_axis_tvalid,
    output wire       s_axis_tready,
    input  wire       s_axis_tuser,
    input  wire       s_axis_tlast,

    output wire [511:0] m_axis_tdata,
    output wire         m_axis_tvalid,
    input  wire         m_axis_tready,
    output wire         m_axis_tuser,
    output wire         m_axis_tlast,

    output reg  frame_started,  // the first pixel of a frame was taken
    output reg  last_pixel,     // the last pixel of a complete frame was taken
    output wire frame_error     // see frame_tracker
);
    generate
        if (MAX_WIDTH < 4 || MAX_WIDTH > 32768) begin : g_width
            ERROR_max_width_must_be_4_to_32768 error_instance ();
        end
        if (MAX_HEIGHT < 4 || MAX_HEIGHT > 32768) begin : g_height
            ERROR_max_height_must_be_4_to_32768 error_instance ();
        end
        if (MOMENTS < 0 || MOMENTS > 2) begin : g_moments
            ERROR_moments_must_be_0_to_2 error_instance ();
        end
        if (AREA != 1 && (AREA != 0 || MOMENTS != 0)) begin : g_area
            ERROR_area_must_be_1_or_without_moments_0 error_instance ();
        end
    endgenerate

    // Bits that hold 0 to `greatest`.
    function integer bits_for;
        input [63:0] greatest;
        begin
            bits_for = 1;
            while ((greatest >> bits_for) != 0) bits_for = bits_for + 1;
        end
    endfunction

    localparam [31:0] MAX_WIDTH_32 = MAX_WIDTH;
    localparam [31:0] MAX_HEIGHT_32 = MAX_HEIGHT;
    localparam [63:0] W = {32'd0, MAX_WIDTH_32};
    localparam [63:0] H = {32'd0, MAX_HEIGHT_32};
    localparam X_BITS = bits_for(W - 1);
    localparam Y_BITS = bits_for(H - 1);
    localparam AREA_BITS = bits_for(W * H);
    localparam SUM_X_BITS = bits_for(H * (W * (W - 1) / 2));
    localparam SUM_Y_BITS = bits_for(W * (H * (H - 1) / 2));
    localparam SUM_XX_BITS = bits_for(H * ((W - 1) * W * (2 * W - 1) / 6));
    localparam SUM_YY_BITS = bits_for(W * ((H - 1) * H * (2 * H - 1) / 6));
    localparam SUM_XY_BITS = bits_for((W * (W - 1) / 2) * (H * (H - 1) / 2));
    localparam RECORD_BITS = 2 * X_BITS + Y_BITS +
        (AREA != 0 ? AREA_BITS : 0) +
        (MOMENTS >= 1 ? SUM_X_BITS + SUM_Y_BITS : 0) +
        (MOMENTS >= 2 ? SUM_XX_BITS + SUM_YY_BITS + SUM_XY_BITS : 0);
    // Live slots: runs of the line above from p on and runs of the current line up to c, at most W / 2 + 2 in all.
    localparam SLOT_BITS = bits_for(W / 2 + 2);

    wire almost_full, found, found_start, found_end;
    wire [RECORD_BITS-1:0] found_record;
    wire [Y_BITS-1:0] found_max_y;

    // Between the last pixel of a frame and its trailer no pixel is taken.
    reg closing_reg;
    wire run = !almost_full;
    assign s_axis_tready = run && !closing_reg;
    wire beat = s_axis_tvalid && s_axis_tready;

    wire accept, sof, eol, eof;
    wire [X_BITS-1:0] x;
    wire [15:0] y;
    wire [15-X_BITS:0] unused_x;
    wire unused_sol;
    wire [15:0] unused_last_x, unused_last_y;

    frame_tracker #(
        .MAX_WIDTH (MAX_WIDTH),
        .MAX_HEIGHT(MAX_HEIGHT)
    ) tracker (
        .clk(clk),
        .rst(rst),
        .cfg_width(cfg_width),
        .cfg_height(cfg_height),
        .beat(beat),
        .beat_user(s_axis_tuser),
        .beat_last(s_axis_tlast),
        .accept(accept),
        .sof(sof),
        .sol(unused_sol),
        .eol(eol),
        .eof(eof),
        .x({unused_x, x}),
        .y(y),
        .last_x(unused_last_x),
        .last_y(unused_last_y),
        .frame_error(frame_error)
    );

    reg label_zeros_reg;
    // More than any area if cfg_min_area is.
    reg [AREA_BITS:0] min_area_reg;
    wire label_zeros = sof ? cfg_label_zeros : label_zeros_reg;

    always @(posedge clk) begin
        frame_started <= accept && sof;
        last_pixel    <= accept && eof;
        if (accept && eof) closing_reg <= 1'b1;
        if (found_end) closing_reg <= 1'b0;
        if (beat && sof) begin
            label_zeros_reg <= cfg_label_zeros;
            min_area_reg    <= {|cfg_min_area[31:AREA_BITS], cfg_min_area[AREA_BITS-1:0]};
        end
        if (rst) begin
            frame_started <= 1'b0;
            last_pixel    <= 1'b0;
            closing_reg   <= 1'b0;
        end
    end

    wire restart, column, column_last, column_set, column_begin, end_above, end_here, touch, end_frame, open_runs;

    ccl_scan #(
        .MAX_WIDTH(MAX_WIDTH),
        .X_BITS(X_BITS)
    ) scan (
        .clk(clk),
        .rst(rst),
        .run(run),
        .beat(beat),
        .pixel_valid(accept),
        .pixel(s_axis_tdata[0] ^ label_zeros),
        .pixel_x(x),
        .first_line(y == 16'd0),
        .start_of_frame(sof),
        .end_of_line(eol),
        .end_of_frame(eof),
        .open_runs(open_runs),
        .restart(restart),
        .column(column),
        .column_last(column_last),
        .column_set(column_set),
        .column_begin(column_begin),
        .end_above(end_above),
        .end_here(end_here),
        .touch(touch),
        .end_frame(end_frame)
    );

    wire [SLOT_BITS-1:0] above, load_slot, save_slot;
    wire load, keep, add_run, complete, save;
    reg start_1_reg, end_1_reg;

    always @(posedge clk) begin
        start_1_reg <= restart && !rst;
        end_1_reg   <= end_frame && !rst;
    end

    ccl_lists #(
        .SLOT_BITS(SLOT_BITS)
    ) lists (
        .clk(clk),
        .rst(rst),
        .restart(restart),
        .end_above(end_above),
        .end_here(end_here),
        .touch(touch),
        .above(above),
        .open_runs(open_runs),
        .load(load),
        .load_slot(load_slot),
        .keep(keep),
        .add_run(add_run),
        .complete(complete),
        .save(save),
        .save_slot(save_slot)
    );

    wire [Y_BITS-1:0] line;
    wire [RECORD_BITS-1:0] run_record;

    ccl_run #(
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
    ) run_sums (
        .clk(clk),
        .restart_in(restart),
        .column_in(column),
        .last_in(column_last),
        .set_in(column_set),
        .begin_in(column_begin),
        .line(line),
        .record(run_record)
    );

    ccl_store #(
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
        .RECORD_BITS(RECORD_BITS),
        .SLOT_BITS(SLOT_BITS)
    ) store (
        .clk(clk),
        .rst(rst),
        .read_slot(above),
        .load(load),
        .load_slot(load_slot),
        .keep(keep),
        .add_run(add_run),
        .complete(complete),
        .save(save),
        .save_slot(save_slot),
        .start_frame(start_1_reg),
        .end_frame(end_1_reg),
        .line(line),
        .run_record(run_record),
        .min_area(min_area_reg),
        .found(found),
        .found_start(found_start),
        .found_end(found_end),
        .found_record(found_record),
        .found_max_y(found_max_y)
    );

    ccl_send #(
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
    ) send (
        .clk(clk),
        .rst(rst),
        .found_start(found_start),
        .found(found),
        .found_end(found_end),
        .found_record(found_record),
        .found_max_y(found_max_y),
        .almost_full(almost_full),
        .m_axis_tdata(m_axis_tdata),
        .m_axis_tvalid(m_axis_tvalid),
        .m_axis_tready(m_axis_tready),
        .m_axis_tuser(m_axis_tuser),
        .m_axis_tlast(m_axis_tlast)
    );
endmodule

`default_nettype wire
