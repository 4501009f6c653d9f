// SPDX-License-Identifier: Apache-2.0
// landing_core: camera pixels in, records of labelled shapes in memory and an interrupt out. Joins all cores; holds
// no vendor primitive. docs/design.md draws the data's way, docs/registers.md lists the registers and the record.
//
// Clocks: pix_clk (camera) reaches only the input side of video_in; everything else runs on clk. rst is synchronous to
// clk. Time is counted in microseconds since reset, CLK_PER_US clocks each.
// Throughput: one pixel a clk; the bottom borders and the last lines of ccl are flushed during vertical blanking.
// Latency: docs/cores/landing_core.md; test_landing_core asserts it.
// Border: that of each core inside. Rounding: twice, in rgb2gray and in gaussian5x5.
// Overflow: a frame that finds the camera's FIFO full is cut off and counted (FRAMES_OVERFLOW); objects beyond
// MAX_OBJECTS are counted in the record.
// Configuration: what the registers hold when the first pixel of a frame leaves video_in counts for all cores and the
// record of that frame. FRAME_SIZE also counts at the camera, a few clocks earlier: a frame in which it changes is cut
// off and counted like any malformed one.
// A record describes one frame: number, start time and thresholds are held from the moment in which ccl takes its
// first pixel (frame_facts), however long memory lets the record wait. By then the next frame has not begun to leave
// video_in, if frames have at least 16 lines.
// Limits: frames of at least 16 x 16 pixels; a smaller FRAME_SIZE gives wrong frame numbers, never wrong pixels.

`default_nettype none

module landing_core #(
    parameter MAX_WIDTH = 1280,
    parameter MAX_HEIGHT = 720,
    parameter FIFO_DEPTH = 1024,
    parameter VSYNC_ACTIVE = 1,
    parameter MAX_OBJECTS = 256,
    parameter CLK_PER_US = 100,
    parameter HAS_DISPLAY = 0  // what FEATURES.display says
) (
    input  wire        clk,
    input  wire        rst,

    input  wire        pix_clk,
    input  wire [23:0] vid_data,
    input  wire        vid_de,
    input  wire        vid_hsync,
    input  wire        vid_vsync,

    input  wire [11:0] s_axil_awaddr,
    input  wire [2:0]  s_axil_awprot,
    input  wire        s_axil_awvalid,
    output wire        s_axil_awready,
    input  wire [31:0] s_axil_wdata,
    input  wire [3:0]  s_axil_wstrb,
    input  wire        s_axil_wvalid,
    output wire        s_axil_wready,
    output wire [1:0]  s_axil_bresp,
    output wire        s_axil_bvalid,
    input  wire        s_axil_bready,
    input  wire [11:0] s_axil_araddr,
    input  wire [2:0]  s_axil_arprot,
    input  wire        s_axil_arvalid,
    output wire        s_axil_arready,
    output wire [31:0] s_axil_rdata,
    output wire [1:0]  s_axil_rresp,
    output wire        s_axil_rvalid,
    input  wire        s_axil_rready,

    output wire [31:0] m_axi_awaddr,
    output wire [7:0]  m_axi_awlen,
    output wire [2:0]  m_axi_awsize,
    output wire [1:0]  m_axi_awburst,
    output wire [3:0]  m_axi_awcache,
    output wire [2:0]  m_axi_awprot,
    output wire        m_axi_awvalid,
    input  wire        m_axi_awready,
    output wire [63:0] m_axi_wdata,
    output wire [7:0]  m_axi_wstrb,
    output wire        m_axi_wlast,
    output wire        m_axi_wvalid,
    input  wire        m_axi_wready,
    input  wire [1:0]  m_axi_bresp,
    input  wire        m_axi_bvalid,
    output wire        m_axi_bready,

    input  wire        lidar_in,
    output wire        lidar_drive_low,

    output wire        irq,

    // For a display: what passes, each beat once, in the clock in which it is taken. Nothing here waits for it.
    output wire [15:0] view_width,
    output wire [15:0] view_height,
    output wire [23:0] view_rgb_tdata,
    output wire        view_rgb_tvalid,
    output wire        view_rgb_tuser,
    output wire        view_rgb_tlast,
    output wire [7:0]  view_gray_tdata,
    output wire        view_gray_tvalid,
    output wire        view_gray_tuser,
    output wire        view_gray_tlast,
    output wire        view_binary_tdata,   // 1: ccl labels the pixel
    output wire        view_binary_tvalid,
    output wire        view_binary_tuser,
    output wire        view_binary_tlast
);

    `include "result_record.vh"

    localparam [31:0] OBJECT_LIMIT = MAX_OBJECTS;
    localparam [31:0] BUFFERS = RING_BUFFERS;

    generate
        if (CLK_PER_US < 2 || CLK_PER_US > 1023) begin : g_clk_per_us
            ERROR_clk_per_us_must_be_2_to_1023 error_instance();
        end
    endgenerate

    // ---- Time.

    localparam [31:0] LAST_CLK_OF_US = CLK_PER_US - 1;

    reg [9:0]  clk_count_reg;
    reg        tick_us_reg;
    reg [63:0] time_us_reg;

    always @(posedge clk) begin
        tick_us_reg <= clk_count_reg == LAST_CLK_OF_US[9:0];
        clk_count_reg <= clk_count_reg == LAST_CLK_OF_US[9:0] ? 10'd0 : clk_count_reg + 10'd1;
        if (tick_us_reg) time_us_reg <= time_us_reg + 64'd1;
        if (rst) begin
            clk_count_reg <= 10'd0;
            tick_us_reg <= 1'b0;
            time_us_reg <= 64'd0;
        end
    end

    // ---- Registers.

    wire        ctrl_enable;
    wire        ctrl_dark_is_one;
    wire        ctrl_label_zeros;
    wire [15:0] size_width;
    wire [15:0] size_height;
    wire [8:0]  threshold_factor;
    wire [7:0]  threshold_flat_limit;
    wire [31:0] min_area;
    wire [31:0] ring_base;
    wire        lidar_enable;

    wire [7:0]  ring_head;
    wire        ring_head_valid;
    wire [31:0] written_frame_number;
    wire [31:0] frames_unwritten;
    wire        frame_done;
    wire        axi_error;

    wire        frame_seen;
    wire        frame_malformed;
    wire        frame_overflow;
    wire [15:0] measured_width;
    wire [15:0] measured_height;
    reg  [31:0] frames_seen_reg;
    reg  [31:0] frames_malformed_reg;
    reg  [31:0] frames_overflow_reg;

    wire [31:0] lidar_distance_mm;
    wire [31:0] lidar_age_us;
    wire        lidar_valid;
    wire        lidar_timeout;
    wire        lidar_too_long;
    wire        lidar_too_short;
    reg         lidar_valid_reg;
    reg         lidar_broken_reg;
    wire        lidar_broken = lidar_timeout || lidar_too_long;
    // A sensor that never worked is a fault too; one that is switched off is none.
    wire        lidar_lost = (lidar_valid_reg && !lidar_valid) || (lidar_broken && !lidar_broken_reg);
    wire        lidar_fault = lidar_enable && lidar_lost;

    always @(posedge clk) begin
        if (frame_seen) frames_seen_reg <= frames_seen_reg + 32'd1;
        if (frame_malformed) frames_malformed_reg <= frames_malformed_reg + 32'd1;
        if (frame_overflow) frames_overflow_reg <= frames_overflow_reg + 32'd1;
        lidar_valid_reg <= lidar_valid;
        lidar_broken_reg <= lidar_broken;
        if (rst) begin
            frames_seen_reg <= 32'd0;
            frames_malformed_reg <= 32'd0;
            frames_overflow_reg <= 32'd0;
            lidar_valid_reg <= 1'b0;
            lidar_broken_reg <= 1'b0;
        end
    end

    landing_regs regs (
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
        .ctrl_enable(ctrl_enable),
        .ctrl_dark_is_one(ctrl_dark_is_one),
        .ctrl_label_zeros(ctrl_label_zeros),
        .frame_size_width(size_width),
        .frame_size_height(size_height),
        .threshold_factor(threshold_factor),
        .threshold_flat_limit(threshold_flat_limit),
        .min_area_pixels(min_area),
        .ring_base_address(ring_base),
        .ring_info_buffers(BUFFERS[7:0]),
        .ring_info_max_objects(OBJECT_LIMIT[15:0]),
        .ring_head_index(ring_head),
        .ring_head_valid(ring_head_valid),
        .frame_number_number(written_frame_number),
        .irq_status_frame_done_set(frame_done),
        .irq_status_frame_malformed_set(frame_malformed),
        .irq_status_frame_overflow_set(frame_overflow),
        .irq_status_axi_error_set(axi_error),
        .irq_status_lidar_fault_set(lidar_fault),
        .frames_seen_count(frames_seen_reg),
        .frames_malformed_count(frames_malformed_reg),
        .frames_overflow_count(frames_overflow_reg),
        .frames_unwritten_count(frames_unwritten),
        .measured_size_width(measured_width),
        .measured_size_height(measured_height),
        .lidar_ctrl_enable(lidar_enable),
        .lidar_distance_mm(lidar_distance_mm),
        .lidar_age_us(lidar_age_us),
        .lidar_status_valid(lidar_valid),
        .lidar_status_timeout(lidar_timeout),
        .lidar_status_too_long(lidar_too_long),
        .lidar_status_too_short(lidar_too_short),
        .time_lo_us(time_us_reg[31:0]),
        .time_hi_us(time_us_reg[63:32]),
        .features_display(HAS_DISPLAY != 0),
        .irq(irq)
    );

    // ---- Camera. Each stage's stream is named after what it carries.

    wire [23:0] rgb_tdata;
    wire        rgb_tvalid, rgb_tready, rgb_tuser, rgb_tlast;
    wire [31:0] camera_frame_number;
    wire [63:0] camera_frame_start_us;

    video_in #(
        .MAX_WIDTH(MAX_WIDTH),
        .MAX_HEIGHT(MAX_HEIGHT),
        .FIFO_DEPTH(FIFO_DEPTH),
        .VSYNC_ACTIVE(VSYNC_ACTIVE)
    ) camera (
        .clk(clk),
        .rst(rst),
        .pix_clk(pix_clk),
        .vid_data(vid_data),
        .vid_de(vid_de),
        .vid_hsync(vid_hsync),
        .vid_vsync(vid_vsync),
        .cfg_enable(ctrl_enable),
        .cfg_width(size_width),
        .cfg_height(size_height),
        .time_us(time_us_reg),
        .m_axis_tdata(rgb_tdata),
        .m_axis_tvalid(rgb_tvalid),
        .m_axis_tready(rgb_tready),
        .m_axis_tuser(rgb_tuser),
        .m_axis_tlast(rgb_tlast),
        .frame_number(camera_frame_number),
        .frame_start_us(camera_frame_start_us),
        .frame_seen(frame_seen),
        .frame_malformed(frame_malformed),
        .frame_overflow(frame_overflow),
        .measured_width(measured_width),
        .measured_height(measured_height)
    );

    // One configuration for the whole way of a frame, whenever the CPU writes.
    reg [15:0] width_reg;
    reg [15:0] height_reg;
    reg [8:0]  factor_reg;
    reg [7:0]  flat_limit_reg;
    reg        dark_is_one_reg;
    reg        label_zeros_reg;
    reg [31:0] min_area_reg;

    always @(posedge clk) begin
        if (rgb_tvalid && rgb_tready && rgb_tuser) begin
            width_reg <= size_width;
            height_reg <= size_height;
            factor_reg <= threshold_factor;
            flat_limit_reg <= threshold_flat_limit;
            dark_is_one_reg <= ctrl_dark_is_one;
            label_zeros_reg <= ctrl_label_zeros;
            min_area_reg <= min_area;
        end
    end

    // ---- Pixels to binary shapes.

    wire        dilated_tdata;
    wire        dilated_tvalid, dilated_tready, dilated_tuser, dilated_tlast;
    wire        thresholds_missing;

    pixel_chain #(
        .MAX_WIDTH(MAX_WIDTH),
        .MAX_HEIGHT(MAX_HEIGHT)
    ) chain (
        .clk(clk),
        .rst(rst),
        .cfg_width(width_reg),
        .cfg_height(height_reg),
        .cfg_factor(factor_reg),
        .cfg_flat_limit(flat_limit_reg),
        .cfg_dark_is_one(dark_is_one_reg),
        .s_axis_tdata(rgb_tdata),
        .s_axis_tvalid(rgb_tvalid),
        .s_axis_tready(rgb_tready),
        .s_axis_tuser(rgb_tuser),
        .s_axis_tlast(rgb_tlast),
        .m_axis_tdata(dilated_tdata),
        .m_axis_tvalid(dilated_tvalid),
        .m_axis_tready(dilated_tready),
        .m_axis_tuser(dilated_tuser),
        .m_axis_tlast(dilated_tlast),
        .gray_beat_tdata(view_gray_tdata),
        .gray_beat_tvalid(view_gray_tvalid),
        .gray_beat_tuser(view_gray_tuser),
        .gray_beat_tlast(view_gray_tlast),
        .thresholds_missing(thresholds_missing)
    );

    assign view_width = width_reg;
    assign view_height = height_reg;
    assign view_rgb_tdata = rgb_tdata;
    assign view_rgb_tvalid = rgb_tvalid && rgb_tready;
    assign view_rgb_tuser = rgb_tuser;
    assign view_rgb_tlast = rgb_tlast;
    assign view_binary_tdata = dilated_tdata != label_zeros_reg;
    assign view_binary_tvalid = dilated_tvalid && dilated_tready;
    assign view_binary_tuser = dilated_tuser;
    assign view_binary_tlast = dilated_tlast;

    // ---- Shapes to records.

    wire [511:0] objects_tdata;
    wire         objects_tvalid, objects_tready, objects_tuser, objects_tlast;
    wire         frame_started;
    wire         last_pixel;
    wire         unused_error;

    ccl #(
        .MAX_WIDTH(MAX_WIDTH),
        .MAX_HEIGHT(MAX_HEIGHT)
    ) labelling (
        .clk(clk),
        .rst(rst),
        .cfg_width(width_reg),
        .cfg_height(height_reg),
        .cfg_min_area(min_area_reg),
        .cfg_label_zeros(label_zeros_reg),
        .s_axis_tdata(dilated_tdata),
        .s_axis_tvalid(dilated_tvalid),
        .s_axis_tready(dilated_tready),
        .s_axis_tuser(dilated_tuser),
        .s_axis_tlast(dilated_tlast),
        .m_axis_tdata(objects_tdata),
        .m_axis_tvalid(objects_tvalid),
        .m_axis_tready(objects_tready),
        .m_axis_tuser(objects_tuser),
        .m_axis_tlast(objects_tlast),
        .frame_error(unused_error),
        .frame_started(frame_started),
        .last_pixel(last_pixel)
    );

    wire [31:0] frame_number;
    wire [63:0] frame_start_us;
    wire [15:0] frame_width;
    wire [15:0] frame_height;
    wire [8:0]  frame_factor;
    wire [31:0] frame_min_area;
    wire        frame_missing;
    wire        frame_stale;
    wire [31:0] frame_scan_time_us;

    frame_facts facts (
        .clk(clk),
        .rst(rst),
        .frame_started(frame_started),
        .last_pixel(last_pixel),
        .pop(objects_tvalid && objects_tready && objects_tlast),
        .time_us(time_us_reg[31:0]),
        .frame_number(camera_frame_number),
        .frame_start_us(camera_frame_start_us),
        .width(width_reg),
        .height(height_reg),
        .factor(factor_reg),
        .min_area(min_area_reg),
        .thresholds_missing(thresholds_missing),
        .queued_number(frame_number),
        .queued_start_us(frame_start_us),
        .queued_width(frame_width),
        .queued_height(frame_height),
        .queued_factor(frame_factor),
        .queued_min_area(frame_min_area),
        .queued_missing(frame_missing),
        .queued_stale(frame_stale),
        .queued_scan_time_us(frame_scan_time_us)
    );

    result_writer #(
        .MAX_OBJECTS(MAX_OBJECTS)
    ) writer (
        .clk(clk),
        .rst(rst),
        .ring_base(ring_base),
        .frame_number(frame_number),
        .frame_start_us(frame_start_us),
        .frame_width(frame_width),
        .frame_height(frame_height),
        .threshold_factor(frame_factor),
        .min_area(frame_min_area),
        .thresholds_missing(frame_missing),
        .thresholds_stale(frame_stale),
        .scan_time_us(frame_scan_time_us),
        .altitude_mm(lidar_distance_mm),
        .altitude_age_us(lidar_age_us),
        .altitude_valid(lidar_valid),
        .frames_malformed(frames_malformed_reg),
        .frames_overflow(frames_overflow_reg),
        .s_axis_tdata(objects_tdata),
        .s_axis_tvalid(objects_tvalid),
        .s_axis_tready(objects_tready),
        .s_axis_tuser(objects_tuser),
        .s_axis_tlast(objects_tlast),
        .m_axi_awaddr(m_axi_awaddr),
        .m_axi_awlen(m_axi_awlen),
        .m_axi_awsize(m_axi_awsize),
        .m_axi_awburst(m_axi_awburst),
        .m_axi_awcache(m_axi_awcache),
        .m_axi_awprot(m_axi_awprot),
        .m_axi_awvalid(m_axi_awvalid),
        .m_axi_awready(m_axi_awready),
        .m_axi_wdata(m_axi_wdata),
        .m_axi_wstrb(m_axi_wstrb),
        .m_axi_wlast(m_axi_wlast),
        .m_axi_wvalid(m_axi_wvalid),
        .m_axi_wready(m_axi_wready),
        .m_axi_bresp(m_axi_bresp),
        .m_axi_bvalid(m_axi_bvalid),
        .m_axi_bready(m_axi_bready),
        .ring_head_index(ring_head),
        .ring_head_valid(ring_head_valid),
        .written_frame_number(written_frame_number),
        .frames_unwritten(frames_unwritten),
        .frame_done(frame_done),
        .axi_error(axi_error)
    );

    // ---- Altitude.

    wire unused_updated;

    lidar_pwm lidar (
        .clk(clk),
        .rst(rst),
        .tick_us(tick_us_reg),
        .enable(lidar_enable),
        .lidar_in(lidar_in),
        .lidar_drive_low(lidar_drive_low),
        .distance_mm(lidar_distance_mm),
        .valid(lidar_valid),
        .age_us(lidar_age_us),
        .updated(unused_updated),
        .timeout(lidar_timeout),
        .too_long(lidar_too_long),
        .too_short(lidar_too_short)
    );

endmodule

`default_nettype wire
