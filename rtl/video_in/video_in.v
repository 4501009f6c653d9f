// SPDX-License-Identifier: Apache-2.0
// Raw video (pixels, data enable, vsync on pix_clk) to AXI4-Stream RGB on clk.
//
// Every frame that starts at the camera while cfg_enable is set gets the next frame number, from 1. A frame with a
// short or long line, with missing or extra lines, or of which a pixel finds the FIFO full, is cut off at the fault,
// counted once by frame_malformed or frame_overflow, and the next frame starts whole. A tlast stands only on pixel
// cfg_width - 1 of a line, and a line that was cut off is followed by the tuser of the next frame.
//
// Latency: 3 cycles of pix_clk and 3 to 5 of clk from the pins to m_axis.
// Throughput: one pixel a cycle of the slower clock. Overflow: FIFO_DEPTH pixels may wait; the camera cannot.
// Border, rounding: none; pixels are copied.
// frame_number and frame_start_us change in the cycle in which m_axis first shows the first pixel of a frame.
// frame_seen, frame_malformed and frame_overflow are cycles of clk; measured_* is the last complete frame at the camera,
// also while disabled. cfg_* are sampled with the first pixel of each frame and take up to 8 cycles of each clock to
// arrive; a size that is 0 or greater than MAX_* makes each frame malformed.
// pix_clk may stop and come back at any time: clk goes on, and a cut frame is found malformed when lines come again.
// Limits: hsync is not needed; pix_clk is at most 3 times as fast as clk; rst comes from a flip-flop.
`default_nettype none

module video_in #(
    parameter MAX_WIDTH    = 1280,
    parameter MAX_HEIGHT   = 720,
    parameter FIFO_DEPTH   = 1024,
    parameter VSYNC_ACTIVE = 1
) (
    input wire clk,
    input wire rst,

    input wire        pix_clk,
    input wire [23:0] vid_data,
    input wire        vid_de,
    input wire        vid_hsync,
    input wire        vid_vsync,

    input wire        cfg_enable,
    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
    input wire [63:0] time_us,

    output reg  [23:0] m_axis_tdata,
    output reg         m_axis_tvalid,
    input  wire        m_axis_tready,
    output reg         m_axis_tuser,
    output reg         m_axis_tlast,

    output reg  [31:0] frame_number,
    output reg  [63:0] frame_start_us,
    output wire        frame_seen,
    output wire        frame_malformed,
    output wire        frame_overflow,
    output wire [15:0] measured_width,
    output wire [15:0] measured_height
);

  localparam DEPTH_LOG2 = $clog2(FIFO_DEPTH);

  generate
    if (FIFO_DEPTH < 4 || (1 << DEPTH_LOG2) != FIFO_DEPTH) begin : g_fifo_depth
      ERROR_fifo_depth_must_be_a_power_of_two_of_at_least_4 error_instance ();
    end
    if (MAX_WIDTH < 1 || MAX_WIDTH > 32767 || MAX_HEIGHT < 1 || MAX_HEIGHT > 32767) begin : g_size
      ERROR_max_width_and_max_height_must_be_1_to_32767 error_instance ();
    end
  endgenerate

  // DVI and HDMI sources separate lines by data enable alone.
  wire unused_hsync = vid_hsync;

  // The crossings are reset asynchronously, so that a reset also counts while pix_clk stands still.
  reg crossing_rst_reg;
  wire pix_rst;

  wire size_ok = cfg_width != 16'd0 && cfg_width <= MAX_WIDTH[15:0] &&
                   cfg_height != 16'd0 && cfg_height <= MAX_HEIGHT[15:0];
  reg [33:0] cfg_reg;
  wire [33:0] pix_cfg;
  wire pix_word_valid;
  wire [32:0] pix_word;
  wire pix_word_full;
  wire pix_seen;
  wire pix_malformed;
  wire pix_overflow;
  wire [15:0] pix_measured_width;
  wire [15:0] pix_measured_height;

  wire word_valid;
  wire [32:0] word;
  wire word_is_header = word[32];
  wire output_free = !m_axis_tvalid || m_axis_tready;
  wire take_header = word_valid && word_is_header;
  wire take_pixel = word_valid && !word_is_header && output_free;
  reg [31:0] next_number_reg;
  reg first_pixel_reg;

  always @(posedge clk) begin
    crossing_rst_reg <= rst;
    cfg_reg          <= {cfg_enable, size_ok, cfg_width, cfg_height};
  end

  reset_sync pix_reset (
      .clk    (pix_clk),
      .rst_in (crossing_rst_reg),
      .rst_out(pix_rst)
  );

  word_sync #(
      .WIDTH(34)
  ) cfg_sync (
      .src_clk (clk),
      .src_rst (crossing_rst_reg),
      .src_data(cfg_reg),
      .dst_clk (pix_clk),
      .dst_rst (pix_rst),
      .dst_data(pix_cfg)
  );

  video_capture #(
      .VSYNC_ACTIVE(VSYNC_ACTIVE)
  ) capture (
      .pix_clk        (pix_clk),
      .pix_rst        (pix_rst),
      .vid_data       (vid_data),
      .vid_de         (vid_de),
      .vid_vsync      (vid_vsync),
      .cfg_enable     (pix_cfg[33]),
      .cfg_size_ok    (pix_cfg[32]),
      .cfg_width      (pix_cfg[31:16]),
      .cfg_height     (pix_cfg[15:0]),
      .word_valid     (pix_word_valid),
      .word           (pix_word),
      .word_full      (pix_word_full),
      .event_seen     (pix_seen),
      .event_malformed(pix_malformed),
      .event_overflow (pix_overflow),
      .measured_width (pix_measured_width),
      .measured_height(pix_measured_height)
  );

  event_sync seen_sync (
      .src_clk  (pix_clk),
      .src_rst  (pix_rst),
      .src_event(pix_seen),
      .dst_clk  (clk),
      .dst_rst  (crossing_rst_reg),
      .dst_pulse(frame_seen)
  );

  event_sync malformed_sync (
      .src_clk  (pix_clk),
      .src_rst  (pix_rst),
      .src_event(pix_malformed),
      .dst_clk  (clk),
      .dst_rst  (crossing_rst_reg),
      .dst_pulse(frame_malformed)
  );

  event_sync overflow_sync (
      .src_clk  (pix_clk),
      .src_rst  (pix_rst),
      .src_event(pix_overflow),
      .dst_clk  (clk),
      .dst_rst  (crossing_rst_reg),
      .dst_pulse(frame_overflow)
  );

  word_sync #(
      .WIDTH(32)
  ) measured_sync (
      .src_clk (pix_clk),
      .src_rst (pix_rst),
      .src_data({pix_measured_width, pix_measured_height}),
      .dst_clk (clk),
      .dst_rst (crossing_rst_reg),
      .dst_data({measured_width, measured_height})
  );

  async_fifo #(
      .WIDTH     (33),
      .DEPTH_LOG2(DEPTH_LOG2)
  ) fifo (
      .wr_clk  (pix_clk),
      .wr_rst  (pix_rst),
      .wr_en   (pix_word_valid),
      .wr_data (pix_word),
      .wr_full (pix_word_full),
      .rd_clk  (clk),
      .rd_rst  (crossing_rst_reg),
      .rd_valid(word_valid),
      .rd_data (word),
      .rd_ready(take_header || take_pixel)
  );

  always @(posedge clk) begin
    if (take_header) begin
      next_number_reg <= word[31:0];
      first_pixel_reg <= 1'b1;
    end
    if (output_free) begin
      m_axis_tvalid <= take_pixel;
      m_axis_tdata  <= word[23:0];
      m_axis_tlast  <= word[24];
      m_axis_tuser  <= first_pixel_reg;
    end
    if (take_pixel) begin
      first_pixel_reg <= 1'b0;
      if (first_pixel_reg) begin
        frame_number   <= next_number_reg;
        frame_start_us <= time_us;
      end
    end
    if (rst) begin
      m_axis_tvalid   <= 1'b0;
      first_pixel_reg <= 1'b0;
      frame_number    <= 32'd0;
      frame_start_us  <= 64'd0;
    end
  end

endmodule

`default_nettype wire
