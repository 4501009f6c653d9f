// SPDX-License-Identifier: Apache-2.0
// axis_skid against a queue: the beats that left are those that came, in order, none lost, none twice.
`default_nettype none

module axis_skid_order #(
    parameter WIDTH = 4
) (
    input wire             clk,
    input wire             rst,
    input wire [WIDTH-1:0] s_payload,
    input wire             s_valid,
    input wire             m_ready
);

  wire             s_ready;
  wire [WIDTH-1:0] m_payload;
  wire             m_valid;

  axis_skid #(
      .WIDTH(WIDTH)
  ) dut (.*);

  power_up start (.*);

  axis_rules #(
      .WIDTH(WIDTH)
  ) rules (
      .clk    (clk),
      .rst    (rst),
      .valid  (m_valid),
      .ready  (m_ready),
      .payload(m_payload)
  );

  reg             known = 1'b0;
  reg [      1:0] count;
  reg [WIDTH-1:0] oldest;
  reg [WIDTH-1:0] second;
  wire            come = s_valid && s_ready;
  wire            leave = m_valid && m_ready;

  always @(posedge clk) begin
    known <= 1'b1;
    count <= count + {1'b0, come} - {1'b0, leave};
    if (leave) begin
      oldest <= count == 2'd2 ? second : s_payload;
      second <= s_payload;
    end else if (come) begin
      if (count == 2'd0) oldest <= s_payload;
      else second <= s_payload;
    end
    if (rst) count <= 2'd0;
  end

  // What holds inside, so that induction closes.
  (* hierconn *) wire \dut.skid_full_reg ;
  (* hierconn *) wire [WIDTH-1:0] \dut.skid_reg ;
  reg stalled;
  always @(posedge clk) stalled <= rst;

  always @(posedge clk)
    if (known) begin
      assert (count <= 2'd2);
      assert (m_valid == (count != 2'd0));
      assert (\dut.skid_full_reg == (count == 2'd2));
      assert (!(s_ready && count == 2'd2));
      // It is ready unless it is full, or comes from reset.
      assert (stalled || s_ready || count == 2'd2);
      if (m_valid) assert (m_payload == oldest);
      if (count == 2'd2) assert (\dut.skid_reg == second);
    end

endmodule

`default_nettype wire
