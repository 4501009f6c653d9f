// SPDX-License-Identifier: Apache-2.0
// ccl against labelling by reachability, for every picture of 3x3, at full speed or with every gap and stall:
// as many objects as components, in the order of their last pixels, each with its area and its box.
`default_nettype none

module ccl_pictures #(
    parameter STALLS = 0
) (
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

  // reach[n]: which pixels are connected by a way of at most 2**n steps; no way in 3x3 needs more than eight.
  localparam CELLS = PIXELS * PIXELS;
  wire [CELLS-1:0] reach[0:3];
  wire [PIXELS-1:0] is_last;  // the last pixel of a component
  wire [3:0] index[0:PIXELS];  // of the component that ends there
  wire [PIXELS-1:0] chosen[0:PIXELS];  // pixels of the component that is sent next
  reg [3:0] sent;
  assign index[0] = 4'd0;
  assign chosen[0] = 9'd0;

  genvar i, j, n;
  generate
    for (i = 0; i < PIXELS; i = i + 1) begin : g_from
      for (j = 0; j < PIXELS; j = j + 1) begin : g_to
        localparam DX = i % SIZE - j % SIZE;
        localparam DY = i / SIZE - j / SIZE;
        assign reach[0][i*PIXELS+j] = picture[i] && picture[j] && DX * DX <= 1 && DY * DY <= 1;
        for (n = 0; n < 3; n = n + 1) begin : g_further
          assign reach[n+1][i*PIXELS+j] = |(reach[n][i*PIXELS+:PIXELS] & reach[n][j*PIXELS+:PIXELS]);
        end
      end
      wire [PIXELS-1:0] component = reach[3][i*PIXELS+:PIXELS];
      assign is_last[i] = picture[i] && (component >> (i + 1)) == 9'd0;
      assign index[i+1] = index[i] + {3'd0, is_last[i]};
      assign chosen[i+1] = chosen[i] | (is_last[i] && index[i] == sent ? component : 9'd0);
    end
  endgenerate

  wire [3:0] components = index[PIXELS];
  wire [PIXELS-1:0] object = chosen[PIXELS];
  wire [3:0] area = {3'd0, object[0]} + object[1] + object[2] + object[3] + object[4] + object[5] + object[6] + object[7] +
      object[8];
  wire [2:0] columns = object[2:0] | object[5:3] | object[8:6];
  wire [2:0] lines = {|object[8:6], |object[5:3], |object[2:0]};
  wire [1:0] min_x = columns[0] ? 2'd0 : columns[1] ? 2'd1 : 2'd2;
  wire [1:0] max_x = columns[2] ? 2'd2 : columns[1] ? 2'd1 : 2'd0;
  wire [1:0] min_y = lines[0] ? 2'd0 : lines[1] ? 2'd1 : 2'd2;
  wire [1:0] max_y = lines[2] ? 2'd2 : lines[1] ? 2'd1 : 2'd0;

  reg past;
  always @* if (STALLS == 0) assume (s_axis_tvalid && m_axis_tready);
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

  // Within the depth leave, at full speed, the trailer of the picture with most components; else an object that waited.
  reg waited, paused;
  always @(posedge clk) begin
    waited <= !rst && m_axis_tvalid && !m_axis_tready;
    paused <= !rst && (paused || next != 4'd0 && !s_axis_tvalid);
  end
  generate
    if (STALLS == 0) begin : g_whole
      always @(posedge clk) if (past && !rst) cover (m_axis_tvalid && m_axis_tlast && sent == 4'd4);
    end else begin : g_waits
      always @(posedge clk) if (past && !rst) cover (paused && waited && m_axis_tready && !m_axis_tlast);
    end
  endgenerate

endmodule

`default_nettype wire
