// SPDX-License-Identifier: Apache-2.0
// Passes a gray stream through and tells least pixel, greatest pixel and threshold of each window of it.
//
// Windows are squares of 2**WINDOW_LOG2 pixels from the top left corner; the last of a row and the last row may be cut.
// m_stat_axis_tdata = {max, min, threshold}, threshold in Q8.8 = (min << 8) + factor * (max - min), exact, at most
// 16'hFF00. cfg_factor is Q1.8; more than 256 acts as 256; sampled, like the size, with the start of each frame.
// A window with max - min < cfg_flat_limit (sampled alike) is flat: it shows one surface, and its extremes are noise.
// Its threshold is that of the window to its left; in the first column, above it; the first window keeps its own.
// Thresholds go on through any number of flat windows. 0: no window is flat.
// A row of windows is told after its last pixel was handed over, and before the first pixel of the next frame is
// offered; a frame that is cut off tells no row that it did not complete.
//
// Latency     1 cycle for a pixel; 8 cycles from the last pixel of a row of windows to its first beat.
// Throughput  1 pixel a cycle; 1 window a cycle.
// Stall       A start of frame, and the last pixel of a row of windows, wait until the row of windows before has been
//             handed over: at most 7 cycles and one a window, plus what m_stat_axis stalls.
// Border      Windows at the right and at the bottom are cut by the frame, down to one pixel.
// Rounding    None.
// Overflow    None: each row of windows waits for the one before it.
// Limits      Frames of 1x1 to MAX_WIDTH x MAX_HEIGHT; malformed ones as in docs/design.md.

`default_nettype none

module threshold_stats #(
    parameter MAX_WIDTH   = 1280,
    parameter MAX_HEIGHT  = 720,
    parameter WINDOW_LOG2 = 7
) (
    input wire clk,
    input wire rst,

    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
    input wire [ 8:0] cfg_factor,
    input wire [ 7:0] cfg_flat_limit,

    input  wire [7:0] s_axis_tdata,
    input  wire       s_axis_tvalid,
    output wire       s_axis_tready,
    input  wire       s_axis_tuser,
    input  wire       s_axis_tlast,

    output wire [7:0] m_axis_tdata,
    output wire       m_axis_tvalid,
    input  wire       m_axis_tready,
    output wire       m_axis_tuser,
    output wire       m_axis_tlast,

    output reg  [31:0] m_stat_axis_tdata,
    output reg         m_stat_axis_tvalid,
    input  wire        m_stat_axis_tready,
    output reg         m_stat_axis_tuser,
    output reg         m_stat_axis_tlast,

    output wire frame_error
);

  localparam COLUMNS = (MAX_WIDTH + (1 << WINDOW_LOG2) - 1) >> WINDOW_LOG2;
  localparam COLUMN_BITS = (COLUMNS > 1) ? $clog2(COLUMNS) : 1;

  generate
    if (WINDOW_LOG2 < 1 || WINDOW_LOG2 > 15) begin : g_window
      ERROR_window_log2_must_be_1_to_15 error_instance ();
    end
  endgenerate

  // Input: what each pixel is, decided before the register slice, so that the configuration is that of the handshake.
  wire accept;
  wire eol;
  wire eof;
  wire [WINDOW_LOG2-1:0] x;  // Within the window.
  wire [WINDOW_LOG2-1:0] y;
  wire [15-WINDOW_LOG2:0] unused_x, unused_y;
  wire unused_sof, unused_sol;
  wire [15:0] unused_last_x, unused_last_y;
  wire window_right = &x || eol;
  wire window_top = y == {WINDOW_LOG2{1'b0}};
  wire row_end = eol && (&y || eof);
  wire [8:0] factor = cfg_factor[8] ? 9'd256 : cfg_factor;

  // Output of the register slice.
  wire p_valid;
  wire p_right;
  wire p_top;
  wire p_row_end;
  wire [8:0] p_factor;
  wire [7:0] p_flat_limit;
  reg busy_reg;  // A row of windows is complete and not all of it handed over.
  wire hold = busy_reg && (m_axis_tuser || p_row_end);
  wire take = m_axis_tvalid && m_axis_tready;

  // Where the pixel at the output of the register slice is.
  reg left_reg;
  reg line_start_reg;
  reg [COLUMN_BITS-1:0] column_reg;
  reg bank_reg;
  reg first_row_reg;
  wire line_start = m_axis_tuser || line_start_reg;
  wire left = line_start || left_reg;
  wire [COLUMN_BITS-1:0] column = line_start ? {COLUMN_BITS{1'b0}} : column_reg;
  wire one_column = column_reg == {COLUMN_BITS{1'b0}};

  // Extremes so far of the windows of a row, and of the row before while it is told.
  reg [15:0] extremes[0:(2<<COLUMN_BITS)-1];

  // Stage 1 reads the extremes of the pixel's window; stage 2 takes the pixel in; stage 3 writes them. A window of one
  // column between two pixels of another leaves no time for that: stage 2 then gets what stage 3 writes.
  reg a_valid_reg;
  reg [7:0] a_pixel_reg;
  reg a_fresh_reg;
  reg a_same_reg;
  reg a_right_reg;
  reg a_row_end_reg;
  reg [COLUMN_BITS:0] a_address_reg;
  reg b_valid_reg;
  reg [7:0] b_pixel_reg;
  reg b_fresh_reg;
  reg b_same_reg;
  reg b_right_reg;
  reg b_row_end_reg;
  reg [COLUMN_BITS:0] b_address_reg;
  reg [15:0] b_stored_reg;
  reg b_late_reg;
  reg [15:0] b_late_stored_reg;
  reg [15:0] current_reg;
  reg c_write_reg;
  reg c_row_end_reg;
  reg [COLUMN_BITS:0] c_address_reg;
  // What is stored comes late, out of memory: the rest is decided beside it.
  wire early = b_fresh_reg || b_same_reg || b_late_reg;
  wire [15:0] base = b_same_reg ? current_reg : b_late_stored_reg;
  wire [7:0] early_greatest = b_fresh_reg || b_pixel_reg > base[15:8] ? b_pixel_reg : base[15:8];
  wire [7:0] early_least = b_fresh_reg || b_pixel_reg < base[7:0] ? b_pixel_reg : base[7:0];
  wire [7:0] late_greatest = b_pixel_reg > b_stored_reg[15:8] ? b_pixel_reg : b_stored_reg[15:8];
  wire [7:0] late_least = b_pixel_reg < b_stored_reg[7:0] ? b_pixel_reg : b_stored_reg[7:0];
  wire [7:0] greatest = early ? early_greatest : late_greatest;
  wire [7:0] least = early ? early_least : late_least;

  // Telling a row of windows: read, difference, product, sum.
  reg row_first_reg;
  reg row_bank_reg;
  reg [COLUMN_BITS-1:0] row_last_reg;
  reg [8:0] factor_reg;
  reg [7:0] flat_limit_reg;
  reg walk_reg;
  reg [COLUMN_BITS-1:0] walk_column_reg;
  wire walk_left = walk_column_reg == {COLUMN_BITS{1'b0}};
  wire walk_first = row_first_reg && walk_left;
  wire walk_last = walk_column_reg == row_last_reg;
  wire go = !m_stat_axis_tvalid || m_stat_axis_tready;
  reg [2:0] t_valid_reg;
  reg [2:0] t_user_reg;
  reg [2:0] t_last_reg;
  reg [2:0] t_left_reg;
  reg [15:0] t0_extremes_reg;
  reg [15:0] t1_extremes_reg;
  reg [7:0] t1_spread_reg;
  reg [15:0] t2_extremes_reg;
  reg [15:0] t2_product_reg;
  reg t2_flat_reg;
  // At most 256 * 255, which 16 bits hold.
  wire unused_product;
  wire [15:0] product;
  // A row of windows is told without a pause, so the left neighbour is the beat that stands at the output.
  reg [15:0] above_reg;
  wire [15:0] neighbour = t_left_reg[2] ? above_reg : m_stat_axis_tdata[15:0];
  wire [15:0] threshold = t2_flat_reg ? neighbour : {t2_extremes_reg[7:0], 8'd0} + t2_product_reg;

  assign m_axis_tvalid = p_valid && !hold;
  assign {unused_product, product} = factor_reg * t1_spread_reg;

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
      .sol        (unused_sol),
      .eol        (eol),
      .eof        (eof),
      .x          ({unused_x, x}),
      .y          ({unused_y, y}),
      .last_x     (unused_last_x),
      .last_y     (unused_last_y),
      .frame_error(frame_error)
  );

  axis_skid #(
      .WIDTH(30)
  ) slice (
      .clk      (clk),
      .rst      (rst),
      .s_payload({s_axis_tdata, s_axis_tuser, eol, window_right, window_top, row_end, factor, cfg_flat_limit}),
      .s_valid  (accept),
      .s_ready  (s_axis_tready),
      .m_payload({m_axis_tdata, m_axis_tuser, m_axis_tlast, p_right, p_top, p_row_end, p_factor, p_flat_limit}),
      .m_valid  (p_valid),
      .m_ready  (m_axis_tready && !hold)
  );

  always @(posedge clk) begin
    if (take) begin
      line_start_reg <= m_axis_tlast;
      left_reg       <= p_right;
      column_reg     <= p_right && !m_axis_tlast ? column + 1'b1 : column;
      first_row_reg  <= (m_axis_tuser || first_row_reg) && !p_row_end;
      if (m_axis_tuser) {factor_reg, flat_limit_reg} <= {p_factor, p_flat_limit};
      if (p_row_end) begin
        bank_reg      <= !bank_reg;
        row_bank_reg  <= bank_reg;
        row_last_reg  <= column;
        row_first_reg <= m_axis_tuser || first_row_reg;
      end
    end

    a_valid_reg   <= take;
    a_pixel_reg   <= m_axis_tdata;
    a_fresh_reg   <= left && p_top;
    // A line of one window goes on with the window of the line before, which is still on its way to the memory.
    a_same_reg    <= !left || one_column;
    a_right_reg   <= p_right;
    a_row_end_reg <= take && p_row_end;
    a_address_reg <= {bank_reg, column};

    b_valid_reg   <= a_valid_reg;
    b_pixel_reg   <= a_pixel_reg;
    b_fresh_reg   <= a_fresh_reg;
    b_same_reg    <= a_same_reg;
    b_right_reg   <= a_right_reg;
    b_row_end_reg <= a_row_end_reg;
    b_address_reg <= a_address_reg;
    b_stored_reg  <= extremes[a_address_reg];
    b_late_reg    <= c_write_reg && c_address_reg == a_address_reg;
    b_late_stored_reg <= current_reg;

    if (b_valid_reg) current_reg <= {greatest, least};
    c_write_reg   <= b_valid_reg && b_right_reg;
    c_row_end_reg <= b_row_end_reg;
    c_address_reg <= b_address_reg;
    if (c_write_reg) extremes[c_address_reg] <= current_reg;

    if (take && p_row_end) busy_reg <= 1'b1;
    else if (m_stat_axis_tvalid && m_stat_axis_tready && m_stat_axis_tlast) busy_reg <= 1'b0;

    if (c_row_end_reg) begin
      walk_reg        <= 1'b1;
      walk_column_reg <= {COLUMN_BITS{1'b0}};
    end else if (go && walk_reg) begin
      walk_reg        <= !walk_last;
      walk_column_reg <= walk_column_reg + 1'b1;
    end

    if (go) begin
      t_valid_reg <= {t_valid_reg[1:0], walk_reg};
      t_user_reg <= {t_user_reg[1:0], walk_first};
      t_last_reg <= {t_last_reg[1:0], walk_last};
      t_left_reg <= {t_left_reg[1:0], walk_left};
      t0_extremes_reg <= extremes[{row_bank_reg, walk_column_reg}];
      t1_extremes_reg <= t0_extremes_reg;
      t1_spread_reg <= t0_extremes_reg[15:8] - t0_extremes_reg[7:0];
      t2_extremes_reg <= t1_extremes_reg;
      t2_product_reg <= product;
      t2_flat_reg <= t1_spread_reg < flat_limit_reg && !t_user_reg[1];
      m_stat_axis_tvalid <= t_valid_reg[2];
      m_stat_axis_tuser <= t_user_reg[2];
      m_stat_axis_tlast <= t_last_reg[2];
      m_stat_axis_tdata <= {t2_extremes_reg, threshold};
      if (t_valid_reg[2] && t_left_reg[2]) above_reg <= threshold;
    end

    if (rst) begin
      busy_reg           <= 1'b0;
      bank_reg           <= 1'b0;
      a_valid_reg        <= 1'b0;
      a_row_end_reg      <= 1'b0;
      b_valid_reg        <= 1'b0;
      b_row_end_reg      <= 1'b0;
      c_write_reg        <= 1'b0;
      c_row_end_reg      <= 1'b0;
      walk_reg           <= 1'b0;
      t_valid_reg        <= 3'd0;
      m_stat_axis_tvalid <= 1'b0;
    end
  end

endmodule

`default_nettype wire
