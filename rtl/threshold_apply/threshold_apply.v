// SPDX-License-Identifier: Apache-2.0
// Gray to binary: compares each pixel with the threshold at its place, interpolated between the thresholds that
// threshold_stats told of the frame before.
//
// Nodes lie at the centres of full windows; between them the threshold is bilinear. Bright is pixel > threshold.
// m_axis_tdata is 1 for bright, or with cfg_dark_is_one for dark; sampled, like the size, with the start of each frame.
//
// A set of thresholds counts when it came whole, with the window rows and columns of the frame that runs, before the
// next start of frame is taken; that frame uses it. A frame cut off before its last row of windows leaves the older set
// in use (thresholds_stale). Without a set, or where the number of window rows or columns has changed, all pixels are
// bright (thresholds_missing). Both levels change in the cycle after a start of frame was handed over on m_axis.
//
// Latency     10 cycles.
// Throughput  1 pixel a cycle without bubbles, also between lines and frames. s_stat_axis waits only after a start of frame,
//             until the pipeline has moved by one pixel.
// Border      Beyond the outermost nodes the threshold is constant along that axis.
// Rounding    None: weights are odd numbers over 2**(WINDOW_LOG2 + 1), so every sum is exact.
// Overflow    None: a sum lies between its nodes.
// Frames      As in docs/design.md.
// Limits      1x1 to MAX_WIDTH x MAX_HEIGHT.

`default_nettype none

module threshold_apply #(
    parameter MAX_WIDTH   = 1280,
    parameter MAX_HEIGHT  = 720,
    parameter WINDOW_LOG2 = 7
) (
    input wire clk,
    input wire rst,

    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
    input wire        cfg_dark_is_one,

    input  wire [7:0] s_axis_tdata,
    input  wire       s_axis_tvalid,
    output wire       s_axis_tready,
    input  wire       s_axis_tuser,
    input  wire       s_axis_tlast,

    input  wire [31:0] s_stat_axis_tdata,
    input  wire        s_stat_axis_tvalid,
    output wire        s_stat_axis_tready,
    input  wire        s_stat_axis_tuser,
    input  wire        s_stat_axis_tlast,

    output wire m_axis_tdata,
    output wire m_axis_tvalid,
    input  wire m_axis_tready,
    output wire m_axis_tuser,
    output wire m_axis_tlast,

    output reg  thresholds_missing,
    output reg  thresholds_stale,
    output wire frame_error
);

  generate
    if (WINDOW_LOG2 < 1 || WINDOW_LOG2 > 7) begin : g_window
      ERROR_window_log2_must_be_1_to_7 error_instance ();
    end
  endgenerate

  // Cycles from stage 2 to stage 9, where the threshold of the pixel is ready.
  localparam DEPTH = 8;

  wire        advance;
  wire        accept;
  wire        sol;
  wire [15:0] x;
  wire [15:0] y;

  wire unused_sof, unused_eol, unused_eof;
  wire [15:0] unused_last_x, unused_last_y;
  // Least and greatest pixel are for those who watch the stream.
  wire    [15:0] unused_extremes = s_stat_axis_tdata[31:16];

  // Stage 1: the pixel and its place. What holds for its frame has changed with it.
  reg            valid_reg;
  reg     [ 7:0] pixel_reg;
  reg            user_reg;
  reg            last_reg;
  reg            sol_reg;
  reg     [15:0] x_reg;
  reg     [15:0] y_reg;
  reg            dark_is_one_reg;
  wire           missing;
  wire           stale;
  wire    [15:0] last_column;
  wire    [15:0] last_row;

  wire    [15:0] read_row;
  wire    [15:0] read_column;
  wire    [15:0] node_top;
  wire    [15:0] node_bottom;

  // Stages 2 to 9: what travels beside the interpolation.
  reg     [12:0] beside_reg                                    [0:DEPTH-1];
  integer        i;
  wire    [ 7:0] out_pixel;
  wire           out_user;
  wire           out_last;
  wire           out_missing;
  wire           out_stale;
  wire           out_dark_is_one;
  wire           out_valid;
  wire    [ 7:0] threshold;
  wire           bright = out_missing || out_pixel > threshold;
  wire           m_missing;
  wire           m_stale;

  assign {out_pixel, out_user, out_last, out_missing, out_stale, out_dark_is_one} = beside_reg[DEPTH-1];
  assign s_axis_tready = advance;

  frame_tracker #(
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT)
  ) tracker (
      .clk        (clk),
      .rst        (rst),
      .cfg_width  (cfg_width),
      .cfg_height (cfg_height),
      .beat       (s_axis_tvalid && s_axis_tready),
      .beat_user  (s_axis_tuser),
      .beat_last  (s_axis_tlast),
      .accept     (accept),
      .sof        (unused_sof),
      .sol        (sol),
      .eol        (unused_eol),
      .eof        (unused_eof),
      .x          (x),
      .y          (y),
      .last_x     (unused_last_x),
      .last_y     (unused_last_y),
      .frame_error(frame_error)
  );

  threshold_table #(
      .MAX_WIDTH  (MAX_WIDTH),
      .MAX_HEIGHT (MAX_HEIGHT),
      .WINDOW_LOG2(WINDOW_LOG2)
  ) nodes (
      .clk               (clk),
      .rst               (rst),
      .start             (accept && s_axis_tuser),
      .cfg_width         (cfg_width),
      .cfg_height        (cfg_height),
      .s_stat_axis_tdata (s_stat_axis_tdata[15:0]),
      .s_stat_axis_tvalid(s_stat_axis_tvalid),
      .s_stat_axis_tready(s_stat_axis_tready),
      .s_stat_axis_tuser (s_stat_axis_tuser),
      .s_stat_axis_tlast (s_stat_axis_tlast),
      .missing           (missing),
      .stale             (stale),
      .last_column       (last_column),
      .last_row          (last_row),
      .advance           (advance),
      .read_row          (read_row),
      .read_column       (read_column),
      .node_top          (node_top),
      .node_bottom       (node_bottom)
  );

  threshold_interpolate #(
      .WINDOW_LOG2(WINDOW_LOG2)
  ) interpolate (
      .clk        (clk),
      .rst        (rst),
      .advance    (advance),
      .pixel_valid(valid_reg),
      .pixel_sol  (sol_reg),
      .pixel_x    (x_reg),
      .pixel_y    (y_reg),
      .last_column(last_column),
      .last_row   (last_row),
      .read_row   (read_row),
      .read_column(read_column),
      .node_top   (node_top),
      .node_bottom(node_bottom),
      .valid      (out_valid),
      .threshold  (threshold)
  );

  axis_skid #(
      .WIDTH(5)
  ) slice (
      .clk      (clk),
      .rst      (rst),
      .s_payload({bright ^ out_dark_is_one, out_user, out_last, out_missing, out_stale}),
      .s_valid  (out_valid),
      .s_ready  (advance),
      .m_payload({m_axis_tdata, m_axis_tuser, m_axis_tlast, m_missing, m_stale}),
      .m_valid  (m_axis_tvalid),
      .m_ready  (m_axis_tready)
  );

  always @(posedge clk) begin
    if (advance) begin
      valid_reg <= accept;
      pixel_reg <= s_axis_tdata;
      user_reg  <= s_axis_tuser;
      last_reg  <= s_axis_tlast;
      sol_reg   <= sol;
      x_reg     <= x;
      y_reg     <= y;
      if (accept && s_axis_tuser) dark_is_one_reg <= cfg_dark_is_one;

      beside_reg[0] <= {pixel_reg, user_reg, last_reg, missing, stale, dark_is_one_reg};
      for (i = 1; i < DEPTH; i = i + 1) beside_reg[i] <= beside_reg[i-1];
    end

    if (m_axis_tvalid && m_axis_tready && m_axis_tuser) begin
      thresholds_missing <= m_missing;
      thresholds_stale   <= m_stale;
    end

    if (rst) begin
      valid_reg          <= 1'b0;
      thresholds_missing <= 1'b1;
      thresholds_stale   <= 1'b0;
    end
  end

endmodule

`default_nettype wire
