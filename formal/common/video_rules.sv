// SPDX-License-Identifier: Apache-2.0
// What leaves a core that gives one pixel for each pixel, whatever comes in: good frames, cut off ones and noise.
// A frame starts with tuser; tlast stands on the last pixel of each line and nowhere else; a frame has no pixel too
// many; not more frames start than came, and never more pixels have left than were taken.
`default_nettype none

module video_rules (
    input wire        clk,
    input wire        rst,
    input wire [15:0] cfg_width,   // constant, at most 4
    input wire [15:0] cfg_height,
    input wire        s_valid,
    input wire        s_ready,
    input wire        s_user,
    input wire        m_valid,
    input wire        m_ready,
    input wire        m_user,
    input wire        m_last
);

  wire [1:0] last_column = cfg_width[1:0] - 2'd1;
  wire [1:0] last_line = cfg_height[1:0] - 2'd1;

  reg known = 1'b0;
  reg open;
  reg [1:0] column, line;
  // Pixels and frames that were taken and have not left; no proof is deep enough to wrap them.
  reg [5:0] inside, frames_inside;
  wire [1:0] now_column = m_user ? 2'd0 : column;
  wire [1:0] now_line = m_user ? 2'd0 : line;
  wire line_ends = now_column == last_column;
  wire take = s_valid && s_ready;
  wire leave = m_valid && m_ready;

  always @(posedge clk) begin
    known <= 1'b1;
    if (leave) begin
      open   <= !(line_ends && now_line == last_line);
      column <= line_ends ? 2'd0 : now_column + 2'd1;
      line   <= line_ends ? now_line + 2'd1 : now_line;
    end
    inside        <= inside + {5'd0, take} - {5'd0, leave};
    frames_inside <= frames_inside + {5'd0, take && s_user} - {5'd0, leave && m_user};
    if (rst) {open, inside, frames_inside} <= 13'd0;
  end

  always @(posedge clk)
    if (known && !rst && m_valid) begin
      assert (m_user || open);
      assert (m_last == line_ends);
    end

  // A pixel that was dropped stays inside; one that was never taken would be one too many.
  always @(posedge clk)
    if (known && !rst && m_valid) begin
      assert (inside != 6'd0);
      if (m_user) assert (frames_inside != 6'd0);
    end

endmodule

`default_nettype wire
