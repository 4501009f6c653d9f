// SPDX-License-Identifier: Apache-2.0
// The monitor behind landing_core: what the camera sees or what becomes of it, with what the firmware found drawn over it, in
// the camera's own timing. Registers (docs/display_registers.md) say what is drawn, where the picture comes from and how the
// pixel clock fares. Without it landing_core works as well.
//
// Latency     DELAY cycles of pix_clk from vid_* to out_*, 13200 by default.
// Throughput  one pixel a clk, no stalls: view_* are watched, never held.
// Border      none. Rounding: that of overlay.
// Overflow    that of video_out: a frame that is not in time is BLANK from there on, flagged and counted.
// Limits      those of overlay and video_out. What is drawn is what the registers hold with the first pixel of a frame, while
//             CTRL.hold is 0; the view counts from the camera's next frame on. A pad found in a frame is drawn a frame or two
//             later. pix_clk may stop and come back at any time. rst comes from a flip-flop.

`default_nettype none

module display #(
    parameter MAX_WIDTH    = 1280,
    parameter MAX_HEIGHT   = 720,
    parameter DELAY        = 13200,
    parameter FIFO_DEPTH   = 16384,
    parameter VSYNC_ACTIVE = 1,
    parameter BLANK        = 2105376,  // 202020
    parameter CLK_PER_US   = 100
) (
    input wire clk,
    input wire rst,

    input  wire [11:0] s_axil_awaddr,
    input  wire [ 2:0] s_axil_awprot,
    input  wire        s_axil_awvalid,
    output wire        s_axil_awready,
    input  wire [31:0] s_axil_wdata,
    input  wire [ 3:0] s_axil_wstrb,
    input  wire        s_axil_wvalid,
    output wire        s_axil_wready,
    output wire [ 1:0] s_axil_bresp,
    output wire        s_axil_bvalid,
    input  wire        s_axil_bready,
    input  wire [11:0] s_axil_araddr,
    input  wire [ 2:0] s_axil_arprot,
    input  wire        s_axil_arvalid,
    output wire        s_axil_arready,
    output wire [31:0] s_axil_rdata,
    output wire [ 1:0] s_axil_rresp,
    output wire        s_axil_rvalid,
    input  wire        s_axil_rready,

    // From landing_core: beats that have been taken.
    input wire [15:0] view_width,
    input wire [15:0] view_height,
    input wire [23:0] view_rgb_tdata,
    input wire        view_rgb_tvalid,
    input wire        view_rgb_tuser,
    input wire        view_rgb_tlast,
    input wire [ 7:0] view_gray_tdata,
    input wire        view_gray_tvalid,
    input wire        view_gray_tuser,
    input wire        view_gray_tlast,
    input wire        view_binary_tdata,
    input wire        view_binary_tvalid,
    input wire        view_binary_tuser,
    input wire        view_binary_tlast,

    input  wire        pix_clk,
    input  wire        vid_de,
    input  wire        vid_hsync,
    input  wire        vid_vsync,
    output wire [23:0] out_data,
    output wire        out_de,
    output wire        out_hsync,
    output wire        out_vsync,

    // The board; inputs are asynchronous unless told.
    input  wire        pix_clk_locked,
    input  wire        monitor_present,
    input  wire [ 3:0] buttons,
    input  wire [ 1:0] switches,
    output wire [ 3:0] leds,
    output wire [ 1:0] source,            // 0 camera, 1 pattern_source, 2 frame_source
    output wire        pattern_move,
    output wire [31:0] stored_base,
    input  wire        stored_underflow,  // on clk, as the next
    input  wire        stored_error
);

  wire [1:0] view;
  wire hold;
  wire show_text;
  wire show_text_bank;
  wire show_pad;
  wire show_crosshair;
  wire [3:0] show_boxes;
  wire [223:0] boxes;
  wire [13:0] centre_x;
  wire [13:0] centre_y;
  wire [13:0] tip_x;
  wire [13:0] tip_y;
  wire [6:0] text_char;
  wire text_char_written;
  wire [5:0] text_column;
  wire text_line;
  wire text_bank;

  wire clock_runs;
  wire clock_lost;
  wire [19:0] clock_khz;
  wire clock_locked;
  wire monitor;
  wire [3:0] buttons_now;
  wire [1:0] switches_now;
  wire frame_blank;
  reg [31:0] frames_blank_reg;
  reg crossing_rst_reg;

  display_regs registers (
      .clk(clk),
      .rst(rst),
      .s_axil_awaddr(s_axil_awaddr),
      .s_axil_awprot(s_axil_awprot),
      .s_axil_awvalid(s_axil_awvalid),
      .s_axil_awready(s_axil_awready),
      .s_axil_wdata(s_axil_wdata),
      .s_axil_wstrb(s_axil_wstrb),
      .s_axil_wvalid(s_axil_wvalid),
      .s_axil_wready(s_axil_wready),
      .s_axil_bresp(s_axil_bresp),
      .s_axil_bvalid(s_axil_bvalid),
      .s_axil_bready(s_axil_bready),
      .s_axil_araddr(s_axil_araddr),
      .s_axil_arprot(s_axil_arprot),
      .s_axil_arvalid(s_axil_arvalid),
      .s_axil_arready(s_axil_arready),
      .s_axil_rdata(s_axil_rdata),
      .s_axil_rresp(s_axil_rresp),
      .s_axil_rvalid(s_axil_rvalid),
      .s_axil_rready(s_axil_rready),
      .ctrl_source(source),
      .ctrl_view(view),
      .ctrl_pattern_move(pattern_move),
      .ctrl_hold(hold),
      .show_text(show_text),
      .show_text_bank(show_text_bank),
      .show_pad(show_pad),
      .show_crosshair(show_crosshair),
      .show_boxes(show_boxes),
      .ring_from_left(boxes[0+:14]),
      .ring_from_top(boxes[14+:14]),
      .ring_to_right(boxes[28+:14]),
      .ring_to_bottom(boxes[42+:14]),
      .square_from_left(boxes[56+:14]),
      .square_from_top(boxes[70+:14]),
      .square_to_right(boxes[84+:14]),
      .square_to_bottom(boxes[98+:14]),
      .rectangle_from_left(boxes[112+:14]),
      .rectangle_from_top(boxes[126+:14]),
      .rectangle_to_right(boxes[140+:14]),
      .rectangle_to_bottom(boxes[154+:14]),
      .small_ring_from_left(boxes[168+:14]),
      .small_ring_from_top(boxes[182+:14]),
      .small_ring_to_right(boxes[196+:14]),
      .small_ring_to_bottom(boxes[210+:14]),
      .centre_x(centre_x),
      .centre_y(centre_y),
      .tip_x(tip_x),
      .tip_y(tip_y),
      .text_char(text_char),
      .text_char_written(text_char_written),
      .text_column(text_column),
      .text_line(text_line),
      .text_bank(text_bank),
      .leds_on(leds),
      .status_clock_runs(clock_runs),
      .status_clock_locked(clock_locked),
      .status_monitor(monitor),
      .status_buttons(buttons_now),
      .status_switches(switches_now),
      .events_clock_lost_set(clock_lost),
      .events_frame_blank_set(frame_blank),
      .events_stored_underflow_set(stored_underflow),
      .events_stored_error_set(stored_error),
      .pix_clk_khz(clock_khz),
      .frames_blank_count(frames_blank_reg),
      .stored_base_address(stored_base)
  );

  always @(posedge clk) begin
    crossing_rst_reg <= rst;
    if (frame_blank) frames_blank_reg <= frames_blank_reg + 32'd1;
    if (rst) frames_blank_reg <= 32'd0;
  end

  clock_meter #(
      .CLK_PER_US(CLK_PER_US)
  ) meter (
      .clk      (clk),
      .rst      (rst),
      .meter_clk(pix_clk),
      .khz      (clock_khz),
      .runs     (clock_runs),
      .lost     (clock_lost)
  );

  sync_bits #(
      .WIDTH(8)
  ) board_sync (
      .clk(clk),
      .rst(crossing_rst_reg),
      .d  ({pix_clk_locked, monitor_present, buttons, switches}),
      .q  ({clock_locked, monitor, buttons_now, switches_now})
  );

  wire [23:0] picture_tdata, drawn_tdata;
  wire picture_tvalid, picture_tuser, picture_tlast;
  wire drawn_tvalid, drawn_tready, drawn_tuser, drawn_tlast;
  wire unused_ready, unused_error;

  view_select select (
      .clk          (clk),
      .rst          (rst),
      .view         (view),
      .rgb_tdata    (view_rgb_tdata),
      .rgb_tvalid   (view_rgb_tvalid),
      .rgb_tuser    (view_rgb_tuser),
      .rgb_tlast    (view_rgb_tlast),
      .gray_tdata   (view_gray_tdata),
      .gray_tvalid  (view_gray_tvalid),
      .gray_tuser   (view_gray_tuser),
      .gray_tlast   (view_gray_tlast),
      .binary_tdata (view_binary_tdata),
      .binary_tvalid(view_binary_tvalid),
      .binary_tuser (view_binary_tuser),
      .binary_tlast (view_binary_tlast),
      .m_axis_tdata (picture_tdata),
      .m_axis_tvalid(picture_tvalid),
      .m_axis_tuser (picture_tuser),
      .m_axis_tlast (picture_tlast)
  );

  overlay #(
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT)
  ) drawing (
      .clk               (clk),
      .rst               (rst),
      .cfg_width         (view_width),
      .cfg_height        (view_height),
      .cfg_hold          (hold),
      .cfg_tint          (view == 2'd3),
      .cfg_show_text     (show_text),
      .cfg_text_bank     (show_text_bank),
      .cfg_show_pad      (show_pad),
      .cfg_show_crosshair(show_crosshair),
      .cfg_show_boxes    (show_boxes),
      .cfg_boxes         (boxes),
      .cfg_centre_x      (centre_x),
      .cfg_centre_y      (centre_y),
      .cfg_tip_x         (tip_x),
      .cfg_tip_y         (tip_y),
      .text_write        (text_char_written),
      .text_address      ({text_bank, text_line, text_column}),
      .text_char         (text_char),
      .s_axis_tdata      (picture_tdata),
      .s_axis_tvalid     (picture_tvalid),
      .s_axis_tready     (unused_ready),                         // 1: video_out takes all
      .s_axis_tuser      (picture_tuser),
      .s_axis_tlast      (picture_tlast),
      .m_axis_tdata      (drawn_tdata),
      .m_axis_tvalid     (drawn_tvalid),
      .m_axis_tready     (drawn_tready),
      .m_axis_tuser      (drawn_tuser),
      .m_axis_tlast      (drawn_tlast),
      .frame_error       (unused_error)
  );

  video_out #(
      .DELAY       (DELAY),
      .FIFO_DEPTH  (FIFO_DEPTH),
      .VSYNC_ACTIVE(VSYNC_ACTIVE),
      .BLANK       (BLANK)
  ) to_monitor (
      .clk          (clk),
      .rst          (rst),
      .s_axis_tdata (drawn_tdata),
      .s_axis_tvalid(drawn_tvalid),
      .s_axis_tready(drawn_tready),
      .s_axis_tuser (drawn_tuser),
      .s_axis_tlast (drawn_tlast),
      .frame_blank  (frame_blank),
      .pix_clk      (pix_clk),
      .vid_de       (vid_de),
      .vid_hsync    (vid_hsync),
      .vid_vsync    (vid_vsync),
      .out_data     (out_data),
      .out_de       (out_de),
      .out_hsync    (out_hsync),
      .out_vsync    (out_vsync)
  );

endmodule

`default_nettype wire
