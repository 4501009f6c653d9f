// SPDX-License-Identifier: Apache-2.0
// ccl_send, the output of ccl: stream rules, and the queue never overflows as long as not more than five components come
// after almost_full is seen, which is what the pipeline in front of it may hold.
`default_nettype none

module ccl_send_queue (
    input wire         clk,
    input wire         rst,
    input wire         found_start,
    input wire         found,
    input wire         found_end,
    input wire [225:0] found_record,
    input wire   [9:0] found_max_y,
    input wire         m_axis_tready
);

  localparam DEPTH = 6'd32;
  localparam LATE = 3'd5;

  wire almost_full, m_axis_tvalid, m_axis_tuser, m_axis_tlast;
  wire [511:0] m_axis_tdata;

  ccl_send dut (.*);

  power_up start (.*);

  axis_rules #(
      .WIDTH(514)
  ) rules (
      .clk    (clk),
      .rst    (rst),
      .valid  (m_axis_tvalid),
      .ready  (m_axis_tready),
      .payload({m_axis_tuser, m_axis_tlast, m_axis_tdata})
  );

  reg known = 1'b0;
  reg [2:0] late;  // that came since almost_full rose
  reg [5:0] waiting;
  reg [5:0] visible;  // of these, those that did not come in the clock before
  wire push = found || found_end;

  always @(posedge clk) begin
    known   <= 1'b1;
    late    <= almost_full ? late + {2'd0, push} : 3'd0;
    waiting <= waiting + {5'd0, push} - {5'd0, m_axis_tvalid && m_axis_tready};
    visible <= waiting - {5'd0, m_axis_tvalid && m_axis_tready};
    if (rst) waiting <= 6'd0;
    if (rst) visible <= 6'd0;
    if (rst) late <= 3'd0;
  end

  always @* if (almost_full && late == LATE) assume (!push);

  (* hierconn *) wire [5:0] \dut.count ;
  (* hierconn *) wire [5:0] \dut.read_reg ;
  (* hierconn *) wire [5:0] \dut.read_plus_1_reg ;

  always @(posedge clk)
    if (known) begin
      assert (waiting <= DEPTH);
      assert (m_axis_tvalid == (visible != 6'd0));
      // For induction.
      assert (\dut.count == waiting);
      assert (\dut.read_plus_1_reg == \dut.read_reg + 6'd1);
      assert (late <= LATE);
      assert (visible <= waiting && waiting <= visible + 6'd1);
      assert (waiting <= 6'd26 || almost_full);
      assert (waiting <= 6'd27 + {3'd0, late});
    end

endmodule

`default_nettype wire
