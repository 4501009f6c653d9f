// SPDX-License-Identifier: Apache-2.0
// rgb2gray: the output keeps the stream rules whatever comes in: any markers, any sizes at any time, any stalls.
`default_nettype none

module rgb2gray_stream (
    input wire clk,
    input wire rst,
    input wire [23:0] s_axis_tdata,
    input wire s_axis_tvalid,
    input wire s_axis_tuser,
    input wire s_axis_tlast,
    input wire m_axis_tready
);

  wire s_axis_tready, m_axis_tvalid, m_axis_tuser, m_axis_tlast;
  wire [7:0] m_axis_tdata;

  rgb2gray dut (.*);

  power_up start (.*);

  axis_rules #(
      .WIDTH(10)
  ) rules (
      .clk    (clk),
      .rst    (rst),
      .valid  (m_axis_tvalid),
      .ready  (m_axis_tready),
      .payload({m_axis_tuser, m_axis_tlast, m_axis_tdata})
  );

endmodule

`default_nettype wire
