// SPDX-License-Identifier: Apache-2.0
// Before the timing picture of landing_core.md: the registers are written, frame 1 passes whole and gives the thresholds
// of frame 2, and all lines of frame 2 but the last are shown. A frame is 16 x 16, white with a dark square of 6 x 6.
// The memory answers 3 clocks after the last beat of a burst, also in the picture.

localparam [15:0] FRAME_SIZE = 16;
localparam LAST_LINE = FRAME_SIZE - 1;
localparam SQUARE_LEFT = 5;
localparam SQUARE_TOP = 8;
localparam SQUARE_SIZE = 6;
localparam LINE_BLANKING = 4;
// The filters and ccl need 6 lines to flush, the memory its answers; the configuration crosses to pix_clk sooner.
localparam FRAME_BLANKING = 400;
localparam ANSWER_CLOCKS = 3;

reg [ANSWER_CLOCKS-1:0] answers = 0;

always @(posedge clk) begin
  answers <= rst ? 0 : {answers[ANSWER_CLOCKS-2:0], m_axi_wvalid && m_axi_wready && m_axi_wlast};
end
always @* m_axi_bvalid = answers[ANSWER_CLOCKS-1];

task write_register;
  input [11:0] offset;
  input [31:0] value;
  begin
    s_axil_awaddr  = offset;
    s_axil_wdata   = value;
    s_axil_awvalid = 1;
    s_axil_wvalid  = 1;
    @(posedge clk);
    #1 s_axil_awvalid = 0;
    s_axil_wvalid = 0;
    repeat (4) @(posedge clk);
    #1;
  end
endtask

task show_lines;
  input integer first;
  input integer last;
  integer x, y;
  begin
    for (y = first; y <= last; y = y + 1) begin
      for (x = 0; x < FRAME_SIZE; x = x + 1) begin
        vid_de = 1;
        vid_data = x >= SQUARE_LEFT && x < SQUARE_LEFT + SQUARE_SIZE && y >= SQUARE_TOP && y < SQUARE_TOP + SQUARE_SIZE
            ? 24'h101010 : 24'hFFFFFF;
        @(posedge clk);
        #1;
      end
      vid_de = 0;
      repeat (LINE_BLANKING) @(posedge clk);
      #1;
    end
  end
endtask

task start_frame;
  begin
    vid_vsync = 1;
    @(posedge clk);
    #1 vid_vsync = 0;
    repeat (LINE_BLANKING) @(posedge clk);
    #1;
  end
endtask

task prelude;
  begin
    write_register(12'h00C, {FRAME_SIZE, FRAME_SIZE});  // FRAME_SIZE
    write_register(12'h010, 32'h80);  // THRESHOLD: half way between minimum and maximum
    write_register(12'h014, 32'd4);  // MIN_AREA
    write_register(12'h018, 32'h1000);  // RING_BASE
    write_register(12'h02C, 32'h1);  // IRQ_ENABLE: frame_done
    write_register(12'h008, 32'h3);  // CTRL: enable, dark_is_one
    repeat (FRAME_BLANKING) @(posedge clk);
    #1 start_frame;
    show_lines(0, LAST_LINE);
    repeat (FRAME_BLANKING) @(posedge clk);
    #1 write_register(12'h028, 32'h1);  // IRQ_STATUS: frame 1 is done
    start_frame;
    show_lines(0, LAST_LINE - 1);
  end
endtask
