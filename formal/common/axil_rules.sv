// SPDX-License-Identifier: Apache-2.0
// AXI4-Lite rules of a slave: responses come only to requests, one each; once valid they stay, unchanged, until ready;
// after reset there are none. `writes_open` and so on count what was taken and has not been answered.
`default_nettype none

module axil_rules #(
    parameter GREATEST = 2  // requests that the slave may hold in each direction
) (
    input wire        clk,
    input wire        rst,
    input wire        awvalid,
    input wire        awready,
    input wire        wvalid,
    input wire        wready,
    input wire [ 1:0] bresp,
    input wire        bvalid,
    input wire        bready,
    input wire        arvalid,
    input wire        arready,
    input wire [31:0] rdata,
    input wire [ 1:0] rresp,
    input wire        rvalid,
    input wire        rready,

    output reg [3:0] addresses_open,
    output reg [3:0] data_open,
    output reg [3:0] reads_open
);

  axis_rules #(
      .WIDTH(2)
  ) write_response (
      .clk    (clk),
      .rst    (rst),
      .valid  (bvalid),
      .ready  (bready),
      .payload(bresp)
  );

  axis_rules #(
      .WIDTH(34)
  ) read_response (
      .clk    (clk),
      .rst    (rst),
      .valid  (rvalid),
      .ready  (rready),
      .payload({rresp, rdata})
  );

  reg known = 1'b0;

  always @(posedge clk) begin
    known          <= 1'b1;
    addresses_open <= addresses_open + {3'd0, awvalid && awready} - {3'd0, bvalid && bready};
    data_open      <= data_open + {3'd0, wvalid && wready} - {3'd0, bvalid && bready};
    reads_open     <= reads_open + {3'd0, arvalid && arready} - {3'd0, rvalid && rready};
    if (rst) {addresses_open, data_open, reads_open} <= 12'd0;
  end

  always @(posedge clk)
    if (known) begin
      assert (addresses_open <= GREATEST && data_open <= GREATEST && reads_open <= GREATEST);
      if (bvalid) assert (addresses_open != 4'd0 && data_open != 4'd0);
      if (rvalid) assert (reads_open != 4'd0);
      // OKAY or SLVERR.
      if (bvalid) assert (!bresp[0]);
      if (rvalid) assert (!rresp[0]);
    end

endmodule

`default_nettype wire
