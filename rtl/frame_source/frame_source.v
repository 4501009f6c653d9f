// SPDX-License-Identifier: Apache-2.0
// Plays one picture from memory as raw video on pix_clk, again and again, as a camera with 1280x720 at 60 Hz would: for
// bring-up without a camera.
//
// A pixel is 32 bit, little endian, 0x00RRGGBB; lines follow each other without padding. A beat holds two pixels; of an
// odd number of pixels the last beat is used by half. The picture begins at cfg_base, a multiple of 4096 (the low 12 bits
// count as 0). cfg_* are sampled where a frame begins to be read, behind the last pixel of the one before, and so is the
// picture itself: what is written meanwhile shows up in between. With cfg_enable 0 only syncs and black come, and nothing
// is read.
//
// Latency     1 cycle of pix_clk and 6 of clk, at most, from the last pixel of a frame at out_* to the first address of the
//             next, if nothing is under way.
// Throughput  one pixel a cycle of pix_clk, as long as memory gives a beat for every two of them in the mean, and FIFO_DEPTH
//             beats cover its pauses. MAX_OUTSTANDING bursts of 16 beats cover its latency.
// Border      none. Rounding: none; pixels are copied.
// Overflow    none: m_axi_rready is 0 while the FIFO is full. Underflow: from the first pixel that is not there in time to
//             the end of its frame BLANK comes, and underflow is one cycle of clk; the next frame is whole again if it
//             comes in time. After an error of memory (SLVERR, DECERR) nothing more of that frame is read: read_error is
//             one cycle of clk, and what is missing of the frame is blank and counts as underflow too.
// AXI         read channels only, 64 bit, INCR, at most 16 beats, none across 4 KiB, no IDs: AXI4, and AXI3 when arlen[7:4]
//             is left open. Bursts that were offered are taken to their end, whatever happens.
// Limits      the first frame after a reset is black. Between the frames there must be time to ask memory: 8 cycles of
//             pix_clk, 10 of clk and its latency. The picture ends below 2^32. A read channel that waits for pixels waits
//             long: give it a memory port of its own. pix_clk may stop and come back at any time, and out_* stands still
//             as long. A reset while a burst is under way breaks the protocol; reset the memory port too (system
//             reset). rst comes from a flip-flop.

`default_nettype none

module frame_source #(
    parameter WIDTH           = 1280,
    parameter H_FRONT         = 110,
    parameter H_SYNC          = 40,
    parameter H_TOTAL         = 1650,
    parameter HEIGHT          = 720,
    parameter V_FRONT         = 5,
    parameter V_SYNC          = 5,
    parameter V_TOTAL         = 750,
    parameter FIFO_DEPTH      = 1024,    // beats
    parameter MAX_OUTSTANDING = 4,
    parameter BLANK           = 2105376  // 202020
) (
    input wire clk,
    input wire rst,

    input wire        cfg_enable,
    input wire [31:0] cfg_base,

    output wire [31:0] m_axi_araddr,
    output wire [ 7:0] m_axi_arlen,
    output wire [ 2:0] m_axi_arsize,
    output wire [ 1:0] m_axi_arburst,
    output wire [ 3:0] m_axi_arcache,
    output wire [ 2:0] m_axi_arprot,
    output wire        m_axi_arvalid,
    input  wire        m_axi_arready,
    input  wire [63:0] m_axi_rdata,
    input  wire [ 1:0] m_axi_rresp,
    input  wire        m_axi_rlast,
    input  wire        m_axi_rvalid,
    output wire        m_axi_rready,

    output wire underflow,
    output wire read_error,

    input  wire        pix_clk,
    output wire [23:0] out_data,
    output wire        out_de,
    output wire        out_hsync,
    output wire        out_vsync
);

  localparam DEPTH_LOG2 = $clog2(FIFO_DEPTH);

  generate
    if (FIFO_DEPTH < 4 || (1 << DEPTH_LOG2) != FIFO_DEPTH) begin : g_fifo_depth
      ERROR_fifo_depth_must_be_a_power_of_two_of_at_least_4 error_instance ();
    end
  endgenerate

  // The crossings are reset asynchronously, so that a reset also counts while pix_clk stands still.
  reg         crossing_rst_reg;
  wire        pix_rst;

  wire        next_frame;
  wire        pix_next_frame;
  wire        pix_missing;

  wire        word_valid;
  wire [48:0] word;
  wire        word_full;
  wire        pix_word_valid;
  wire [48:0] pix_word;
  wire        pix_word_ready;

  always @(posedge clk) crossing_rst_reg <= rst;

  reset_sync pix_reset (
      .clk    (pix_clk),
      .rst_in (crossing_rst_reg),
      .rst_out(pix_rst)
  );

  frame_reader #(
      .PIXELS         (WIDTH * HEIGHT),
      .MAX_OUTSTANDING(MAX_OUTSTANDING)
  ) reader (
      .clk          (clk),
      .rst          (rst),
      .next_frame   (next_frame),
      .cfg_enable   (cfg_enable),
      .cfg_base     (cfg_base),
      .m_axi_araddr (m_axi_araddr),
      .m_axi_arlen  (m_axi_arlen),
      .m_axi_arsize (m_axi_arsize),
      .m_axi_arburst(m_axi_arburst),
      .m_axi_arcache(m_axi_arcache),
      .m_axi_arprot (m_axi_arprot),
      .m_axi_arvalid(m_axi_arvalid),
      .m_axi_arready(m_axi_arready),
      .m_axi_rdata  (m_axi_rdata),
      .m_axi_rresp  (m_axi_rresp),
      .m_axi_rlast  (m_axi_rlast),
      .m_axi_rvalid (m_axi_rvalid),
      .m_axi_rready (m_axi_rready),
      .word_valid   (word_valid),
      .word         (word),
      .word_full    (word_full),
      .read_error   (read_error)
  );

  async_fifo #(
      .WIDTH     (49),
      .DEPTH_LOG2(DEPTH_LOG2)
  ) fifo (
      .wr_clk  (clk),
      .wr_rst  (crossing_rst_reg),
      .wr_en   (word_valid),
      .wr_data (word),
      .wr_full (word_full),
      .rd_clk  (pix_clk),
      .rd_rst  (pix_rst),
      .rd_valid(pix_word_valid),
      .rd_data (pix_word),
      .rd_ready(pix_word_ready)
  );

  frame_player #(
      .WIDTH  (WIDTH),
      .H_FRONT(H_FRONT),
      .H_SYNC (H_SYNC),
      .H_TOTAL(H_TOTAL),
      .HEIGHT (HEIGHT),
      .V_FRONT(V_FRONT),
      .V_SYNC (V_SYNC),
      .V_TOTAL(V_TOTAL),
      .BLANK  (BLANK)
  ) player (
      .pix_clk   (pix_clk),
      .pix_rst   (pix_rst),
      .word_valid(pix_word_valid),
      .word      (pix_word),
      .word_ready(pix_word_ready),
      .next_frame(pix_next_frame),
      .missing   (pix_missing),
      .out_data  (out_data),
      .out_de    (out_de),
      .out_hsync (out_hsync),
      .out_vsync (out_vsync)
  );

  event_sync next_sync (
      .src_clk  (pix_clk),
      .src_rst  (pix_rst),
      .src_event(pix_next_frame),
      .dst_clk  (clk),
      .dst_rst  (crossing_rst_reg),
      .dst_pulse(next_frame)
  );

  event_sync missing_sync (
      .src_clk  (pix_clk),
      .src_rst  (pix_rst),
      .src_event(pix_missing),
      .dst_clk  (clk),
      .dst_rst  (crossing_rst_reg),
      .dst_pulse(underflow)
  );

endmodule

`default_nettype wire
