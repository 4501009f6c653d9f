// SPDX-License-Identifier: Apache-2.0
// The pixels' way through landing_core: RGB of the camera to binary shapes. Joins the cores from rgb2gray to dilate3x3.
//
// Latency, throughput, border and rounding are those of the cores inside. Each stage's stream is named after what it
// carries. cfg_* must stand still from a frame's first pixel to that of the next; thresholds_missing is of the frame that
// threshold_apply works on.
// What the cores report of malformed frames (frame_error) is not led out: video_in cuts those off and counts them.

`default_nettype none

module pixel_chain #(
    parameter MAX_WIDTH = 1280,
    parameter MAX_HEIGHT = 720
) (
    input wire clk,
    input wire rst,

    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
    input wire [8:0]  cfg_factor,
    input wire [7:0]  cfg_flat_limit,
    input wire        cfg_dark_is_one,

    input  wire [23:0] s_axis_tdata,
    input  wire        s_axis_tvalid,
    output wire        s_axis_tready,
    input  wire        s_axis_tuser,
    input  wire        s_axis_tlast,

    output wire [0:0] m_axis_tdata,
    output wire       m_axis_tvalid,
    input  wire       m_axis_tready,
    output wire       m_axis_tuser,
    output wire       m_axis_tlast,

    // The gray pixels, each in the clock in which it is taken.
    output wire [7:0] gray_beat_tdata,
    output wire       gray_beat_tvalid,
    output wire       gray_beat_tuser,
    output wire       gray_beat_tlast,

    output wire thresholds_missing
);

    wire [7:0]  gray_tdata, smooth_tdata, checked_tdata;
    wire        binary_tdata, eroded_tdata, median_tdata;
    wire [31:0] stats_tdata;
    wire gray_tvalid, gray_tready, gray_tuser, gray_tlast;
    wire smooth_tvalid, smooth_tready, smooth_tuser, smooth_tlast;
    wire checked_tvalid, checked_tready, checked_tuser, checked_tlast;
    wire stats_tvalid, stats_tready, stats_tuser, stats_tlast;
    wire binary_tvalid, binary_tready, binary_tuser, binary_tlast;
    wire eroded_tvalid, eroded_tready, eroded_tuser, eroded_tlast;
    wire median_tvalid, median_tready, median_tuser, median_tlast;
    wire unused_stale;
    wire [5:0] unused_errors;

    assign gray_beat_tdata = gray_tdata;
    assign gray_beat_tvalid = gray_tvalid && gray_tready;
    assign gray_beat_tuser = gray_tuser;
    assign gray_beat_tlast = gray_tlast;

    rgb2gray to_gray (
        .clk(clk),
        .rst(rst),
        .s_axis_tdata(s_axis_tdata),
        .s_axis_tvalid(s_axis_tvalid),
        .s_axis_tready(s_axis_tready),
        .s_axis_tuser(s_axis_tuser),
        .s_axis_tlast(s_axis_tlast),
        .m_axis_tdata(gray_tdata),
        .m_axis_tvalid(gray_tvalid),
        .m_axis_tready(gray_tready),
        .m_axis_tuser(gray_tuser),
        .m_axis_tlast(gray_tlast)
    );

    gaussian5x5 #(
        .MAX_WIDTH(MAX_WIDTH),
        .MAX_HEIGHT(MAX_HEIGHT)
    ) smoothing (
        .clk(clk),
        .rst(rst),
        .cfg_width(cfg_width),
        .cfg_height(cfg_height),
        .s_axis_tdata(gray_tdata),
        .s_axis_tvalid(gray_tvalid),
        .s_axis_tready(gray_tready),
        .s_axis_tuser(gray_tuser),
        .s_axis_tlast(gray_tlast),
        .m_axis_tdata(smooth_tdata),
        .m_axis_tvalid(smooth_tvalid),
        .m_axis_tready(smooth_tready),
        .m_axis_tuser(smooth_tuser),
        .m_axis_tlast(smooth_tlast),
        .frame_error(unused_errors[0])
    );

    threshold_stats #(
        .MAX_WIDTH(MAX_WIDTH),
        .MAX_HEIGHT(MAX_HEIGHT)
    ) statistics (
        .clk(clk),
        .rst(rst),
        .cfg_width(cfg_width),
        .cfg_height(cfg_height),
        .cfg_factor(cfg_factor),
        .cfg_flat_limit(cfg_flat_limit),
        .s_axis_tdata(smooth_tdata),
        .s_axis_tvalid(smooth_tvalid),
        .s_axis_tready(smooth_tready),
        .s_axis_tuser(smooth_tuser),
        .s_axis_tlast(smooth_tlast),
        .m_axis_tdata(checked_tdata),
        .m_axis_tvalid(checked_tvalid),
        .m_axis_tready(checked_tready),
        .m_axis_tuser(checked_tuser),
        .m_axis_tlast(checked_tlast),
        .m_stat_axis_tdata(stats_tdata),
        .m_stat_axis_tvalid(stats_tvalid),
        .m_stat_axis_tready(stats_tready),
        .m_stat_axis_tuser(stats_tuser),
        .m_stat_axis_tlast(stats_tlast),
        .frame_error(unused_errors[1])
    );

    threshold_apply #(
        .MAX_WIDTH(MAX_WIDTH),
        .MAX_HEIGHT(MAX_HEIGHT)
    ) decision (
        .clk(clk),
        .rst(rst),
        .cfg_width(cfg_width),
        .cfg_height(cfg_height),
        .cfg_dark_is_one(cfg_dark_is_one),
        .s_axis_tdata(checked_tdata),
        .s_axis_tvalid(checked_tvalid),
        .s_axis_tready(checked_tready),
        .s_axis_tuser(checked_tuser),
        .s_axis_tlast(checked_tlast),
        .s_stat_axis_tdata(stats_tdata),
        .s_stat_axis_tvalid(stats_tvalid),
        .s_stat_axis_tready(stats_tready),
        .s_stat_axis_tuser(stats_tuser),
        .s_stat_axis_tlast(stats_tlast),
        .m_axis_tdata(binary_tdata),
        .m_axis_tvalid(binary_tvalid),
        .m_axis_tready(binary_tready),
        .m_axis_tuser(binary_tuser),
        .m_axis_tlast(binary_tlast),
        .thresholds_missing(thresholds_missing),
        .thresholds_stale(unused_stale),
        .frame_error(unused_errors[2])
    );

    erode3x3 #(
        .MAX_WIDTH(MAX_WIDTH),
        .MAX_HEIGHT(MAX_HEIGHT)
    ) erosion (
        .clk(clk),
        .rst(rst),
        .cfg_width(cfg_width),
        .cfg_height(cfg_height),
        .s_axis_tdata(binary_tdata),
        .s_axis_tvalid(binary_tvalid),
        .s_axis_tready(binary_tready),
        .s_axis_tuser(binary_tuser),
        .s_axis_tlast(binary_tlast),
        .m_axis_tdata(eroded_tdata),
        .m_axis_tvalid(eroded_tvalid),
        .m_axis_tready(eroded_tready),
        .m_axis_tuser(eroded_tuser),
        .m_axis_tlast(eroded_tlast),
        .frame_error(unused_errors[3])
    );

    median5x5 #(
        .MAX_WIDTH(MAX_WIDTH),
        .MAX_HEIGHT(MAX_HEIGHT)
    ) majority (
        .clk(clk),
        .rst(rst),
        .cfg_width(cfg_width),
        .cfg_height(cfg_height),
        .s_axis_tdata(eroded_tdata),
        .s_axis_tvalid(eroded_tvalid),
        .s_axis_tready(eroded_tready),
        .s_axis_tuser(eroded_tuser),
        .s_axis_tlast(eroded_tlast),
        .m_axis_tdata(median_tdata),
        .m_axis_tvalid(median_tvalid),
        .m_axis_tready(median_tready),
        .m_axis_tuser(median_tuser),
        .m_axis_tlast(median_tlast),
        .frame_error(unused_errors[4])
    );

    dilate3x3 #(
        .MAX_WIDTH(MAX_WIDTH),
        .MAX_HEIGHT(MAX_HEIGHT)
    ) dilation (
        .clk(clk),
        .rst(rst),
        .cfg_width(cfg_width),
        .cfg_height(cfg_height),
        .s_axis_tdata(median_tdata),
        .s_axis_tvalid(median_tvalid),
        .s_axis_tready(median_tready),
        .s_axis_tuser(median_tuser),
        .s_axis_tlast(median_tlast),
        .m_axis_tdata(m_axis_tdata),
        .m_axis_tvalid(m_axis_tvalid),
        .m_axis_tready(m_axis_tready),
        .m_axis_tuser(m_axis_tuser),
        .m_axis_tlast(m_axis_tlast),
        .frame_error(unused_errors[5])
    );

endmodule

`default_nettype wire
