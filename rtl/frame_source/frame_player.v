// SPDX-License-Identifier: Apache-2.0
// The side of frame_source that runs with pix_clk: puts the words of frame_reader into the places of video_timing.
//
// Behind the last pixel of a frame it asks for the next by next_frame, throws away words up to the header of that one,
// and keeps what follows until the first pixel is due. A pixel that is not there then ends the frame: BLANK comes up to
// its last pixel, and missing is one cycle. The words stay where they are as long, so that memory is asked for no more.
// Latency: 2 cycles from a place to out_*. The first frame after a reset is black. Reset is asynchronous.

`default_nettype none

module frame_player #(
    parameter WIDTH   = 1280,
    parameter H_FRONT = 110,
    parameter H_SYNC  = 40,
    parameter H_TOTAL = 1650,
    parameter HEIGHT  = 720,
    parameter V_FRONT = 5,
    parameter V_SYNC  = 5,
    parameter V_TOTAL = 750,
    parameter BLANK   = 2105376
) (
    input wire pix_clk,
    input wire pix_rst,

    input  wire        word_valid,
    input  wire [48:0] word,
    output wire        word_ready,

    output reg next_frame,
    output reg missing,

    output reg [23:0] out_data,
    output reg        out_de,
    output reg        out_hsync,
    output reg        out_vsync
);

  localparam [31:0] LAST_X = WIDTH - 1;
  localparam [31:0] LAST_Y = HEIGHT - 1;
  localparam [31:0] BLANK_COLOUR = BLANK;

  localparam [1:0] WAIT = 2'd0;  // for the header of the frame
  localparam [1:0] OFF = 2'd1;  // the frame is black
  localparam [1:0] PLAY = 2'd2;
  localparam [1:0] LOST = 2'd3;  // the rest of the frame is blank

  wire [15:0] x;
  wire [15:0] y;
  wire        de;
  wire        hsync;
  wire        vsync;

  // The places have no asynchronous reset.
  reg         starting_reg;

  video_timing #(
      .WIDTH  (WIDTH),
      .H_FRONT(H_FRONT),
      .H_SYNC (H_SYNC),
      .H_TOTAL(H_TOTAL),
      .HEIGHT (HEIGHT),
      .V_FRONT(V_FRONT),
      .V_SYNC (V_SYNC),
      .V_TOTAL(V_TOTAL)
  ) places (
      .pix_clk(pix_clk),
      .pix_rst(starting_reg),
      .x      (x),
      .y      (y),
      .de     (de),
      .hsync  (hsync),
      .vsync  (vsync)
  );

  reg de_reg;
  reg last_reg;
  reg hsync_reg;
  reg vsync_reg;
  reg [1:0] state_reg;
  reg [3:0] number_reg;
  reg second_reg;  // the second pixel of the word is due

  wire mine = word_valid && word[48] && word[4:1] == number_reg;
  wire show = state_reg == PLAY && word_valid;

  assign word_ready = state_reg == WAIT || (de_reg && show && second_reg);

  always @(posedge pix_clk or posedge pix_rst) begin
    if (pix_rst) begin
      starting_reg <= 1'b1;
      de_reg       <= 1'b0;
      last_reg     <= 1'b0;
      hsync_reg    <= 1'b0;
      vsync_reg    <= 1'b0;
      state_reg    <= OFF;
      number_reg   <= 4'd0;
      second_reg   <= 1'b0;
      next_frame   <= 1'b0;
      missing      <= 1'b0;
      out_de       <= 1'b0;
      out_hsync    <= 1'b0;
      out_vsync    <= 1'b0;
    end else begin
      starting_reg <= 1'b0;
      de_reg       <= de;
      last_reg     <= !starting_reg && x == LAST_X[15:0] && y == LAST_Y[15:0];
      hsync_reg    <= !starting_reg && hsync;
      vsync_reg    <= !starting_reg && vsync;

      next_frame <= last_reg;
      missing    <= de_reg && !show && (state_reg == WAIT || state_reg == PLAY);
      if (last_reg) begin
        state_reg  <= WAIT;
        number_reg <= number_reg + 4'd1;
        second_reg <= 1'b0;
      end else if (de_reg) begin
        if (!show && state_reg != OFF) state_reg <= LOST;
        second_reg <= !second_reg;
      end else if (state_reg == WAIT && mine) begin
        state_reg <= word[0] ? PLAY : OFF;
      end

      out_de    <= de_reg;
      out_hsync <= hsync_reg;
      out_vsync <= vsync_reg;
    end
  end

  always @(posedge pix_clk) begin
    if (!de_reg || state_reg == OFF) out_data <= 24'd0;
    else if (!show) out_data <= BLANK_COLOUR[23:0];
    else out_data <= second_reg ? word[47:24] : word[23:0];
  end

endmodule

`default_nettype wire
