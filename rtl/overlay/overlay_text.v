// SPDX-License-Identifier: Apache-2.0
// Two lines of 64 characters at the top of the frame, cells of 16x16 pixels: each pixel of the font is 2x2 of the frame.
//
// Latency: 3 beats from x, y to behind, ink. Throughput: a pixel a cycle. Border, rounding, overflow: none. Limits: the
// bank that is shown must have been written whole; letters are capital ones.

`default_nettype none

module overlay_text (
    input wire clk,
    input wire rst,

    input wire       write,
    input wire [7:0] address,  // {bank, line, column}
    input wire [6:0] char,

    input wire sample,
    input wire show,
    input wire bank,

    input  wire        advance,
    input  wire [13:1] x,
    input  wire [13:1] y,
    output reg         behind,   // the pixel lies in the cell of a character
    output reg         ink       // and on the character itself
);

  `include "overlay_font.vh"

  reg  [6:0] chars                                           [0:255];
  reg        show_reg;
  reg        bank_reg;

  // One beat later: the character, and where in it.
  reg  [6:0] char_reg;
  reg        within_reg;
  reg  [2:0] row_reg;
  reg  [2:0] column_reg;

  // Another beat later, as the memory takes most of a cycle: its letter in the font, and whether it is drawn. Lower case is
  // drawn as upper case: only one bit tells the two halves of the font apart.
  reg  [5:0] glyph_reg;
  reg        is_drawn_reg;
  reg  [2:0] glyph_row_reg;
  reg  [2:0] glyph_column_reg;

  always @(posedge clk) begin
    if (write) chars[address] <= char;
    if (sample) begin
      show_reg <= show;
      bank_reg <= bank;
    end
    if (rst) show_reg <= 1'b0;
    if (advance) begin
      char_reg         <= chars[{bank_reg, y[4], x[9:4]}];
      within_reg       <= show_reg && x[13:10] == 4'd0 && y[13:5] == 9'd0;
      row_reg          <= y[3:1];
      column_reg       <= x[3:1];
      glyph_reg        <= {char_reg[6], char_reg[4:0]};
      is_drawn_reg     <= within_reg && char_reg[6:5] != 2'b00;
      glyph_row_reg    <= row_reg;
      glyph_column_reg <= column_reg;
      behind           <= is_drawn_reg;
      ink              <= is_drawn_reg && FONT[{glyph_reg, glyph_row_reg, glyph_column_reg}];
    end
  end

endmodule

`default_nettype wire
