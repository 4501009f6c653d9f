// SPDX-License-Identifier: Apache-2.0
// Horizontal half of a window: from columns (or what a core reduced them to), TAPS
// neighbouring ones around each, the border left and right of the frame filled.
//
// Columns come and windows leave PPC a beat, the leftmost in the low bits.
//
// Latency     TAPS/2 columns, in whole beats, and 2 cycles. At the end of a line the
//             last windows leave while the next line comes in, or alone if none has
//             begun.
// Throughput  1 beat a cycle.
// Border      BORDER, VALUE as in border_mux.
// A line that is not finished before the next column_first is abandoned: windows
// for which columns are missing do not appear.

`default_nettype none

module window_cols #(
    parameter                   TAPS       = 5,
    parameter                   DATA_WIDTH = 8,
    parameter                   BORDER     = 0,
    parameter [DATA_WIDTH-1:0] VALUE      = 0,
    parameter                   PPC        = 1
) (
    input  wire                           clk,
    input  wire                           rst,
    input  wire                           advance,
    input  wire                           column_valid,
    input  wire                           column_sof,
    input  wire                           column_first,
    input  wire                           column_last,
    input  wire [     PPC*DATA_WIDTH-1:0] column,
    output reg                            window_valid,
    output reg                            window_sof,
    output reg                            window_last,
    output reg  [PPC*TAPS*DATA_WIDTH-1:0] window         // in each, its leftmost column in the low bits
);

  localparam REACH = TAPS / 2;
  localparam WORD = PPC * DATA_WIDTH;
  // Of the shift register, in beats: those before the centre, which are as many as behind it; all.
  localparam CENTRE = (REACH + PPC - 1) / PPC;
  localparam BEATS = 2 * CENTRE + 1;
  localparam LOWEST = (CENTRE * PPC - REACH) * DATA_WIDTH;

  // Beats enter at the top. Columns and tags below the declared ones are never looked at.
  reg  [BEATS*WORD-1:LOWEST] taps_reg;
  reg  [     BEATS-1:CENTRE] valid_reg;
  reg  [     BEATS-1:CENTRE] sof_reg;
  reg  [     BEATS-1:CENTRE] last_reg;
  reg  [          BEATS-1:1] first_reg;
  reg                        fresh_reg;  // the centre has not been given out yet

  // While the end of a line is on its way to the centre, taps move without new
  // columns, unless a new line has begun: its columns must stay side by side.
  wire                       unfinished = valid_reg[BEATS-1] && !last_reg[BEATS-1];
  wire                       ending = |(valid_reg[BEATS-1:CENTRE+1] & last_reg[BEATS-1:CENTRE+1]);
  wire                       shift = column_valid || (ending && !unfinished);
  wire                       abandon = column_valid && column_first && unfinished;

  // Bit k: the beat k + 1 before, or behind, the centre is of its line.
  wire [         CENTRE-1:0] before_ok;
  wire [         CENTRE-1:0] behind_ok;
  wire [PPC*TAPS*DATA_WIDTH-1:0] resolved;

  assign before_ok[0] = !first_reg[CENTRE];
  assign behind_ok[0] = !last_reg[CENTRE];

  genvar pixel, distance;
  generate
    if (CENTRE == 2) begin : g_second
      assign before_ok[1] = !first_reg[CENTRE] && !first_reg[CENTRE-1];
      assign behind_ok[1] = !last_reg[CENTRE] && !last_reg[CENTRE+1];
    end
    for (pixel = 0; pixel < PPC; pixel = pixel + 1) begin : g_pixel
      wire [REACH-1:0] low_ok;
      wire [REACH-1:0] high_ok;

      // A column of the centre's own beat is there with it.
      for (distance = 1; distance <= REACH; distance = distance + 1) begin : g_distance
        if (distance <= pixel) begin : g_low_own
          assign low_ok[distance-1] = 1'b1;
        end else begin : g_low
          assign low_ok[distance-1] = before_ok[(distance-pixel-1)/PPC];
        end
        if (pixel + distance < PPC) begin : g_high_own
          assign high_ok[distance-1] = 1'b1;
        end else begin : g_high
          assign high_ok[distance-1] = behind_ok[(pixel+distance)/PPC-1];
        end
      end

      border_mux #(
          .TAPS      (TAPS),
          .DATA_WIDTH(DATA_WIDTH),
          .BORDER    (BORDER),
          .VALUE     (VALUE)
      ) columns_border (
          .taps    (taps_reg[LOWEST+pixel*DATA_WIDTH+:TAPS*DATA_WIDTH]),
          .low_ok  (low_ok),
          .high_ok (high_ok),
          .resolved(resolved[pixel*TAPS*DATA_WIDTH+:TAPS*DATA_WIDTH])
      );
    end
  endgenerate

  always @(posedge clk) begin
    if (advance) begin
      if (shift) begin
        taps_reg <= {column, taps_reg[BEATS*WORD-1:WORD+LOWEST]};
        valid_reg <= {column_valid, abandon ? {CENTRE{1'b0}} : valid_reg[BEATS-1:CENTRE+1]};
        sof_reg <= {column_sof, sof_reg[BEATS-1:CENTRE+1]};
        last_reg <= {column_valid && column_last, last_reg[BEATS-1:CENTRE+1]};
        first_reg <= {column_valid && column_first, first_reg[BEATS-1:2]};
      end
      fresh_reg    <= shift;

      window_valid <= fresh_reg && valid_reg[CENTRE];
      window_sof   <= sof_reg[CENTRE];
      window_last  <= last_reg[CENTRE];
      window       <= resolved;
    end

    if (rst) begin
      valid_reg    <= {(BEATS - CENTRE) {1'b0}};
      fresh_reg    <= 1'b0;
      window_valid <= 1'b0;
    end
  end

endmodule

`default_nettype wire
