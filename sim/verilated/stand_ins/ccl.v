// SPDX-License-Identifier: Apache-2.0
// Stands in for ccl where a camera gives shapes instead of pixels: a beat with tuser begins a frame, 512 of those after
// it are one object, bit 0 first, and the beat with tlast ends the frame.
// An object takes the result_writer far less than the 512 clocks until the next one: nothing stalls.
`default_nettype none

module ccl #(
    parameter MAX_WIDTH  = 1280,
    parameter MAX_HEIGHT = 720,
    parameter AREA       = 1,
    parameter MOMENTS    = 2
) (
    input wire clk,
    input wire rst,

    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
    input wire [31:0] cfg_min_area,
    input wire        cfg_label_zeros,

    input  wire [0:0] s_axis_tdata,
    input  wire       s_axis_tvalid,
    output wire       s_axis_tready,
    input  wire       s_axis_tuser,
    input  wire       s_axis_tlast,

    output reg  [511:0] m_axis_tdata,
    output reg          m_axis_tvalid,
    input  wire         m_axis_tready,
    output reg          m_axis_tuser,
    output reg          m_axis_tlast,

    output reg  frame_started,
    output reg  last_pixel,
    output wire frame_error
);

    assign s_axis_tready = 1'b1;
    assign frame_error = 1'b0;

    reg [511:0] object_reg;
    reg [8:0]   bits_reg;
    reg         first_reg;
    reg         ending_reg;

    wire [511:0] object = {s_axis_tdata, object_reg[511:1]};

    always @(posedge clk) begin
        frame_started <= s_axis_tvalid && s_axis_tuser;
        last_pixel <= s_axis_tvalid && s_axis_tlast;
        ending_reg <= last_pixel;
        if (m_axis_tready) m_axis_tvalid <= 1'b0;
        if (m_axis_tvalid && m_axis_tready) first_reg <= 1'b0;
        if (s_axis_tvalid && s_axis_tuser) first_reg <= 1'b1;
        if (s_axis_tvalid) begin
            object_reg <= object;
            bits_reg <= s_axis_tuser ? 9'd0 : bits_reg + 9'd1;
        end
        if (s_axis_tvalid && !s_axis_tuser && !s_axis_tlast && bits_reg == 9'd511 && object[31:0] >= cfg_min_area) begin
            m_axis_tvalid <= 1'b1;
            m_axis_tdata <= object;
            m_axis_tuser <= first_reg;
            m_axis_tlast <= 1'b0;
        end
        if (ending_reg) begin
            m_axis_tvalid <= 1'b1;
            m_axis_tdata <= 512'd0;
            m_axis_tuser <= first_reg;
            m_axis_tlast <= 1'b1;
        end
        if (rst) begin
            frame_started <= 1'b0;
            last_pixel <= 1'b0;
            ending_reg <= 1'b0;
            m_axis_tvalid <= 1'b0;
        end
    end

endmodule

`default_nettype wire
