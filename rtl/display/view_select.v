// SPDX-License-Identifier: Apache-2.0
// Chooses between the streams that landing_core shows: the camera's picture, gray, or the shapes.
//
// Latency: 1 cycle. Throughput: a pixel a cycle; nothing can make the streams wait. Border, rounding, overflow: none.
// view counts from the camera's next frame on: 0 camera, 1 gray, 2 and 3 shapes in white on black. Of the stream that is
// chosen then, the first pixel that comes through is the first of a frame.
// Limits: a frame of gray or shapes whose last lines come after the camera's next frame has begun is cut off there when the
// view changes.

`default_nettype none

module view_select (
    input wire clk,
    input wire rst,

    input wire [1:0] view,

    input wire [23:0] rgb_tdata,
    input wire        rgb_tvalid,
    input wire        rgb_tuser,
    input wire        rgb_tlast,
    input wire [ 7:0] gray_tdata,
    input wire        gray_tvalid,
    input wire        gray_tuser,
    input wire        gray_tlast,
    input wire        binary_tdata,
    input wire        binary_tvalid,
    input wire        binary_tuser,
    input wire        binary_tlast,

    output reg [23:0] m_axis_tdata,
    output reg        m_axis_tvalid,
    output reg        m_axis_tuser,
    output reg        m_axis_tlast
);

  reg [1:0] view_reg;
  reg open_reg;  // a frame of the chosen stream has begun
  wire frame_begins = rgb_tvalid && rgb_tuser;
  wire [1:0] chosen = frame_begins ? view : view_reg;
  wire stays = chosen == view_reg;

  reg [23:0] tdata;
  reg tvalid, tuser, tlast;

  always @* begin
    case (chosen)
      2'd0: {tdata, tvalid, tuser, tlast} = {rgb_tdata, rgb_tvalid, rgb_tuser, rgb_tlast};
      2'd1: {tdata, tvalid, tuser, tlast} = {{3{gray_tdata}}, gray_tvalid, gray_tuser, gray_tlast};
      default:
      {tdata, tvalid, tuser, tlast} = {
        {24{binary_tdata}}, binary_tvalid, binary_tuser, binary_tlast
      };
    endcase
  end

  wire passes = tvalid && (tuser || (open_reg && stays));

  always @(posedge clk) begin
    m_axis_tdata  <= tdata;
    m_axis_tuser  <= tuser;
    m_axis_tlast  <= tlast;
    m_axis_tvalid <= passes;
    view_reg      <= chosen;
    open_reg      <= passes || (open_reg && stays);
    if (rst) begin
      m_axis_tvalid <= 1'b0;
      view_reg      <= 2'd0;
      open_reg      <= 1'b0;
    end
  end

endmodule

`default_nettype wire
