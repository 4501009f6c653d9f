// SPDX-License-Identifier: Apache-2.0
// frame_tracker against the frame contract of docs/design.md, told a second time and differently: one flag that says
// whether pixels are wanted, the index of the next pixel in raster order, and what an error report waits for.
`default_nettype none

module frame_tracker_contract #(
    parameter MIN_WIDTH  = 2,
    parameter MIN_HEIGHT = 1,
    parameter MAX_WIDTH  = 5,
    parameter MAX_HEIGHT = 3
) (
    input wire        clk,
    input wire        rst,
    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
    input wire        beat,
    input wire        beat_user,
    input wire        beat_last
);

  wire accept, sof, sol, eol, eof, frame_error;
  wire [15:0] x, y, last_x, last_y;

  frame_tracker #(
      .MIN_WIDTH (MIN_WIDTH),
      .MIN_HEIGHT(MIN_HEIGHT),
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT)
  ) dut (.*);

  power_up start (.*);

  // The reference: where the stream is.
  reg known = 1'b0;
  reg open;      // within a good frame that is not complete
  reg complete;  // a complete frame, and no beat since
  reg [15:0] width, height, column, line;
  reg expect_error;

  wire size_ok = cfg_width >= MIN_WIDTH && cfg_width <= MAX_WIDTH && cfg_height >= MIN_HEIGHT && cfg_height <= MAX_HEIGHT;
  wire [15:0] now_width = beat_user ? cfg_width : width;
  wire [15:0] now_height = beat_user ? cfg_height : height;
  wire [15:0] now_column = beat_user ? 16'd0 : column;
  wire [15:0] now_line = beat_user ? 16'd0 : line;
  wire in_frame = beat_user ? size_ok : open;
  wire line_ends = now_column + 16'd1 == now_width;
  wire good = in_frame && beat_last == line_ends;
  wire frame_ends = good && line_ends && now_line + 16'd1 == now_height;

  always @(posedge clk) begin
    known <= 1'b1;
    expect_error <= 1'b0;
    if (beat) begin
      open     <= good && !frame_ends;
      complete <= good && frame_ends;
      width    <= now_width;
      height   <= now_height;
      column   <= line_ends ? 16'd0 : now_column + 16'd1;
      line     <= line_ends ? now_line + 16'd1 : now_line;
      // Cut off by an early start, malformed, or the first beat after a complete frame.
      expect_error <= (beat_user && open) || (beat_user && !good) || (!beat_user && (open || complete) && !good);
    end
    if (rst) begin
      open         <= 1'b0;
      complete     <= 1'b0;
      expect_error <= 1'b0;
    end
  end

  (* hierconn *) wire [1:0] \dut.state_reg ;
  (* hierconn *) wire \dut.sol_reg ;
  (* hierconn *) wire [$clog2(MAX_WIDTH)-1:0] \dut.x_reg ;
  (* hierconn *) wire [$clog2(MAX_HEIGHT)-1:0] \dut.y_reg ;

  always @(posedge clk)
    if (known) begin
      assert (frame_error == expect_error);
      if (beat) assert (accept == good);
      else assert (!accept);
      if (beat && good) begin
        assert (x == now_column && y == now_line);
        assert (x < now_width && y < now_height);
        assert (sof == beat_user);
        assert (sof == (x == 16'd0 && y == 16'd0));
        assert (sol == (x == 16'd0));
        assert (eol == line_ends && eol == beat_last);
        assert (eof == frame_ends);
      end
      if (open || complete) assert (last_x + 16'd1 == width && last_y + 16'd1 == height);

      // For induction: the states of both agree, and the reference is within its frame.
      assert (!(open && complete));
      assert (open == (\dut.state_reg == 2'd1));
      assert (complete == (\dut.state_reg == 2'd2));
      assert (\dut.state_reg != 2'd3);
      if (open) begin
        assert (column < width && line < height && !(column == 16'd0 && line == 16'd0));
        assert (width >= MIN_WIDTH && width <= MAX_WIDTH && height >= MIN_HEIGHT && height <= MAX_HEIGHT);
        assert (\dut.sol_reg == (column == 16'd0));
        assert (\dut.x_reg == column && \dut.y_reg == line);
      end
    end

endmodule

`default_nettype wire
