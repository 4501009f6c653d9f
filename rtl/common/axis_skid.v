// SPDX-License-Identifier: Apache-2.0
// Register slice for one AXI4-Stream: both directions registered, full throughput.
//
// Latency     1 cycle.
// Throughput  1 beat a cycle.
// The payload is any set of stream signals side by side. s_ready is a register,
// so no combinational path leads from m_ready to s_ready.

`default_nettype none

module axis_skid #(
    parameter WIDTH = 8
) (
    input  wire             clk,
    input  wire             rst,
    input  wire [WIDTH-1:0] s_payload,
    input  wire             s_valid,
    output wire             s_ready,
    output wire [WIDTH-1:0] m_payload,
    output wire             m_valid,
    input  wire             m_ready
);

  generate
    if (WIDTH < 1) begin : g_width
      ERROR_width_must_be_at_least_1 error_instance ();
    end
  endgenerate

  reg [WIDTH-1:0] out_reg;
  reg [WIDTH-1:0] skid_reg;
  reg             out_valid_reg;
  reg             skid_full_reg;
  reg             ready_reg;

  wire            out_free = m_ready || !out_valid_reg;
  wire            take = s_valid && ready_reg;

  assign s_ready   = ready_reg;
  assign m_payload = out_reg;
  assign m_valid   = out_valid_reg;

  always @(posedge clk) begin
    // The skid register takes the one beat that s_ready let in as the output stalled.
    if (ready_reg) skid_reg <= s_payload;
    if (out_free) begin
      out_reg       <= skid_full_reg ? skid_reg : s_payload;
      out_valid_reg <= skid_full_reg || take;
    end
    skid_full_reg <= !out_free && (skid_full_reg || take);
    ready_reg     <= out_free || !(skid_full_reg || take);

    if (rst) begin
      out_valid_reg <= 1'b0;
      skid_full_reg <= 1'b0;
      ready_reg     <= 1'b0;
    end
  end

endmodule

`default_nettype wire
