// SPDX-License-Identifier: Apache-2.0
// Draws what the firmware found over the camera's picture: a box a class, the pad's centre and direction, a crosshair in
// the middle of the frame, and two lines of text.
//
// Latency     7 cycles.
// Throughput  1 pixel a cycle, no stalls of its own.
// Order       text, centre and direction, boxes (box 0 first), crosshair, tint, picture: the first that covers a pixel counts.
// Borders     none: pointwise; what lies outside the frame is not drawn.
// Rounding    the picture behind the text is a quarter as bright, rounded down.
// Overflow    none: coordinates are signed, -8192 to 8191, and everything is computed wide enough for them.
// Limits      cfg_* are sampled with the first pixel of a frame, of a malformed one too, unless cfg_hold: then the frame shows
//             what the one before sampled. Malformed frames: docs/design.md.
//
// cfg_boxes holds {bottom, right, top, left} of box 3 to box 0, 14 bits each, ends included; its line lies
// inside and is 2 pixels wide. With cfg_tint a pixel whose red is 128 or more has the colour of the last box around it. The
// direction is the line from cfg_centre to cfg_tip, drawn where a pixel is at most one from it, counted along the axis that
// changes less.

`default_nettype none

module overlay #(
    parameter MAX_WIDTH  = 1280,
    parameter MAX_HEIGHT = 720
) (
    input wire clk,
    input wire rst,

    input wire [ 15:0] cfg_width,
    input wire [ 15:0] cfg_height,
    input wire         cfg_hold,
    input wire         cfg_tint,
    input wire         cfg_show_text,
    input wire         cfg_text_bank,
    input wire         cfg_show_pad,
    input wire         cfg_show_crosshair,
    input wire [  3:0] cfg_show_boxes,
    input wire [223:0] cfg_boxes,
    input wire [ 13:0] cfg_centre_x,
    input wire [ 13:0] cfg_centre_y,
    input wire [ 13:0] cfg_tip_x,
    input wire [ 13:0] cfg_tip_y,

    input wire       text_write,
    input wire [7:0] text_address,  // {bank, line, column}
    input wire [6:0] text_char,     // ASCII; below 32: nothing

    input  wire [23:0] s_axis_tdata,   // {R, G, B}
    input  wire        s_axis_tvalid,
    output wire        s_axis_tready,
    input  wire        s_axis_tuser,
    input  wire        s_axis_tlast,
    output wire [23:0] m_axis_tdata,
    output wire        m_axis_tvalid,
    input  wire        m_axis_tready,
    output wire        m_axis_tuser,
    output wire        m_axis_tlast,

    output wire frame_error
);

  generate
    if (MAX_WIDTH > 8191 || MAX_HEIGHT > 8191) begin : g_size
      ERROR_max_width_and_max_height_must_be_at_most_8191 error_instance ();
    end
  endgenerate

  // Box 0 is that of the ring, and so on.
  localparam [23:0] RING_COLOUR = 24'hFFE000;
  localparam [23:0] SQUARE_COLOUR = 24'h00FF40;
  localparam [23:0] RECTANGLE_COLOUR = 24'h00E0FF;
  localparam [23:0] SMALL_RING_COLOUR = 24'hFF40FF;
  localparam [23:0] PAD_COLOUR = 24'hFF4040;
  localparam [23:0] CROSSHAIR_COLOUR = 24'hC0C0C0;
  localparam [23:0] TEXT_COLOUR = 24'hFFFFFF;

  wire advance;
  wire accept, sof, sol, eol;
  wire [13:0] x, y;
  wire [1:0] unused_high_x, unused_high_y;
  wire unused_eof;
  wire [15:0] unused_last_x, unused_last_y;

  assign s_axis_tready = advance;

  frame_tracker #(
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT)
  ) tracker (
      .clk        (clk),
      .rst        (rst),
      .cfg_width  (cfg_width),
      .cfg_height (cfg_height),
      .beat       (s_axis_tvalid && advance),
      .beat_user  (s_axis_tuser),
      .beat_last  (s_axis_tlast),
      .accept     (accept),
      .sof        (sof),
      .sol        (sol),
      .eol        (eol),
      .eof        (unused_eof),
      .x          ({unused_high_x, x}),
      .y          ({unused_high_y, y}),
      .last_x     (unused_last_x),
      .last_y     (unused_last_y),
      .frame_error(frame_error)
  );

  // ---- Stage 1: place and colour of the pixel. Of cfg_* what the first pixel finds is kept, by each shape for itself,
  // whether the pixel is good or not: to know that takes the tracker most of a cycle.

  wire start = advance && s_axis_tvalid && s_axis_tuser;
  reg [23:0] rgb_1_reg;
  reg [13:0] x_1_reg, y_1_reg;
  reg sol_1_reg;

  always @(posedge clk) begin
    if (advance) begin
      rgb_1_reg <= s_axis_tdata;
      x_1_reg   <= x;
      y_1_reg   <= y;
      sol_1_reg <= sol;
    end
  end

  // {tuser, tlast} and whether the stage holds a pixel, of stages 1 to 6.
  reg [1:0] markers_reg[1:6];
  reg [6:1] valid_reg;
  integer stage;

  always @(posedge clk) begin
    if (advance) begin
      markers_reg[1] <= {sof, eol};
      for (stage = 2; stage <= 6; stage = stage + 1) markers_reg[stage] <= markers_reg[stage-1];
      valid_reg <= {valid_reg[5:1], accept};
    end
    if (rst) valid_reg <= 6'd0;
  end

  // ---- Stages 2 to 5: which shapes cover the pixel. Boxes are known in stage 2, the crosshair in stage 3, the text in stage
  // 4, the pad's mark in stage 5.

  wire       on_crosshair;
  wire [3:0] on_box;
  wire [3:0] in_box;

  overlay_crosshair crosshair (
      .clk        (clk),
      .rst        (rst),
      .advance    (advance),
      .start      (start),
      .hold       (cfg_hold),
      .show       (cfg_show_crosshair),
      .half_width (cfg_width[14:1]),
      .half_height(cfg_height[14:1]),
      .x          (x_1_reg),
      .y          (y_1_reg),
      .covers     (on_crosshair)
  );

  genvar box;
  generate
    for (box = 0; box < 4; box = box + 1) begin : g_box
      overlay_box shape (
          .clk   (clk),
          .rst   (rst),
          .sample(start && !cfg_hold),
          .show  (cfg_show_boxes[box]),
          .left  (cfg_boxes[56*box+:14]),
          .top   (cfg_boxes[56*box+14+:14]),
          .right (cfg_boxes[56*box+28+:14]),
          .bottom(cfg_boxes[56*box+42+:14]),
          .x     (x_1_reg),
          .y     (y_1_reg),
          .holds (in_box[box]),
          .covers(on_box[box])
      );
    end
  endgenerate

  wire text_behind;
  wire text_ink;

  overlay_text text (
      .clk    (clk),
      .rst    (rst),
      .write  (text_write),
      .address(text_address),
      .char   (text_char),
      .sample (start && !cfg_hold),
      .show   (cfg_show_text),
      .bank   (cfg_text_bank),
      .advance(advance),
      .x      (x_1_reg[13:1]),
      .y      (y_1_reg[13:1]),
      .behind (text_behind),
      .ink    (text_ink)
  );

  wire on_pad;

  overlay_pad pad (
      .clk     (clk),
      .rst     (rst),
      .advance (advance),
      .start   (start),
      .hold    (cfg_hold),
      .show    (cfg_show_pad),
      .centre_x(cfg_centre_x),
      .centre_y(cfg_centre_y),
      .tip_x   (cfg_tip_x),
      .tip_y   (cfg_tip_y),
      .valid_3 (valid_reg[3]),
      .sol_1   (sol_1_reg),
      .x_1     (x_1_reg),
      .y_1     (y_1_reg),
      .covers  (on_pad)
  );

  reg [23:0] rgb_2_reg, rgb_3_reg, rgb_4_reg;
  reg [3:0] boxes_2_reg;
  reg [4:0] shapes_3_reg;
  reg [3:0] tints_2_reg, tints_3_reg;
  reg tint_reg;
  reg [1:0] text_5_reg;
  reg on_pad_5_reg;

  always @(posedge clk) begin
    if (advance) begin
      rgb_2_reg    <= rgb_1_reg;
      rgb_3_reg    <= rgb_2_reg;
      boxes_2_reg  <= on_box;
      shapes_3_reg <= {on_crosshair, boxes_2_reg};
      tints_2_reg  <= in_box & {4{tint_reg && rgb_1_reg[23]}};
      tints_3_reg  <= tints_2_reg;
      if (start && !cfg_hold) tint_reg <= cfg_tint;
      text_5_reg   <= {text_ink, text_behind};
      on_pad_5_reg <= on_pad;
    end
  end

  // ---- Stage 4: the picture with boxes and crosshair. Stage 6: the pad's mark over it, and text over that.

  reg  [23:0] rgb_5_reg;
  reg  [23:0] rgb_6_reg;
  wire [23:0] marked = on_pad_5_reg ? PAD_COLOUR : rgb_5_reg;
  wire [23:0] dimmed = {2'b0, marked[23:18], 2'b0, marked[15:10], 2'b0, marked[7:2]};

  always @(posedge clk) begin
    if (advance) begin
      if (shapes_3_reg[0]) rgb_4_reg <= RING_COLOUR;
      else if (shapes_3_reg[1]) rgb_4_reg <= SQUARE_COLOUR;
      else if (shapes_3_reg[2]) rgb_4_reg <= RECTANGLE_COLOUR;
      else if (shapes_3_reg[3]) rgb_4_reg <= SMALL_RING_COLOUR;
      else if (shapes_3_reg[4]) rgb_4_reg <= CROSSHAIR_COLOUR;
      else if (tints_3_reg[3]) rgb_4_reg <= SMALL_RING_COLOUR;
      else if (tints_3_reg[2]) rgb_4_reg <= RECTANGLE_COLOUR;
      else if (tints_3_reg[1]) rgb_4_reg <= SQUARE_COLOUR;
      else if (tints_3_reg[0]) rgb_4_reg <= RING_COLOUR;
      else rgb_4_reg <= rgb_3_reg;

      rgb_5_reg <= rgb_4_reg;

      if (text_5_reg[1]) rgb_6_reg <= TEXT_COLOUR;
      else if (text_5_reg[0]) rgb_6_reg <= dimmed;
      else rgb_6_reg <= marked;
    end
  end

  axis_skid #(
      .WIDTH(26)
  ) output_slice (
      .clk      (clk),
      .rst      (rst),
      .s_payload({markers_reg[6], rgb_6_reg}),
      .s_valid  (valid_reg[6]),
      .s_ready  (advance),
      .m_payload({m_axis_tuser, m_axis_tlast, m_axis_tdata}),
      .m_valid  (m_axis_tvalid),
      .m_ready  (m_axis_tready)
  );

endmodule

`default_nettype wire
