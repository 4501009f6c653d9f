// SPDX-License-Identifier: Apache-2.0
// Passes a stream through and, on demand, breaks the protocol in one way, to show
// that the protocol checker of the testbenches sees it.

`default_nettype none

module faulty_stream (
    input  wire       clk,
    input  wire       rst,
    input  wire [2:0] fault,
    input  wire [7:0] s_axis_tdata,
    input  wire       s_axis_tvalid,
    output wire       s_axis_tready,
    input  wire       s_axis_tuser,
    input  wire       s_axis_tlast,
    output wire [7:0] m_axis_tdata,
    output wire       m_axis_tvalid,
    input  wire       m_axis_tready,
    output wire       m_axis_tuser,
    output wire       m_axis_tlast
);

  localparam [2:0] DROP_VALID = 3'd1;
  localparam [2:0] CHANGE_DATA = 3'd2;
  localparam [2:0] CHANGE_LAST = 3'd3;
  localparam [2:0] UNDEFINED_DATA = 3'd4;
  localparam [2:0] UNDEFINED_VALID = 3'd5;
  localparam [2:0] UNDEFINED_READY = 3'd6;

  reg       stalled_reg;
  reg [4:0] count_reg;
  wire      late = &count_reg[4:3];

  assign s_axis_tready = (fault == UNDEFINED_READY && late) ? 1'bx : m_axis_tready;
  assign m_axis_tvalid = (fault == UNDEFINED_VALID && late) ? 1'bx :
      s_axis_tvalid && !(fault == DROP_VALID && stalled_reg);
  assign m_axis_tdata = (fault == UNDEFINED_DATA && late) ? 8'hxx :
      s_axis_tdata ^ {7'b0, fault == CHANGE_DATA && stalled_reg};
  assign m_axis_tuser = s_axis_tuser;
  assign m_axis_tlast = s_axis_tlast ^ (fault == CHANGE_LAST && stalled_reg);

  always @(posedge clk) begin
    stalled_reg <= m_axis_tvalid === 1'b1 && !m_axis_tready;
    count_reg   <= late ? count_reg : count_reg + 5'd1;

    if (rst) begin
      stalled_reg <= 1'b0;
      count_reg   <= 5'd0;
    end
  end

endmodule

`default_nettype wire
