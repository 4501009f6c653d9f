// SPDX-License-Identifier: Apache-2.0
// The side of video_in that runs with the camera: finds frames and lines in raw video and turns them into words.
//
// A frame begins with the first pixel (de) after vsync; a line ends where de falls. The level of vsync during pixels is
// its idle level, so either polarity works; VSYNC_ACTIVE only says which to expect before the first pixel after reset.
// Blanking may be as short as one cycle between lines and, with one cycle of vsync, between frames.
//
// Words: a header {1, frame number} one cycle before the first pixel, then pixels {0, 7'd0, last of line, RGB}. When a
// frame is found malformed, or a word finds the FIFO full, no more of it is written and one event tells why.
// Latency: 3 cycles from the pins to word_valid.
// cfg_* are sampled with the first pixel of a frame. Reset is asynchronous.
`default_nettype none

module video_capture #(
    parameter VSYNC_ACTIVE = 1
) (
    input wire pix_clk,
    input wire pix_rst,

    input wire [23:0] vid_data,
    input wire        vid_de,
    input wire        vid_vsync,

    input wire        cfg_enable,
    input wire        cfg_size_ok,
    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,

    output wire        word_valid,
    output wire [32:0] word,
    input  wire        word_full,

    output wire event_seen,
    output wire event_malformed,
    output wire event_overflow,

    output reg [15:0] measured_width,
    output reg [15:0] measured_height
);

  localparam [15:0] LAST_COUNT = 16'hFFFE;

  // Stage a: the pins, registered.
  reg  [23:0] a_data_reg;
  reg         a_de_reg;
  reg         a_vsync_reg;

  // Stage b: position of the pixel. Holds the last position between pixels.
  reg  [23:0] b_data_reg;
  reg         b_de_reg;
  reg  [15:0] b_x_reg;
  reg  [15:0] b_y_reg;
  reg         b_frame_end_reg;
  reg         header_reg;

  // Stage c: the word and what is wrong with the frame.
  reg  [23:0] c_data_reg;
  reg         c_de_reg;
  reg         c_last_reg;
  reg         c_fault_reg;
  reg         c_frame_end_reg;

  reg         vsync_idle_reg;
  reg         armed_reg;
  reg         in_frame_reg;
  reg         size_ok_reg;
  reg  [15:0] last_x_reg;
  reg  [15:0] last_y_reg;
  reg  [31:0] number_reg;
  reg         open_reg;

  wire        vsync = a_vsync_reg != vsync_idle_reg;
  // Vsync together with a pixel means that the polarity was guessed wrongly: no frame starts there.
  wire        frame_start = a_de_reg && armed_reg && !vsync;
  wire        frame_end = !a_de_reg && vsync && in_frame_reg;
  wire        line_start = a_de_reg && !b_de_reg;

  wire        line_short = !b_de_reg && c_de_reg && b_x_reg < last_x_reg;
  wire        line_long = b_de_reg && b_x_reg > last_x_reg;
  wire        lines_few = b_frame_end_reg && b_y_reg < last_y_reg;
  wire        lines_many = b_de_reg && b_y_reg > last_y_reg;

  wire        want_header = header_reg && size_ok_reg;
  wire        want_pixel = c_de_reg && open_reg && !c_fault_reg;

  assign word_valid      = want_header || want_pixel;
  assign word            = header_reg ? {1'b1, number_reg} : {8'd0, c_last_reg, c_data_reg};
  assign event_seen      = header_reg;
  assign event_malformed = c_fault_reg && open_reg;
  assign event_overflow  = word_valid && word_full;

  always @(posedge pix_clk) begin
    a_data_reg <= vid_data;
    b_data_reg <= a_data_reg;
    c_data_reg <= b_data_reg;
    c_last_reg <= b_x_reg == last_x_reg;
    if (frame_start) begin
      size_ok_reg <= cfg_size_ok;
      last_x_reg  <= cfg_width - 16'd1;
      last_y_reg  <= cfg_height - 16'd1;
    end
  end

  always @(posedge pix_clk or posedge pix_rst) begin
    if (pix_rst) begin
      a_de_reg        <= 1'b0;
      a_vsync_reg     <= VSYNC_ACTIVE == 0;
      vsync_idle_reg  <= VSYNC_ACTIVE == 0;
      armed_reg       <= 1'b0;
      in_frame_reg    <= 1'b0;
      b_de_reg        <= 1'b0;
      b_x_reg         <= 16'd0;
      b_y_reg         <= 16'd0;
      b_frame_end_reg <= 1'b0;
      header_reg      <= 1'b0;
      number_reg      <= 32'd0;
      c_de_reg        <= 1'b0;
      c_fault_reg     <= 1'b0;
      c_frame_end_reg <= 1'b0;
      open_reg        <= 1'b0;
      measured_width  <= 16'd0;
      measured_height <= 16'd0;
    end else begin
      a_de_reg    <= vid_de;
      a_vsync_reg <= vid_vsync;

      if (a_de_reg) vsync_idle_reg <= a_vsync_reg;
      armed_reg <= !a_de_reg && (armed_reg || vsync);
      if (frame_start) in_frame_reg <= 1'b1;
      else if (frame_end) in_frame_reg <= 1'b0;

      b_de_reg        <= a_de_reg;
      b_frame_end_reg <= frame_end;
      if (line_start) b_x_reg <= 16'd0;
      else if (a_de_reg && b_x_reg != LAST_COUNT) b_x_reg <= b_x_reg + 16'd1;
      if (frame_start) b_y_reg <= 16'd0;
      else if (line_start && b_y_reg != LAST_COUNT) b_y_reg <= b_y_reg + 16'd1;
      header_reg <= frame_start && cfg_enable;
      if (frame_start && cfg_enable) number_reg <= number_reg + 32'd1;

      if (b_frame_end_reg) begin
        measured_width  <= b_x_reg + 16'd1;
        measured_height <= b_y_reg + 16'd1;
      end

      c_de_reg <= b_de_reg;
      c_frame_end_reg <= b_frame_end_reg;
      c_fault_reg     <= line_short || line_long || lines_few || lines_many || (b_de_reg && !size_ok_reg);

      // The header of a frame can fall together with the verdict on the frame before: the header counts.
      if (header_reg) open_reg <= !(want_header && word_full);
      else if (c_fault_reg || c_frame_end_reg || event_overflow) open_reg <= 1'b0;
    end
  end

endmodule

`default_nettype wire
