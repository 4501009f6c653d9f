// SPDX-License-Identifier: Apache-2.0
// Stands in for pixel_chain where a camera gives shapes instead of pixels: bits pass through, and thresholds are missing
// until one frame has passed.
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

    // No camera, no gray.
    output wire [7:0] gray_beat_tdata,
    output wire       gray_beat_tvalid,
    output wire       gray_beat_tuser,
    output wire       gray_beat_tlast,

    output reg thresholds_missing
);

    assign gray_beat_tdata = 8'd0;
    assign gray_beat_tvalid = 1'b0;
    assign gray_beat_tuser = 1'b0;
    assign gray_beat_tlast = 1'b0;
    assign m_axis_tdata = s_axis_tdata[0];
    assign m_axis_tvalid = s_axis_tvalid;
    assign s_axis_tready = m_axis_tready;
    assign m_axis_tuser = s_axis_tuser;
    assign m_axis_tlast = s_axis_tlast;

    always @(posedge clk) begin
        if (s_axis_tvalid && s_axis_tlast) thresholds_missing <= 1'b0;
        if (rst) thresholds_missing <= 1'b1;
    end

endmodule

`default_nettype wire
