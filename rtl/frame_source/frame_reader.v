// SPDX-License-Identifier: Apache-2.0
// The side of frame_source that reads memory: for each next_frame one header, then the beats of one picture, as words.
//
// Words: a header {1, 43'd0, frame number mod 16, 1 = a picture follows}, then {0, second pixel, first pixel} for each
// beat. A next_frame at any time ends the frame before: bursts that were offered are taken to their end and thrown away,
// then comes the header of the newest frame. A header without a picture does not wait for them.
// cfg_* are sampled with the header. An error of memory ends the words of its frame; read_error tells of it once a frame.
// Latency: 3 cycles from next_frame to arvalid, if nothing is under way. Throughput: a beat a cycle.

`default_nettype none

module frame_reader #(
    parameter PIXELS          = 921600,
    parameter MAX_OUTSTANDING = 4
) (
    input wire clk,
    input wire rst,

    input wire        next_frame,
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

    output wire        word_valid,
    output wire [48:0] word,
    input  wire        word_full,

    output reg read_error
);

  generate
    if (PIXELS < 1 || PIXELS > 268435456) begin : g_pixels
      ERROR_a_picture_must_have_1_to_268435456_pixels error_instance ();
    end
    if (MAX_OUTSTANDING < 1 || MAX_OUTSTANDING > 8) begin : g_max_outstanding
      ERROR_max_outstanding_must_be_1_to_8 error_instance ();
    end
  endgenerate

  // Bursts of 128 bytes, but for the last of a picture, from a base on 4 KiB: none crosses 4 KiB.
  localparam BEATS = (PIXELS + 1) / 2;
  localparam BURSTS = (BEATS + 15) / 16;
  localparam COUNT = $clog2(BURSTS + 1);
  localparam [31:0] ALL = BURSTS;
  localparam [31:0] ONE = 1;
  localparam [31:0] LAST_LEN = BEATS - 1;
  localparam [31:0] LIMIT = MAX_OUTSTANDING;

  wire unused = &{1'b0, cfg_base[11:0], m_axi_rdata[63:56], m_axi_rdata[31:24], m_axi_rresp[0]};

  reg arvalid_reg;
  reg [31:7] address_reg;
  reg [COUNT-1:0] left_reg;  // bursts whose address was not taken
  reg [3:0] outstanding_reg;  // bursts that were offered and did not end
  reg [3:0] number_reg;
  reg pending_reg;  // a header is to be written
  reg drop_reg;  // what comes is thrown away, and nothing more is asked for
  reg error_reg;

  wire quiet = outstanding_reg == 4'd0;
  wire header = pending_reg && !word_full && (quiet || !cfg_enable);
  wire offer = !arvalid_reg && left_reg != {COUNT{1'b0}} && !drop_reg && outstanding_reg != LIMIT[3:0];
  wire take = m_axi_rvalid && m_axi_rready;
  wire ends = take && m_axi_rlast;
  wire bad = take && m_axi_rresp[1];

  assign m_axi_araddr = {address_reg, 7'd0};
  assign m_axi_arlen = {4'd0, left_reg == ONE[COUNT-1:0] ? LAST_LEN[3:0] : 4'd15};
  assign m_axi_arsize = 3'd3;
  assign m_axi_arburst = 2'b01;
  assign m_axi_arcache = 4'b0011;
  assign m_axi_arprot = 3'b000;
  assign m_axi_arvalid = arvalid_reg;
  assign m_axi_rready = drop_reg || !word_full;

  assign word_valid = header || (m_axi_rvalid && !drop_reg && !m_axi_rresp[1]);
  assign word[48] = header;
  assign word[47:24] = m_axi_rdata[55:32];
  assign word[23:5] = m_axi_rdata[23:5];
  assign word[4:0] = header ? {number_reg, cfg_enable} : m_axi_rdata[4:0];

  always @(posedge clk) begin
    if (arvalid_reg && m_axi_arready) begin
      arvalid_reg <= 1'b0;
      address_reg <= address_reg + 25'd1;
      left_reg    <= left_reg - 1'b1;
    end
    if (offer) arvalid_reg <= 1'b1;
    if (offer && !ends) outstanding_reg <= outstanding_reg + 4'd1;
    if (!offer && ends) outstanding_reg <= outstanding_reg - 4'd1;

    read_error <= bad && !error_reg;
    if (bad) begin
      error_reg <= 1'b1;
      drop_reg  <= 1'b1;
    end

    if (header) begin
      pending_reg <= 1'b0;
      if (cfg_enable) begin
        address_reg <= {cfg_base[31:12], 5'd0};
        left_reg    <= ALL[COUNT-1:0];
        drop_reg    <= 1'b0;
        error_reg   <= 1'b0;
      end
    end
    if (next_frame) begin
      number_reg  <= number_reg + 4'd1;
      pending_reg <= 1'b1;
      drop_reg    <= 1'b1;
    end

    if (rst) begin
      arvalid_reg     <= 1'b0;
      outstanding_reg <= 4'd0;
      number_reg      <= 4'd0;
      pending_reg     <= 1'b0;
      drop_reg        <= 1'b1;
      error_reg       <= 1'b0;
      read_error      <= 1'b0;
    end
  end

endmodule

`default_nettype wire
