// SPDX-License-Identifier: Apache-2.0
// A source of raw video for where there is no camera yet: a landing pad on a white sheet, on textured gray ground, as large as
// a camera 1 m above it would show it. It stands in the middle, or travels over the picture.
//
// Latency     7 cycles from pix_rst falling to the first pixel. move is taken once a frame, with the clock edge 6 before the
//             one on which out_vsync rises, and counts for the next frame.
// Throughput  one pixel a cycle of pix_clk.
// Border      what of the sheet lies outside the picture is cut off; its path does not lead there.
// Rounding    a pixel belongs to a shape if its centre lies within or on the edge, exactly; the pad's centre is a pixel.
// Overflow    none: places, squares and sums are computed wide enough for every size.
// Limits      The path ends halfway to where the sheet would leave the picture: farther out a lens bends what it shows, and
//             this drawing is flat. Syncs are 1 while active. pix_rst comes from a flip-flop.

`default_nettype none

module pattern_source #(
    parameter WIDTH   = 1280,
    parameter H_FRONT = 110,
    parameter H_SYNC  = 40,
    parameter H_TOTAL = 1650,
    parameter HEIGHT  = 720,
    parameter V_FRONT = 5,
    parameter V_SYNC  = 5,
    parameter V_TOTAL = 750
) (
    input wire pix_clk,
    input wire pix_rst,

    input wire move,

    output reg [23:0] out_data,
    output reg        out_de,
    output reg        out_hsync,
    output reg        out_vsync
);

  // Of a place relative to the centre, with its sign.
  localparam LONGER = WIDTH > HEIGHT ? WIDTH : HEIGHT;
  localparam BITS = LONGER > 1 ? $clog2(LONGER) + 1 : 2;

  // ---- The pad in pixels. A focal length of 552 pixels for 720 lines makes HEIGHT x 23 / 30,000,000 of a micrometre at 1 m.

  localparam [31:0] COLUMNS = WIDTH;
  localparam [31:0] ROWS = HEIGHT;
  localparam [63:0] LINES = {32'd0, ROWS};
  localparam [63:0] SCALE = 23 * LINES;
  localparam [63:0] PER_UM = 30000000;
  localparam [63:0] UP = PER_UM - 1;

  localparam [63:0] SQUARE_SIDE = 25000 * SCALE / PER_UM;  // each side of the centre
  localparam [63:0] SQUARE_TOP = 77771 * SCALE / PER_UM;  // above it
  localparam [63:0] SQUARE_BOTTOM = (27771 * SCALE + UP) / PER_UM;
  localparam [63:0] RECTANGLE_SIDE = 50000 * SCALE / PER_UM;
  localparam [63:0] RECTANGLE_TOP = (25806 * SCALE + UP) / PER_UM;  // below it
  localparam [63:0] RECTANGLE_BOTTOM = 75806 * SCALE / PER_UM;
  localparam [63:0] SHEET_LEFT = 152820 * SCALE / PER_UM;
  localparam [63:0] SHEET_RIGHT = 144180 * SCALE / PER_UM;
  localparam [63:0] SHEET_TOP = 200066 * SCALE / PER_UM;
  localparam [63:0] SHEET_BOTTOM = 219934 * SCALE / PER_UM;

  // Squares of radii, which are in tenths of a millimetre here.
  localparam [63:0] SQUARED = SCALE * SCALE;
  localparam [63:0] PER_SQUARE = 64'd90000000000;
  localparam [63:0] RING_OUTER = 1250 * 1250 * SQUARED / PER_SQUARE;
  localparam [63:0] RING_INNER = 1000 * 1000 * SQUARED / PER_SQUARE;
  localparam [63:0] SMALL_OUTER = 175 * 175 * SQUARED / PER_SQUARE;
  localparam [63:0] SMALL_INNER = 75 * 75 * SQUARED / PER_SQUARE;

  localparam [63:0] MIDDLE_X = {32'd0, COLUMNS} / 2;
  localparam [63:0] MIDDLE_Y = LINES / 2;
  localparam [63:0] AFTER_X = {32'd0, COLUMNS} - 1 - MIDDLE_X;
  localparam [63:0] AFTER_Y = LINES - 1 - MIDDLE_Y;
  localparam [63:0] ROOM_LEFT = MIDDLE_X > SHEET_LEFT ? MIDDLE_X - SHEET_LEFT : 0;
  localparam [63:0] ROOM_RIGHT = AFTER_X > SHEET_RIGHT ? AFTER_X - SHEET_RIGHT : 0;
  localparam [63:0] ROOM_ABOVE = MIDDLE_Y > SHEET_TOP ? MIDDLE_Y - SHEET_TOP : 0;
  localparam [63:0] ROOM_BELOW = AFTER_Y > SHEET_BOTTOM ? AFTER_Y - SHEET_BOTTOM : 0;
  localparam [63:0] TRAVEL_X = (ROOM_LEFT < ROOM_RIGHT ? ROOM_LEFT : ROOM_RIGHT) / 2;
  localparam [63:0] TRAVEL_Y = (ROOM_ABOVE < ROOM_BELOW ? ROOM_ABOVE : ROOM_BELOW) / 2;

  localparam [7:0] WHITE = 8'd232;
  localparam [7:0] BLACK = 8'd24;
  localparam [7:0] GROUND = 8'd112;  // and up to 31 more

  // ---- Where the pixel is, and where the pad.

  wire [15:0] x, y;
  wire de, hsync, vsync;

  video_timing #(
      .WIDTH  (WIDTH),
      .H_FRONT(H_FRONT),
      .H_SYNC (H_SYNC),
      .H_TOTAL(H_TOTAL),
      .HEIGHT (HEIGHT),
      .V_FRONT(V_FRONT),
      .V_SYNC (V_SYNC),
      .V_TOTAL(V_TOTAL)
  ) timing (
      .pix_clk(pix_clk),
      .pix_rst(pix_rst),
      .x      (x),
      .y      (y),
      .de     (de),
      .hsync  (hsync),
      .vsync  (vsync)
  );

  wire [31:0] unused_place = {x, y};
  wire [BITS-2:0] path_x, path_y;
  reg vsync_reg;
  reg move_reg;
  wire frame_end = vsync && !vsync_reg;

  pattern_path #(
      .BITS  (BITS - 1),
      .MIDDLE(WIDTH / 2),
      .TRAVEL(TRAVEL_X[31:0])
  ) along (
      .pix_clk(pix_clk),
      .pix_rst(pix_rst),
      .step   (frame_end),
      .place  (path_x)
  );

  pattern_path #(
      .BITS  (BITS - 1),
      .MIDDLE(HEIGHT / 2),
      .TRAVEL(TRAVEL_Y[31:0])
  ) down (
      .pix_clk(pix_clk),
      .pix_rst(pix_rst),
      .step   (frame_end),
      .place  (path_y)
  );

  reg [BITS-2:0] centre_x_reg, centre_y_reg;

  always @(posedge pix_clk) begin
    vsync_reg <= vsync;
    if (frame_end) move_reg <= move;
    // A cycle after the path has moved on: pixels come no sooner than one cycle later.
    centre_x_reg <= move_reg ? path_x : MIDDLE_X[BITS-2:0];
    centre_y_reg <= move_reg ? path_y : MIDDLE_Y[BITS-2:0];
    if (pix_rst) begin
      vsync_reg    <= 1'b0;
      move_reg     <= 1'b0;
      centre_x_reg <= MIDDLE_X[BITS-2:0];
      centre_y_reg <= MIDDLE_Y[BITS-2:0];
    end
  end

  // ---- Syncs and the ground, beside the stages below: one for each cycle of the latency but the last.

  reg [2:0] sync_reg[1:6];
  reg [4:0] ground_reg[1:6];
  integer stage;

  always @(posedge pix_clk) begin
    sync_reg[1]   <= {de, hsync, vsync};
    ground_reg[1] <= x[7:3] ^ y[7:3];
    for (stage = 2; stage <= 6; stage = stage + 1) begin
      sync_reg[stage]   <= sync_reg[stage-1];
      ground_reg[stage] <= ground_reg[stage-1];
    end
    if (pix_rst) for (stage = 1; stage <= 6; stage = stage + 1) sync_reg[stage] <= 3'd0;
  end

  // ---- Stage 1: the place relative to the centre. In blanking it may be anything.

  reg signed [BITS-1:0] x_1_reg, y_1_reg;

  always @(posedge pix_clk) begin
    x_1_reg <= {1'b0, x[BITS-2:0]} - {1'b0, centre_x_reg};
    y_1_reg <= {1'b0, y[BITS-2:0]} - {1'b0, centre_y_reg};
  end

  // ---- Stages 2 to 6: boxes.

  localparam signed [BITS-1:0] SQUARE_X = SQUARE_SIDE[BITS-1:0];
  localparam signed [BITS-1:0] SQUARE_FROM = SQUARE_TOP[BITS-1:0];
  localparam signed [BITS-1:0] SQUARE_TO = SQUARE_BOTTOM[BITS-1:0];
  localparam signed [BITS-1:0] RECTANGLE_X = RECTANGLE_SIDE[BITS-1:0];
  localparam signed [BITS-1:0] RECTANGLE_FROM = RECTANGLE_TOP[BITS-1:0];
  localparam signed [BITS-1:0] RECTANGLE_TO = RECTANGLE_BOTTOM[BITS-1:0];
  localparam signed [BITS-1:0] SHEET_X_FROM = SHEET_LEFT[BITS-1:0];
  localparam signed [BITS-1:0] SHEET_X_TO = SHEET_RIGHT[BITS-1:0];
  localparam signed [BITS-1:0] SHEET_Y_FROM = SHEET_TOP[BITS-1:0];
  localparam signed [BITS-1:0] SHEET_Y_TO = SHEET_BOTTOM[BITS-1:0];

  reg square_x_reg, square_y_reg;
  reg rectangle_x_reg, rectangle_y_reg;
  reg sheet_x_reg, sheet_y_reg;
  reg [1:0] box_reg[3:6];  // {black, white}
  integer later;

  always @(posedge pix_clk) begin
    square_x_reg    <= x_1_reg >= -SQUARE_X && x_1_reg <= SQUARE_X;
    square_y_reg    <= y_1_reg >= -SQUARE_FROM && y_1_reg <= -SQUARE_TO;
    rectangle_x_reg <= x_1_reg >= -RECTANGLE_X && x_1_reg <= RECTANGLE_X;
    rectangle_y_reg <= y_1_reg >= RECTANGLE_FROM && y_1_reg <= RECTANGLE_TO;
    sheet_x_reg     <= x_1_reg >= -SHEET_X_FROM && x_1_reg <= SHEET_X_TO;
    sheet_y_reg     <= y_1_reg >= -SHEET_Y_FROM && y_1_reg <= SHEET_Y_TO;

    box_reg[3] <= {
      (square_x_reg && square_y_reg) || (rectangle_x_reg && rectangle_y_reg), sheet_x_reg && sheet_y_reg
    };
    for (later = 4; later <= 6; later = later + 1) box_reg[later] <= box_reg[later-1];
  end

  // ---- Stages 2 to 6: rings, by the square of the distance. Registers before and behind the multipliers may be theirs.

  localparam SQUARE_BITS = 2 * BITS - 1;

  reg signed [BITS-1:0] x_2_reg, y_2_reg;
  reg signed [SQUARE_BITS-1:0] x_3_reg, y_3_reg, x_4_reg, y_4_reg;
  reg [SQUARE_BITS-1:0] squared_reg;
  reg ring_outer_reg, ring_inner_reg, small_outer_reg, small_inner_reg;

  always @(posedge pix_clk) begin
    x_2_reg         <= x_1_reg;
    y_2_reg         <= y_1_reg;
    x_3_reg         <= x_2_reg * x_2_reg;
    y_3_reg         <= y_2_reg * y_2_reg;
    x_4_reg         <= x_3_reg;
    y_4_reg         <= y_3_reg;
    squared_reg     <= x_4_reg + y_4_reg;
    ring_outer_reg  <= squared_reg <= RING_OUTER[SQUARE_BITS-1:0];
    ring_inner_reg  <= squared_reg <= RING_INNER[SQUARE_BITS-1:0];
    small_outer_reg <= squared_reg <= SMALL_OUTER[SQUARE_BITS-1:0];
    small_inner_reg <= squared_reg <= SMALL_INNER[SQUARE_BITS-1:0];
  end

  // ---- Stage 7: the level.

  wire ring = (ring_outer_reg && !ring_inner_reg) || (small_outer_reg && !small_inner_reg);
  wire [7:0] level = ring || box_reg[6][1] ? BLACK : box_reg[6][0] ? WHITE : GROUND + {3'd0, ground_reg[6]};

  always @(posedge pix_clk) begin
    {out_de, out_hsync, out_vsync} <= sync_reg[6];
    out_data <= sync_reg[6][2] ? {3{level}} : 24'd0;
    if (pix_rst) begin
      {out_de, out_hsync, out_vsync} <= 3'd0;
      out_data <= 24'd0;
    end
  end

endmodule

`default_nettype wire
