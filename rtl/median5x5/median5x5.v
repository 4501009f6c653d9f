// SPDX-License-Identifier: Apache-2.0
// Binary median 5x5, equal to cv2.medianBlur(5): 1 where at least 13 of the 25
// pixels around are 1.
//
// Latency     2 lines, 2 pixels and 6 cycles.
// Throughput  1 pixel a cycle; s_axis_tready is 0 for 2 x width cycles after the
//             last pixel of a frame.
// Borders     replicate.
// Rounding    none; one bit cannot overflow.
// Frames      the contract of docs/design.md.
// Limits      2x1 to MAX_WIDTH x MAX_HEIGHT.

`default_nettype none

module median5x5 #(
    parameter MAX_WIDTH  = 1280,
    parameter MAX_HEIGHT = 720
) (
    input  wire        clk,
    input  wire        rst,
    input  wire [15:0] cfg_width,
    input  wire [15:0] cfg_height,
    input  wire        s_axis_tdata,
    input  wire        s_axis_tvalid,
    output wire        s_axis_tready,
    input  wire        s_axis_tuser,
    input  wire        s_axis_tlast,
    output wire        m_axis_tdata,
    output wire        m_axis_tvalid,
    input  wire        m_axis_tready,
    output wire        m_axis_tuser,
    output wire        m_axis_tlast,
    output wire        frame_error
);

  localparam REPLICATE = 0;

  wire        advance;

  wire       column_valid;
  wire       column_sof;
  wire       column_first;
  wire       column_last;
  wire [4:0] column;

  wire       window_valid;
  wire       window_sof;
  wire       window_last;
  wire [14:0] window;

  // The column is counted before the horizontal half, which then shifts 3 bits, not 5.
  wire [2:0] ones_in_column = {2'b0, column[0]} + {2'b0, column[1]} + {2'b0, column[2]} +
      {2'b0, column[3]} + {2'b0, column[4]};
  wire [4:0] ones = {2'b0, window[2:0]} + {2'b0, window[5:3]} + {2'b0, window[8:6]} +
      {2'b0, window[11:9]} + {2'b0, window[14:12]};

  reg        median_reg;
  reg        median_valid_reg;
  reg        median_sof_reg;
  reg        median_last_reg;

  window_rows #(
      .TAPS      (5),
      .DATA_WIDTH(1),
      .BORDER    (REPLICATE),
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT)
  ) rows (
      .clk          (clk),
      .rst          (rst),
      .cfg_width    (cfg_width),
      .cfg_height   (cfg_height),
      .s_axis_tdata (s_axis_tdata),
      .s_axis_tvalid(s_axis_tvalid),
      .s_axis_tready(s_axis_tready),
      .s_axis_tuser (s_axis_tuser),
      .s_axis_tlast (s_axis_tlast),
      .advance      (advance),
      .column_valid (column_valid),
      .column_sof   (column_sof),
      .column_first (column_first),
      .column_last  (column_last),
      .column       (column),
      .frame_error  (frame_error)
  );

  window_cols #(
      .TAPS      (5),
      .DATA_WIDTH(3),
      .BORDER    (REPLICATE)
  ) cols (
      .clk         (clk),
      .rst         (rst),
      .advance     (advance),
      .column_valid(column_valid),
      .column_sof  (column_sof),
      .column_first(column_first),
      .column_last (column_last),
      .column      (ones_in_column),
      .window_valid(window_valid),
      .window_sof  (window_sof),
      .window_last (window_last),
      .window      (window)
  );

  always @(posedge clk) begin
    if (advance) begin
      median_reg       <= ones >= 5'd13;
      median_valid_reg <= window_valid;
      median_sof_reg   <= window_sof;
      median_last_reg  <= window_last;
    end

    if (rst) median_valid_reg <= 1'b0;
  end

  axis_skid #(
      .WIDTH(3)
  ) output_slice (
      .clk      (clk),
      .rst      (rst),
      .s_payload({median_sof_reg, median_last_reg, median_reg}),
      .s_valid  (median_valid_reg),
      .s_ready  (advance),
      .m_payload({m_axis_tuser, m_axis_tlast, m_axis_tdata}),
      .m_valid  (m_axis_tvalid),
      .m_ready  (m_axis_tready)
  );

endmodule

`default_nettype wire
