// SPDX-License-Identifier: Apache-2.0
// Stands in for video_in where a camera gives shapes instead of pixels (sim/cosim/shapes_camera.h): the same ports, the
// same counts, bits instead of pixels. pix_clk has the edges of clk.
//
// vid_vsync starts a frame; each vid_de after that carries one bit of the frame's objects in vid_data[0], but for the
// first, which carries none, and the last, which has vid_hsync instead. vid_vsync with vid_hsync is a malformed frame.
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
    output reg         frame_seen,
    output reg         frame_malformed,
    output wire        frame_overflow,
    output wire [15:0] measured_width,
    output wire [15:0] measured_height
);

    assign frame_overflow = 1'b0;
    assign measured_width = cfg_width;
    assign measured_height = cfg_height;

    // The frame on the wire is taken, and no bit of it has come yet.
    reg taken_reg;
    reg first_reg;

    always @(posedge clk) begin
        frame_seen <= vid_vsync;
        frame_malformed <= vid_vsync && vid_hsync && cfg_enable;
        if (vid_vsync) begin
            taken_reg <= cfg_enable && !vid_hsync;
            first_reg <= 1'b1;
            if (cfg_enable) begin
                frame_number <= frame_number + 32'd1;
                frame_start_us <= time_us;
            end
        end
        m_axis_tvalid <= vid_de && taken_reg;
        m_axis_tdata <= vid_data;
        m_axis_tuser <= first_reg;
        m_axis_tlast <= vid_hsync;
        if (vid_de) first_reg <= 1'b0;
        if (rst) begin
            frame_seen <= 1'b0;
            frame_malformed <= 1'b0;
            taken_reg <= 1'b0;
            frame_number <= 32'd0;
            frame_start_us <= 64'd0;
            m_axis_tvalid <= 1'b0;
        end
    end

endmodule

`default_nettype wire
