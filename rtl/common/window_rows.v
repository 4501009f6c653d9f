// SPDX-License-Identifier: Apache-2.0
// Vertical half of a window: from a video stream, columns of TAPS pixels around
// each pixel, the border above and below the frame filled. window_cols is the
// horizontal half; between the two a core may reduce the column (a sum, an AND),
// which keeps the shift registers of the horizontal half small.
//
// Latency     TAPS/2 lines and 2 cycles from a pixel to the column it is the
//             lowest real pixel of.
// Throughput  1 beat of PPC pixels a cycle. After the last pixel of a frame
//             s_axis_tready is 0 for TAPS/2 x width / PPC cycles: the lowest rows
//             are flushed.
// Memory      (TAPS-1) x DATA_WIDTH bits x MAX_WIDTH, one simple dual port.
// Border      BORDER, VALUE as in border_mux.
// Frames      The contract of docs/design.md, by frame_tracker. After a fault no
//             further column of the frame appears. The columns of a frame come in
//             raster order; those of a line are never split by bubbles of
//             this module's own, only by those of its input.
// Limits      Frames are a multiple of PPC wide, at least 2 beats (the line memory is
//             written a cycle after it was read) and, for reflect_101, TAPS/2 + 1
//             pixels high and wide.
//
// advance moves the whole module; it must not depend on the outputs. Wire it to
// the s_ready of the axis_skid behind the arithmetic, and to every register between.

`default_nettype none

module window_rows #(
    parameter                   TAPS       = 5,
    parameter                   DATA_WIDTH = 8,
    parameter                   BORDER     = 0,
    parameter [DATA_WIDTH-1:0] VALUE      = 0,
    parameter                   PPC        = 1,
    parameter                   MAX_WIDTH  = 1280,
    parameter                   MAX_HEIGHT = 720
) (
    input  wire                           clk,
    input  wire                           rst,
    input  wire [                   15:0] cfg_width,
    input  wire [                   15:0] cfg_height,
    input  wire [     PPC*DATA_WIDTH-1:0] s_axis_tdata,   // leftmost pixel in the low bits
    input  wire                           s_axis_tvalid,
    output wire                           s_axis_tready,
    input  wire                           s_axis_tuser,
    input  wire                           s_axis_tlast,
    input  wire                           advance,
    output reg                            column_valid,
    output reg                            column_sof,     // first columns of a frame
    output reg                            column_first,   // first columns of a line
    output reg                            column_last,    // last columns of a line
    output wire [PPC*TAPS*DATA_WIDTH-1:0] column,         // leftmost in the low bits; in each, its topmost pixel
    output wire                           frame_error
);

  localparam REACH = TAPS / 2;
  localparam WORD = PPC * DATA_WIDTH;
  localparam PPC_LOG2 = $clog2(PPC);
  localparam MAX_BEATS = MAX_WIDTH / (PPC > 0 ? PPC : 1);
  localparam X_BITS = (MAX_BEATS > 1) ? $clog2(MAX_BEATS) : 1;
  localparam REFLECT_101 = 1;
  localparam MIN_SIZE = (BORDER == REFLECT_101) ? REACH + 1 : 1;
  // One pixel a beat is the only case in which two beats can be too narrow a frame.
  localparam MIN_BEATS = (MIN_SIZE <= 2 * PPC) ? 2 : MIN_SIZE;

  // Beats a line. A width that is no multiple of PPC is refused like a width of 0.
  wire [15:0] cfg_beats;

  generate
    if (PPC != 1 && PPC != 2 && PPC != 4) begin : g_ppc
      ERROR_ppc_must_be_1_or_2_or_4 error_instance ();
    end
    if (MAX_BEATS * PPC != MAX_WIDTH) begin : g_multiple
      ERROR_max_width_must_be_a_multiple_of_ppc error_instance ();
    end
    if (PPC == 1) begin : g_single
      assign cfg_beats = cfg_width;
    end else begin : g_several
      assign cfg_beats = (cfg_width[PPC_LOG2-1:0] == {PPC_LOG2{1'b0}}) ? cfg_width >> PPC_LOG2 : 16'd0;
    end
  endgenerate

  wire        accept;
  wire        sof;
  wire        sol;
  wire        eol;
  wire        eof;
  wire [X_BITS-1:0] x;
  wire [X_BITS-1:0] last_x;
  wire [15-X_BITS:0] unused_x_high;
  wire [15-X_BITS:0] unused_last_x_high;
  wire [15:0] unused_y;
  wire [15:0] unused_last_y;

  reg         flush_reg;

  assign s_axis_tready = advance && !flush_reg;

  frame_tracker #(
      .MIN_WIDTH (MIN_BEATS),
      .MIN_HEIGHT(MIN_SIZE),
      .MAX_WIDTH (MAX_BEATS),
      .MAX_HEIGHT(MAX_HEIGHT)
  ) tracker (
      .clk        (clk),
      .rst        (rst),
      .cfg_width  (cfg_beats),
      .cfg_height (cfg_height),
      .beat       (s_axis_tvalid && s_axis_tready),
      .beat_user  (s_axis_tuser),
      .beat_last  (s_axis_tlast),
      .accept     (accept),
      .sof        (sof),
      .sol        (sol),
      .eol        (eol),
      .eof        (eof),
      .x          ({unused_x_high, x}),
      .y          (unused_y),
      .last_x     ({unused_last_x_high, last_x}),
      .last_y     (unused_last_y),
      .frame_error(frame_error)
  );

  // Lines are fed from the input and then, REACH of them, from the flush counter.
  reg  [X_BITS-1:0] flush_x_reg;
  reg  [ REACH-1:0] flush_inside_reg;  // bit d-1: the row d below the centre is still in the frame
  wire              flush_last = flush_x_reg == last_x;

  wire              feed = accept || flush_reg;
  wire              feed_sof = !flush_reg && sof;
  wire              feed_first = flush_reg ? flush_x_reg == {X_BITS{1'b0}} : sol;
  wire              feed_last = flush_reg ? flush_last : eol;
  wire [X_BITS-1:0] feed_x = flush_reg ? flush_x_reg : x;

  // Bit k: at least k + 1 lines of this frame were fed before the present one.
  reg  [  TAPS-2:0] lines_above_reg;
  wire [  TAPS-2:0] lines_above = feed_sof ? {(TAPS - 1) {1'b0}} : lines_above_reg;

  always @(posedge clk) begin
    if (advance && feed) begin
      lines_above_reg <= feed_last ? {lines_above[TAPS-3:0], 1'b1} : lines_above;

      if (!flush_reg) begin
        flush_reg        <= eof;
        flush_x_reg      <= {X_BITS{1'b0}};
        flush_inside_reg <= {REACH{1'b1}} >> 1;
      end else if (flush_last) begin
        flush_reg        <= flush_inside_reg != {REACH{1'b0}};
        flush_x_reg      <= {X_BITS{1'b0}};
        flush_inside_reg <= flush_inside_reg >> 1;
      end else begin
        flush_x_reg <= flush_x_reg + 1'b1;
      end
    end

    if (rst) flush_reg <= 1'b0;
  end

  // Stage 1: the lines above the pixel come from memory and, moved up by one, go back.
  (* ram_style = "block" *)
  reg  [(TAPS-1)*WORD-1:0] lines[0:MAX_BEATS-1];
  reg  [(TAPS-1)*WORD-1:0] above_reg;
  reg  [         WORD-1:0] pixel_reg;
  reg  [       X_BITS-1:0] x_reg;
  reg  [        REACH-1:0] top_inside_reg;
  reg  [        REACH-1:0] bottom_inside_reg;
  reg                      fed_reg;
  reg                      valid_reg;
  reg                      sof_reg;
  reg                      first_reg;
  reg                      last_reg;
  reg  [    TAPS*WORD-1:0] rows_reg;  // topmost row of the beat in the low bits

  wire [    TAPS*WORD-1:0] raw = {pixel_reg, above_reg};
  wire [    TAPS*WORD-1:0] resolved;

  always @(posedge clk) begin
    if (advance) above_reg <= lines[feed_x];
  end

  always @(posedge clk) begin
    if (advance && fed_reg) lines[x_reg] <= raw[TAPS*WORD-1:WORD];
  end

  border_mux #(
      .TAPS      (TAPS),
      .DATA_WIDTH(WORD),
      .BORDER    (BORDER),
      .VALUE     ({PPC{VALUE}})
  ) rows_border (
      .taps    (raw),
      .low_ok  (top_inside_reg),
      .high_ok (bottom_inside_reg),
      .resolved(resolved)
  );

  always @(posedge clk) begin
    if (advance) begin
      pixel_reg         <= s_axis_tdata;
      x_reg             <= feed_x;
      fed_reg           <= feed;
      // The centre is REACH lines above the fed one: it exists once that many were fed.
      valid_reg         <= feed && lines_above[REACH-1];
      top_inside_reg    <= lines_above[TAPS-2:REACH];
      bottom_inside_reg <= flush_reg ? flush_inside_reg : {REACH{1'b1}};
      sof_reg           <= feed_first && !lines_above[REACH];
      first_reg         <= feed_first;
      last_reg          <= feed_last;

      column_valid      <= valid_reg;
      column_sof        <= sof_reg;
      column_first      <= first_reg;
      column_last       <= last_reg;
      rows_reg          <= resolved;
    end

    if (rst) begin
      fed_reg      <= 1'b0;
      valid_reg    <= 1'b0;
      column_valid <= 1'b0;
    end
  end

  genvar pixel, row;
  generate
    for (pixel = 0; pixel < PPC; pixel = pixel + 1) begin : g_pixel
      for (row = 0; row < TAPS; row = row + 1) begin : g_row
        assign column[(pixel*TAPS+row)*DATA_WIDTH+:DATA_WIDTH] = rows_reg[row*WORD+pixel*DATA_WIDTH+:DATA_WIDTH];
      end
    end
  endgenerate

endmodule

`default_nettype wire
