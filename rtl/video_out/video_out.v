// SPDX-License-Identifier: Apache-2.0
// AXI4-Stream RGB on clk back to raw video on pix_clk, for a monitor that runs with the camera's own timing: the camera's
// syncs, DELAY cycles later, with the stream's pixels where de is 1. No frame is stored: the stream may lag behind the
// camera by as much as DELAY, no more.
//
// Latency     DELAY cycles of pix_clk from vid_* to out_*, 13200 by default, whatever the stream does.
// Throughput  one pixel a cycle of the slower clock.
// Border      none. Rounding: none; pixels are copied.
// Overflow    s_axis_tready is always 1. A pixel that finds FIFO_DEPTH others waiting is lost, and with it the rest of its
//             frame. From the first pixel that is missing or late to the end of the frame the monitor shows BLANK;
//             frame_blank is one cycle of clk then. The next frame that comes in time is whole.
// Limits      A pixel is in time if it is taken 8 cycles of pix_clk and 3 of clk before its place on out_*. A frame
//             that is not is thrown away up to the camera's next vsync; what comes after that is the next frame. DELAY is
//             less than the time from a frame's first pixel to the next vsync. vsync counts by its change against its
//             level during pixels. pix_clk may stop and come back at any time, and out_* stands still as long. rst comes
//             from a flip-flop.

`default_nettype none

module video_out #(
    parameter DELAY        = 13200,
    parameter FIFO_DEPTH   = 16384,
    parameter VSYNC_ACTIVE = 1,
    parameter BLANK        = 2105376  // 202020
) (
    input wire clk,
    input wire rst,

    input  wire [23:0] s_axis_tdata,
    input  wire        s_axis_tvalid,
    output wire        s_axis_tready,
    input  wire        s_axis_tuser,
    input  wire        s_axis_tlast,

    output wire frame_blank,

    input wire pix_clk,
    input wire vid_de,
    input wire vid_hsync,
    input wire vid_vsync,

    output reg [23:0] out_data,
    output reg        out_de,
    output reg        out_hsync,
    output reg        out_vsync
);

  localparam DEPTH_LOG2 = $clog2(FIFO_DEPTH);
  localparam [31:0] BLANK_COLOUR = BLANK;

  generate
    if (FIFO_DEPTH < 4 || (1 << DEPTH_LOG2) != FIFO_DEPTH) begin : g_fifo_depth
      ERROR_fifo_depth_must_be_a_power_of_two_of_at_least_4 error_instance ();
    end
  endgenerate

  // Lines are those of the camera's timing.
  wire unused_tlast = s_axis_tlast;

  // ---- clk: whole frames, or the beginning of one, into the FIFO.

  reg  crossing_rst_reg;
  reg  open_reg;
  wire full;
  wire write = s_axis_tvalid && (s_axis_tuser || open_reg) && !crossing_rst_reg;

  assign s_axis_tready = 1'b1;

  always @(posedge clk) begin
    crossing_rst_reg <= rst;
    if (write) open_reg <= !full;
    if (rst) open_reg <= 1'b0;
  end

  wire        pix_rst;
  wire        word_valid;
  wire [24:0] word;
  wire        take;

  reset_sync pix_reset (
      .clk    (pix_clk),
      .rst_in (crossing_rst_reg),
      .rst_out(pix_rst)
  );

  async_fifo #(
      .WIDTH     (25),
      .DEPTH_LOG2(DEPTH_LOG2)
  ) fifo (
      .wr_clk  (clk),
      .wr_rst  (crossing_rst_reg),
      .wr_en   (write),
      .wr_data ({s_axis_tuser, s_axis_tdata}),
      .wr_full (full),
      .rd_clk  (pix_clk),
      .rd_rst  (pix_rst),
      .rd_valid(word_valid),
      .rd_data (word),
      .rd_ready(take)
  );

  // ---- pix_clk: the syncs later.

  wire de;
  wire hsync;
  wire vsync;

  sync_delay #(
      .CYCLES      (DELAY - 1),
      .VSYNC_ACTIVE(VSYNC_ACTIVE)
  ) later (
      .pix_clk  (pix_clk),
      .pix_rst  (pix_rst),
      .de       (vid_de),
      .hsync    (vid_hsync),
      .vsync    (vid_vsync),
      .out_de   (de),
      .out_hsync(hsync),
      .out_vsync(vsync)
  );

  // ---- The frame that is shown.

  reg  starts_reg;  // vsync has passed: the next pixel is the first of a frame
  reg  shows_reg;  // within a frame that is whole so far
  reg  stale_reg;  // a first pixel that comes now is of a frame that was given up
  reg  later_idle_reg;
  reg  idle_reg;
  reg  blank_event_reg;
  wire first = word[24];
  wire show = word_valid && (starts_reg ? first && !stale_reg : shows_reg && !first);
  // Pixels without their frame. Between the lines of a frame that is shown they wait for the next.
  wire discard = word_valid && !shows_reg && (!first || stale_reg);

  assign take = (de && show) || discard;

  always @(posedge pix_clk or posedge pix_rst) begin
    if (pix_rst) begin
      starts_reg      <= 1'b0;
      shows_reg       <= 1'b0;
      stale_reg       <= 1'b1;
      later_idle_reg  <= VSYNC_ACTIVE == 0;
      idle_reg        <= VSYNC_ACTIVE == 0;
      blank_event_reg <= 1'b0;
    end else begin
      if (vid_de) idle_reg <= vid_vsync;
      if (de) later_idle_reg <= vsync;
      if (de) begin
        starts_reg <= 1'b0;
        shows_reg  <= show;
      end else if (vsync != later_idle_reg) begin
        starts_reg <= 1'b1;
        shows_reg  <= 1'b0;
      end
      if (de && starts_reg && !show) stale_reg <= 1'b1;
      else if (!vid_de && vid_vsync != idle_reg) stale_reg <= 1'b0;
      blank_event_reg <= de && !show && (starts_reg || shows_reg);
    end
  end

  always @(posedge pix_clk) begin
    out_data  <= !de ? 24'd0 : show ? word[23:0] : BLANK_COLOUR[23:0];
    out_de    <= de;
    out_hsync <= hsync;
    out_vsync <= vsync;
  end

  event_sync blank_sync (
      .src_clk  (pix_clk),
      .src_rst  (pix_rst),
      .src_event(blank_event_reg),
      .dst_clk  (clk),
      .dst_rst  (crossing_rst_reg),
      .dst_pulse(frame_blank)
  );

endmodule

`default_nettype wire
