// SPDX-License-Identifier: Apache-2.0
// video_in: the output keeps the stream rules, whatever the camera sends, with pix_clk at any pace up
// to that of clk, or standing still.
`default_nettype none

module video_in_stream (
    input wire        clk,
    input wire        rst,
    input wire        pix_clk,
    input wire [23:0] vid_data,
    input wire        vid_de,
    input wire        vid_hsync,
    input wire        vid_vsync,
    input wire        cfg_enable,
    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,
    input wire [63:0] time_us,
    input wire        m_axis_tready
);

  wire m_axis_tvalid, m_axis_tuser, m_axis_tlast, frame_seen, frame_malformed, frame_overflow;
  wire [23:0] m_axis_tdata;
  wire [31:0] frame_number;
  wire [63:0] frame_start_us;
  wire [15:0] measured_width, measured_height;

  video_in #(
      .MAX_WIDTH (4),
      .MAX_HEIGHT(4),
      .FIFO_DEPTH(4)
  ) dut (.*);

  power_up start (.*);

  // The number and the time of a frame belong to the payload: they stand as long as its beat.
  axis_rules #(
      .WIDTH(122)
  ) rules (
      .clk    (clk),
      .rst    (rst),
      .valid  (m_axis_tvalid),
      .ready  (m_axis_tready),
      .payload({m_axis_tuser, m_axis_tlast, m_axis_tdata, frame_number, frame_start_us})
  );

  // A step of time is half a cycle of clk. Within a cycle, inputs of that clock do not change: they come from registers.
  (* gclk *) reg any_clk;
  reg clk_before, rst_before, ready_before;
  always @(posedge any_clk) begin
    clk_before   <= clk;
    rst_before   <= rst;
    ready_before <= m_axis_tready;
  end
  always @* assume (clk != clk_before);
  always @* if (!(clk && !clk_before)) assume (rst == rst_before && m_axis_tready == ready_before);

endmodule

`default_nettype wire
