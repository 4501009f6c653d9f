// SPDX-License-Identifier: Apache-2.0
// Writes every beat of one stream to <NAME>.bin, as sim/verilated/stage_taps.h describes: the payload, least byte
// first, then one byte {tlast, tuser}. Stops the run at the first handshake signal that is unknown after reset, at the
// first beat with an unknown bit, and where a beat changes or vanishes before it was taken.
`timescale 1ns / 1ps
`default_nettype none

module stage_tap #(
    parameter NAME = "stage",
    parameter BYTES = 1
) (
    input wire               clk,
    input wire               rst,
    input wire [8*BYTES-1:0] tdata,
    input wire               tvalid,
    input wire               tready,
    input wire               tuser,
    input wire               tlast
);

  integer file;
  integer place;
  reg offered = 1'b0;  // and not taken in the cycle before
  reg [8*BYTES+1:0] offer;

  initial begin
    file = $fopen({NAME, ".bin"}, "wb");
    if (file == 0) begin
      $display("fault: cannot write %s.bin", NAME);
      $finish;
    end
  end

  always @(posedge clk) begin
    offered <= !rst && tvalid && !tready;
    offer   <= {tdata, tuser, tlast};
    if (!rst) begin
      if (^{tvalid, tready} === 1'bx) begin
        $display("fault: stage %s: tvalid %b, tready %b at %0d ns", NAME, tvalid, tready, $time);
        $finish;
      end else if (offered && (!tvalid || {tdata, tuser, tlast} !== offer)) begin
        $display("fault: stage %s: a beat changed while stalled, to tvalid %b tdata %h tuser %b tlast %b at %0d ns", NAME,
                 tvalid, tdata, tuser, tlast, $time);
        $finish;
      end else if (tvalid && tready) begin
        if (^{tdata, tuser, tlast} === 1'bx) begin
          $display("fault: stage %s: unknown bits in a beat, tdata %h tuser %b tlast %b at %0d ns", NAME, tdata, tuser,
                   tlast, $time);
          $finish;
        end
        for (place = 0; place < BYTES; place = place + 1) $fwrite(file, "%c", tdata[8*place+:8]);
        $fwrite(file, "%c", {6'd0, tlast, tuser});
      end
    end
  end

endmodule

`default_nettype wire
