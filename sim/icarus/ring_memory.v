// SPDX-License-Identifier: Apache-2.0
// Memory of the result ring behind the write channels of landing_core: takes one burst at a time, answers
// RESPONSE_CLOCKS after its last beat. Copies each complete record to records.bin, as sim/cosim/run_log.h describes,
// and writes "record <ns>" to `events`. Stops the run where the master breaks the protocol, leaves the ring, or
// publishes an unknown bit.
`timescale 1ns / 1ps
`default_nettype none

module ring_memory #(
    parameter [31:0] RING_ADDRESS = 32'h1000_0000,
    parameter RESPONSE_CLOCKS = 20
) (
    input  wire        clk,
    input  wire        rst,
    input  wire [31:0] events,
    input  wire [31:0] awaddr,
    input  wire [ 7:0] awlen,
    input  wire [ 2:0] awsize,
    input  wire [ 1:0] awburst,
    input  wire        awvalid,
    output wire        awready,
    input  wire [63:0] wdata,
    input  wire [ 7:0] wstrb,
    input  wire        wlast,
    input  wire        wvalid,
    output wire        wready,
    output wire        bvalid,
    input  wire        bready,
    input  wire        record_done,
    input  wire [ 7:0] ring_head,
    output reg  [31:0] records
);

  `include "result_record.vh"

  localparam WORD_BYTES = 8;
  localparam [31:0] RING_BYTES = RING_BUFFERS * RING_STRIDE;
  localparam RECORD_BYTES = RECORD_OBJECTS_OFFSET + RECORD_MAX_OBJECTS * OBJECT_BYTES;
  localparam [31:0] PAGE_BYTES = 4096;

  reg [63:0] memory[0:RING_BYTES/WORD_BYTES-1];

  reg busy_reg;
  reg [31:0] address_reg;
  reg [8:0] beats_left_reg;
  reg [RESPONSE_CLOCKS-1:0] delay_reg;
  reg [7:0] responses_reg;

  assign awready = !busy_reg;
  assign wready  = busy_reg;
  assign bvalid  = responses_reg != 8'd0;

  wire [31:0] burst_end = awaddr - RING_ADDRESS + (awlen + 32'd1) * WORD_BYTES;
  wire good_address = awaddr >= RING_ADDRESS && burst_end <= RING_BYTES && awaddr % WORD_BYTES == 0;
  wire good_burst = awlen < 8'd16 && awsize == 3'd3 && awburst == 2'b01;
  wire one_page = awaddr % PAGE_BYTES + (awlen + 32'd1) * WORD_BYTES <= PAGE_BYTES;
  wire take_beat = wvalid && wready;

  integer file, lane, place;
  integer bytes_used;
  reg [63:0] word;

  initial file = $fopen("records.bin", "wb");

  task fault;
    begin
      $display("fault: m_axi: the master breaks the protocol or leaves the ring at %0d ns", $time);
      $finish;
    end
  endtask

  // Objects follow the header; the rest of the record is zeros.
  task dump_record;
    input [31:0] start;
    begin
      word = memory[(start+HEADER_OBJECT_COUNT_LSB/8)/WORD_BYTES] >> HEADER_OBJECT_COUNT_LSB % 64;
      bytes_used = RECORD_OBJECTS_OFFSET + word[31:0] * OBJECT_BYTES;
      for (place = 0; place < RECORD_BYTES; place = place + WORD_BYTES) begin
        word = place < bytes_used ? memory[(start+place)/WORD_BYTES] : 64'd0;
        if (^word === 1'bx) begin
          $display("fault: record: unknown bits in %h at byte %0d at %0d ns", word, place, $time);
          $finish;
        end
        for (lane = 0; lane < WORD_BYTES; lane = lane + 1) $fwrite(file, "%c", word[8*lane+:8]);
      end
      $fwrite(events, "record %0d\n", $time);
    end
  endtask

  always @(posedge clk) begin
    if (rst) begin
      busy_reg <= 1'b0;
      delay_reg <= {RESPONSE_CLOCKS{1'b0}};
      responses_reg <= 8'd0;
      records <= 32'd0;
    end else begin
      if (^{awvalid, wvalid, bready, record_done} === 1'bx) fault;
      if (awvalid && awready) begin
        if ((good_address && good_burst && one_page) !== 1'b1) fault;
        busy_reg <= 1'b1;
        address_reg <= awaddr - RING_ADDRESS;
        beats_left_reg <= awlen + 9'd1;
      end
      if (take_beat) begin
        if ((wlast == (beats_left_reg == 9'd1) && ^wstrb !== 1'bx) !== 1'b1) fault;
        for (lane = 0; lane < WORD_BYTES; lane = lane + 1)
          if (wstrb[lane]) memory[address_reg/WORD_BYTES][8*lane+:8] <= wdata[8*lane+:8];
        address_reg <= address_reg + WORD_BYTES;
        beats_left_reg <= beats_left_reg - 9'd1;
        busy_reg <= beats_left_reg != 9'd1;
      end
      delay_reg <= {delay_reg[RESPONSE_CLOCKS-2:0], take_beat && wlast};
      responses_reg <= responses_reg + delay_reg[RESPONSE_CLOCKS-1] - (bvalid && bready);
      if (record_done) begin
        dump_record(ring_head * RING_STRIDE);
        records <= records + 32'd1;
      end
    end
  end

endmodule

`default_nettype wire
