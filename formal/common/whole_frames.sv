// SPDX-License-Identifier: Apache-2.0
// Assumes whole frames, one after the other, of two pictures in turn, any two; tells which pixel is at the output, so
// that a property can compare it with what came. Reset comes once.
`default_nettype none

module whole_frames #(
    parameter BITS = 1
) (
    input wire             clk,
    input wire             rst,
    input wire [     15:0] cfg_width,
    input wire [     15:0] cfg_height,
    input wire [ BITS-1:0] s_data,
    input wire             s_valid,
    input wire             s_ready,
    input wire             s_user,
    input wire             s_last,
    input wire             m_valid,
    input wire             m_ready,
    input wire             m_user,
    input wire             m_last,

    output wire [32*BITS-1:0] pixels,  // at {frame, line, column}, with two bits each for the last two
    output reg  [        1:0] column,  // of the pixel that is at the output
    output reg  [        1:0] line,
    output reg                frame,
    output reg                past     // cleared by reset: no reset came since
);

  (* anyconst *) reg [32*BITS-1:0] pictures;
  assign pixels = pictures;

  reg known = 1'b0;
  wire [1:0] last_column = cfg_width[1:0] - 2'd1;
  wire [1:0] last_line = cfg_height[1:0] - 2'd1;
  reg [1:0] in_column, in_line;
  reg  in_frame;
  wire in_line_ends = in_column == last_column;
  wire in_frame_ends = in_line_ends && in_line == last_line;
  wire line_ends = column == last_column;
  wire frame_ends = line_ends && line == last_line;

  always @* begin
    if (known) assume (!rst);
    if (s_valid) assume (s_user == (in_column == 2'd0 && in_line == 2'd0));
    if (s_valid) assume (s_last == in_line_ends);
    if (s_valid) assume (s_data == pictures[{in_frame, in_line, in_column}*BITS+:BITS]);
  end

  always @(posedge clk) begin
    known  <= 1'b1;
    past   <= 1'b1;
    if (s_valid && s_ready) begin
      in_column <= in_line_ends ? 2'd0 : in_column + 2'd1;
      in_line   <= in_frame_ends ? 2'd0 : in_line_ends ? in_line + 2'd1 : in_line;
      in_frame  <= in_frame ^ in_frame_ends;
    end
    if (m_valid && m_ready) begin
      column <= line_ends ? 2'd0 : column + 2'd1;
      line   <= frame_ends ? 2'd0 : line_ends ? line + 2'd1 : line;
      frame  <= frame ^ frame_ends;
    end
    if (rst) begin
      {in_column, in_line, in_frame, column, line, frame} <= 10'd0;
      past <= 1'b0;
    end
  end

  always @(posedge clk)
    if (known && !rst && m_valid) begin
      assert (m_user == (column == 2'd0 && line == 2'd0));
      assert (m_last == line_ends);
    end

endmodule

`default_nettype wire
