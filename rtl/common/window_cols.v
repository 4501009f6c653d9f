// SPDX-License-Identifier: Apache-2.0
// Horizontal half of a window: from columns (or what a core reduced them to), TAPS
// neighbouring ones around each, the border left and right of the frame filled.
//
// Latency     TAPS/2 columns and 2 cycles. At the end of a line the last TAPS/2
//             windows leave while the next line comes in, or alone if none has begun.
// Throughput  1 column a cycle.
// Border      BORDER, VALUE as in border_mux.
// A line that is not finished before the next column_first is abandoned: windows
// for which columns are missing do not appear.

`default_nettype none

module window_cols #(
    parameter                   TAPS       = 5,
    parameter                   DATA_WIDTH = 8,
    parameter                   BORDER     = 0,
    parameter [DATA_WIDTH-1:0] VALUE      = 0
) (
    input  wire                       clk,
    input  wire                       rst,
    input  wire                       advance,
    input  wire                       column_valid,
    input  wire                       column_sof,
    input  wire                       column_first,
    input  wire                       column_last,
    input  wire [     DATA_WIDTH-1:0] column,
    output reg                        window_valid,
    output reg                        window_sof,
    output reg                        window_last,
    output reg  [TAPS*DATA_WIDTH-1:0] window         // leftmost column in the low bits
);

  localparam CENTRE = TAPS / 2;

  // Columns enter at the top tap. The tags of taps below those declared are never looked at.
  reg  [TAPS*DATA_WIDTH-1:0] taps_reg;
  reg  [      TAPS-1:CENTRE] valid_reg;
  reg  [      TAPS-1:CENTRE] sof_reg;
  reg  [      TAPS-1:CENTRE] last_reg;
  reg  [           TAPS-1:1] first_reg;
  reg                        fresh_reg;  // the centre has not been given out yet

  // While the end of a line is on its way to the centre, taps move without new
  // columns, unless a new line has begun: its columns must stay side by side.
  wire                       unfinished = valid_reg[TAPS-1] && !last_reg[TAPS-1];
  wire                       ending = |(valid_reg[TAPS-1:CENTRE+1] & last_reg[TAPS-1:CENTRE+1]);
  wire                       shift = column_valid || (ending && !unfinished);
  wire                       abandon = column_valid && column_first && unfinished;

  wire [         CENTRE-1:0] low_ok;
  wire [         CENTRE-1:0] high_ok;
  wire [TAPS*DATA_WIDTH-1:0] resolved;

  assign low_ok[0]  = !first_reg[CENTRE];
  assign high_ok[0] = !last_reg[CENTRE];
  generate
    if (TAPS == 5) begin : g_five
      assign low_ok[1]  = !first_reg[CENTRE] && !first_reg[CENTRE-1];
      assign high_ok[1] = !last_reg[CENTRE] && !last_reg[CENTRE+1];
    end
  endgenerate

  border_mux #(
      .TAPS      (TAPS),
      .DATA_WIDTH(DATA_WIDTH),
      .BORDER    (BORDER),
      .VALUE     (VALUE)
  ) columns_border (
      .taps    (taps_reg),
      .low_ok  (low_ok),
      .high_ok (high_ok),
      .resolved(resolved)
  );

  always @(posedge clk) begin
    if (advance) begin
      if (shift) begin
        taps_reg <= {column, taps_reg[TAPS*DATA_WIDTH-1:DATA_WIDTH]};
        valid_reg <= {column_valid, abandon ? {CENTRE{1'b0}} : valid_reg[TAPS-1:CENTRE+1]};
        sof_reg <= {column_sof, sof_reg[TAPS-1:CENTRE+1]};
        last_reg <= {column_valid && column_last, last_reg[TAPS-1:CENTRE+1]};
        first_reg <= {column_valid && column_first, first_reg[TAPS-1:2]};
      end
      fresh_reg    <= shift;

      window_valid <= fresh_reg && valid_reg[CENTRE];
      window_sof   <= sof_reg[CENTRE];
      window_last  <= last_reg[CENTRE];
      window       <= resolved;
    end

    if (rst) begin
      valid_reg    <= {(TAPS - CENTRE) {1'b0}};
      fresh_reg    <= 1'b0;
      window_valid <= 1'b0;
    end
  end

endmodule

`default_nettype wire
