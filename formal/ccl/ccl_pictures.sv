// SPDX-License-Identifier: Apache-2.0
// ccl against labelling by reachability, for every picture of 3x3, with every gap in the input and every stall of the
// output: as many objects as components, in the order of their last pixels, each with its area and its box.
`default_nettype none

module ccl_pictures (
    input wire clk,
    input wire rst,
    input wire s_axis_tvalid,
    input wire m_axis_tready
);

  localparam SIZE = 3;
  localparam PIXELS = SIZE * SIZE;

  (* anyconst *) reg [PIXELS-1:0] picture;

  reg [3:0] next;  // the pixel that is offered
  wire [15:0] cfg_width = SIZE;
  wire [15:0] cfg_height = SIZE;
  wire [31:0] cfg_min_area = 32'd1;
  wire cfg_label_zeros = 1'b0;
  wire [0:0] s_axis_tdata = picture[next];
  wire s_axis_tuser = next == 4'd0;
  wire s_axis_tlast = next == 4'd2 || next == 4'd5 || next == 4'd8;
  wire s_axis_tready, m_axis_tvalid, m_axis_tuser, m_axis_tlast, frame_started, last_pixel, frame_error;
  wire [511:0] m_axis_tdata;

  ccl #(
      .MAX_WIDTH (4),
      .MAX_HEIGHT(4),
      .MOMENTS   (0)
  ) dut (.*);

  power_up start (.*);

  // Pixels that are connected: each pass takes in the neighbours of what was reached; four passes in raster order are plenty for 3x3.
  reg [PIXELS-1:0] grown;
  reg [PIXELS-1:0] is_last;  // the last pixel of a component
  reg [3:0] components, area;
  reg [1:0] min_x, max_x, min_y, max_y;
  reg [3:0] sent;
  integer i, j, k, pass;

  function near;
    input integer a;
    input integer b;
    near = (a % SIZE) - (b % SIZE) <= 1 && (b % SIZE) - (a % SIZE) <= 1 && a / SIZE - b / SIZE <= 1 && b / SIZE - a / SIZE <= 1;
  endfunction

  always @* begin
    components = 4'd0;
    area = 4'd0;
    {min_x, max_x, min_y, max_y} = 8'b11_00_11_00;
    for (i = 0; i < PIXELS; i = i + 1) begin
      grown = 9'd0;
      grown[i] = picture[i];
      for (pass = 0; pass < 4; pass = pass + 1)
        for (j = 0; j < PIXELS; j = j + 1)
          for (k = 0; k < PIXELS; k = k + 1) if (near(j, k) && grown[k] && picture[j]) grown[j] = 1'b1;
      is_last[i] = picture[i] && (grown >> (i + 1)) == 9'd0;
      if (is_last[i]) begin
        // The component that is sent next is described.
        if (components == sent)
          for (j = 0; j < PIXELS; j = j + 1)
            if (grown[j]) begin
              area = area + 4'd1;
              if (j % SIZE < min_x) min_x = j % SIZE;
              if (j % SIZE > max_x) max_x = j % SIZE;
              if (j / SIZE < min_y) min_y = j / SIZE;
              if (j / SIZE > max_y) max_y = j / SIZE;
            end
        components = components + 4'd1;
      end
    end
  end

  reg past;
  always @* if (past) assume (!rst);

  always @(posedge clk) begin
    past <= 1'b1;
    if (s_axis_tvalid && s_axis_tready) next <= next == 4'd8 ? 4'd0 : next + 4'd1;
    if (m_axis_tvalid && m_axis_tready) sent <= m_axis_tlast ? 4'd0 : sent + 4'd1;
    if (rst) {next, sent} <= 8'd0;
  end
  initial past = 1'b0;

  always @(posedge clk)
    if (past && !rst && m_axis_tvalid) begin
      assert (m_axis_tuser == (sent == 4'd0));
      assert (m_axis_tlast == (sent == components));
      if (!m_axis_tlast) begin
        assert (m_axis_tdata[31:0] == {28'd0, area});
        assert (m_axis_tdata[47:32] == {14'd0, min_x} && m_axis_tdata[63:48] == {14'd0, min_y});
        assert (m_axis_tdata[79:64] == {14'd0, max_x} && m_axis_tdata[95:80] == {14'd0, max_y});
      end
    end

endmodule

`default_nettype wire
