// SPDX-License-Identifier: Apache-2.0
// A filter (`CORE`): the output keeps the stream rules whatever comes in: any markers, any sizes at any time, any stalls.
`default_nettype none

module filter_stream #(
    parameter BITS       = 1,
    parameter MAX_WIDTH  = 4,
    parameter MAX_HEIGHT = 4
) (
    input wire clk,
    input wire rst,
    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
    input wire [BITS-1:0] s_axis_tdata,
    input wire s_axis_tvalid,
    input wire s_axis_tuser,
    input wire s_axis_tlast,
    input wire m_axis_tready
);

  wire s_axis_tready, m_axis_tvalid, m_axis_tuser, m_axis_tlast, frame_error;
  wire [BITS-1:0] m_axis_tdata;

  `CORE #(
      .MAX_WIDTH (MAX_WIDTH),
      .MAX_HEIGHT(MAX_HEIGHT)
  ) dut (.*);

  power_up start (.*);

  axis_rules #(
      .WIDTH(BITS + 2)
  ) rules (
      .clk    (clk),
      .rst    (rst),
      .valid  (m_axis_tvalid),
      .ready  (m_axis_tready),
      .payload({m_axis_tuser, m_axis_tlast, m_axis_tdata})
  );

endmodule

`default_nettype wire
