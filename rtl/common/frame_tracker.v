// SPDX-License-Identifier: Apache-2.0
// The frame contract of docs/design.md, once for every video core: says of each
// beat whether it belongs to a good frame, and where in it.
//
// beat is the handshake (tvalid && tready); beat_user and beat_last are the
// markers of that beat. accept and what follows it are combinational and speak
// of the same beat; they mean nothing while beat is 0.
//
// Latency     0 cycles; frame_error comes 1 cycle after its beat.
// Throughput  1 beat a cycle.
// Limits      cfg_width, cfg_height are sampled with the start of frame. A frame
//             whose configured size is outside MIN_* to MAX_* is malformed from
//             its first pixel on.

`default_nettype none

module frame_tracker #(
    parameter MIN_WIDTH  = 1,
    parameter MIN_HEIGHT = 1,
    parameter MAX_WIDTH  = 1280,
    parameter MAX_HEIGHT = 720
) (
    input  wire        clk,
    input  wire        rst,
    input  wire [15:0] cfg_width,
    input  wire [15:0] cfg_height,
    input  wire        beat,
    input  wire        beat_user,
    input  wire        beat_last,
    output wire        accept,       // the beat is pixel (x, y) of a frame that is good so far
    output wire        sof,          // ... the first of its frame
    output wire        sol,          // ... the first of its line
    output wire        eol,          // ... the last of its line
    output wire        eof,          // ... the last of its frame
    output wire [15:0] x,
    output wire [15:0] y,
    output wire [15:0] last_x,       // width - 1 and height - 1 of the frame that was
    output wire [15:0] last_y,       // started last; valid from the cycle after its sof
    output reg         frame_error   // one cycle: a frame was cut off, or beats follow a complete one
);

  localparam X_BITS = (MAX_WIDTH > 1) ? $clog2(MAX_WIDTH) : 1;
  localparam Y_BITS = (MAX_HEIGHT > 1) ? $clog2(MAX_HEIGHT) : 1;
  localparam W_BITS = $clog2(MAX_WIDTH + 1);
  localparam H_BITS = $clog2(MAX_HEIGHT + 1);

  generate
    if (MIN_WIDTH < 1 || MAX_WIDTH < MIN_WIDTH || MAX_WIDTH > 32768) begin : g_width
      ERROR_max_width_must_be_at_least_the_least_width_and_at_most_32768 error_instance ();
    end
    if (MIN_HEIGHT < 1 || MAX_HEIGHT < MIN_HEIGHT || MAX_HEIGHT > 32768) begin : g_height
      ERROR_max_height_must_be_at_least_the_least_height_and_at_most_32768 error_instance ();
    end
  endgenerate

  localparam [15:0] LEAST_WIDTH = MIN_WIDTH[15:0];
  localparam [15:0] LEAST_HEIGHT = MIN_HEIGHT[15:0];
  localparam [15:0] MOST_WIDTH = MAX_WIDTH[15:0];
  localparam [15:0] MOST_HEIGHT = MAX_HEIGHT[15:0];

  // SILENT: the fault, if any, is reported; everything up to the next start is dropped.
  // FRAME: within a good frame. DONE: after the last pixel of a complete frame.
  localparam [1:0] SILENT = 2'd0;
  localparam [1:0] FRAME = 2'd1;
  localparam [1:0] DONE = 2'd2;

  reg  [       1:0] state_reg;
  reg  [X_BITS-1:0] x_reg;
  reg  [Y_BITS-1:0] y_reg;
  reg               sol_reg;
  reg  [W_BITS-1:0] width_reg;
  reg  [H_BITS-1:0] height_reg;

  // From the size to the registers of a core is its longest way. Against a constant, bits are quicker than a carry chain.
  function at_most;
    input [15:0] low;
    input [15:0] high;
    integer place;
    begin
      at_most = 1'b1;
      for (place = 0; place < 16; place = place + 1)
        at_most = high[place] ? !low[place] || at_most : !low[place] && at_most;
    end
  endfunction

  // Whether next = value + 1: a bit changes exactly where all below are 1, which the two numbers show themselves.
  function is_next;
    input [15:0] next;
    input [15:0] value;
    integer place;
    begin
      is_next = next[0] != value[0];
      for (place = 1; place < 16; place = place + 1)
        is_next = is_next && (next[place] ^ value[place]) == (value[place-1] && !next[place-1]);
    end
  endfunction

  wire              width_ok = at_most(LEAST_WIDTH, cfg_width) && at_most(cfg_width, MOST_WIDTH);
  wire              height_ok = at_most(LEAST_HEIGHT, cfg_height) && at_most(cfg_height, MOST_HEIGHT);
  wire              size_ok = width_ok && height_ok;

  wire [      15:0] width = {{(16 - W_BITS) {1'b0}}, width_reg};
  wire [      15:0] height = {{(16 - H_BITS) {1'b0}}, height_reg};
  wire [      15:0] x_now = {{(16 - X_BITS) {1'b0}}, x_reg};
  wire [      15:0] y_now = {{(16 - Y_BITS) {1'b0}}, y_reg};
  wire              at_last_x = beat_user ? cfg_width == 16'd1 : is_next(width, x_now);
  wire              at_last_y = beat_user ? cfg_height == 16'd1 : is_next(height, y_now);
  wire              in_frame = beat_user ? size_ok : state_reg == FRAME;

  assign accept = beat && in_frame && beat_last == at_last_x;
  assign sof    = beat_user;
  assign sol    = beat_user || sol_reg;
  assign eol    = at_last_x;
  assign eof    = at_last_x && at_last_y;
  assign x      = beat_user ? 16'd0 : x_now;
  assign y      = beat_user ? 16'd0 : y_now;
  assign last_x = width - 16'd1;
  assign last_y = height - 16'd1;

  always @(posedge clk) begin
    frame_error <= 1'b0;

    if (beat) begin
      if (beat_user) begin
        width_reg  <= cfg_width[W_BITS-1:0];
        height_reg <= cfg_height[H_BITS-1:0];
      end
      sol_reg <= at_last_x;
      x_reg   <= x[X_BITS-1:0] + 1'b1;
      y_reg   <= y[Y_BITS-1:0] + {{(Y_BITS - 1) {1'b0}}, at_last_x};

      if (accept) state_reg <= eof ? DONE : FRAME;
      else state_reg <= SILENT;

      // An early start and a fault in its own first beat are one event.
      if (beat_user) frame_error <= !accept || state_reg == FRAME;
      else frame_error <= !accept && state_reg != SILENT;
    end

    if (beat && at_last_x) x_reg <= {X_BITS{1'b0}};

    if (rst) begin
      state_reg   <= SILENT;
      frame_error <= 1'b0;
    end
  end

endmodule

`default_nettype wire
