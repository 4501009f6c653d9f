// SPDX-License-Identifier: Apache-2.0
// Queue of found components and its object stream. `almost_full` rises while there is still room for the components that
// the pipeline before it may hold.

`default_nettype none

module ccl_send #(
    parameter AREA        = 1,
    parameter MOMENTS     = 2,
    parameter X_BITS      = 11,
    parameter Y_BITS      = 10,
    parameter AREA_BITS   = 20,
    parameter SUM_X_BITS  = 30,
    parameter SUM_Y_BITS  = 29,
    parameter SUM_XX_BITS = 39,
    parameter SUM_YY_BITS = 38,
    parameter SUM_XY_BITS = 38,
    parameter RECORD_BITS = 226
) (
    input wire clk,
    input wire rst,

    input wire                   found_start,
    input wire                   found,
    input wire                   found_end,
    input wire [RECORD_BITS-1:0] found_record,
    input wire [     Y_BITS-1:0] found_max_y,

    output reg almost_full,

    output wire [511:0] m_axis_tdata,
    output reg          m_axis_tvalid,
    input  wire         m_axis_tready,
    output wire         m_axis_tuser,
    output wire         m_axis_tlast
);
    `include "result_record.vh"

    localparam DEPTH_BITS = 5;
    localparam DEPTH = 1 << DEPTH_BITS;
    // At one component a clock: four in ccl_store, one in ccl_lists, one leaves ccl_scan as almost_full rises.
    localparam RESERVE = 6;

    reg [RECORD_BITS+Y_BITS+1:0] queue[0:DEPTH-1];
    reg [DEPTH_BITS:0] write_reg, read_reg, read_plus_1_reg;
    reg first_reg;
    wire [DEPTH_BITS:0] count = write_reg - read_reg;
    wire push = found || found_end;
    wire pop = m_axis_tvalid && m_axis_tready;
    wire [DEPTH_BITS:0] read_next = pop ? read_plus_1_reg : read_reg;
    wire [RECORD_BITS-1:0] record;
    wire [Y_BITS-1:0] record_max_y;

    assign {m_axis_tuser, m_axis_tlast, record_max_y, record} = queue[read_reg[DEPTH_BITS-1:0]];

    always @(posedge clk) begin
        if (push) queue[write_reg[DEPTH_BITS-1:0]] <= {first_reg, found_end, found_max_y, found_record};
    end

    always @(posedge clk) begin
        if (push) begin
            write_reg <= write_reg + 1'b1;
            first_reg <= found_end;
        end
        read_reg <= read_next;
        if (pop) read_plus_1_reg <= read_plus_1_reg + 1'b1;
        m_axis_tvalid <= pop ? read_plus_1_reg != write_reg : read_reg != write_reg;
        if (found_start) first_reg <= 1'b1;
        almost_full <= count >= DEPTH - RESERVE;
        if (rst) begin
            write_reg       <= 0;
            read_reg        <= 0;
            read_plus_1_reg <= 1;
            m_axis_tvalid   <= 1'b0;
            first_reg       <= 1'b1;
            almost_full     <= 1'b0;
        end
    end

    localparam MIN_Y = X_BITS;
    localparam MAX_X = MIN_Y + Y_BITS;
    localparam AREA_LSB = MAX_X + X_BITS;
    localparam SUM_X = AREA_LSB + AREA_BITS;
    localparam SUM_Y = SUM_X + SUM_X_BITS;
    localparam SUM_XX = SUM_Y + SUM_Y_BITS;
    localparam SUM_YY = SUM_XX + SUM_XX_BITS;
    localparam SUM_XY = SUM_YY + SUM_YY_BITS;

    // The trailer is all zeros.
    wire [X_BITS-1:0] min_x = ~record[0+:X_BITS] & {X_BITS{!m_axis_tlast}};
    wire [Y_BITS-1:0] min_y = ~record[MIN_Y+:Y_BITS] & {Y_BITS{!m_axis_tlast}};

    assign m_axis_tdata[OBJECT_SUM_X_LSB-1:OBJECT_BOX_MIN_X_LSB] = {
        {OBJECT_RESERVED_0_WIDTH{1'b0}},
        {{(OBJECT_BOX_MAX_Y_WIDTH - Y_BITS) {1'b0}}, record_max_y},
        {{(OBJECT_BOX_MAX_X_WIDTH - X_BITS) {1'b0}}, record[MAX_X+:X_BITS]},
        {{(OBJECT_BOX_MIN_Y_WIDTH - Y_BITS) {1'b0}}, min_y},
        {{(OBJECT_BOX_MIN_X_WIDTH - X_BITS) {1'b0}}, min_x}
    };
    generate
        if (AREA != 0) begin : g_area
            assign m_axis_tdata[OBJECT_BOX_MIN_X_LSB-1:0] = {
                {(OBJECT_AREA_WIDTH - AREA_BITS) {1'b0}}, record[AREA_LSB+:AREA_BITS]
            };
        end else begin : g_no_area
            assign m_axis_tdata[OBJECT_BOX_MIN_X_LSB-1:0] = 0;
        end
        if (MOMENTS >= 1) begin : g_first
            assign m_axis_tdata[OBJECT_SUM_XX_LSB-1:OBJECT_SUM_X_LSB] = {
                {{(OBJECT_SUM_Y_WIDTH - SUM_Y_BITS) {1'b0}}, record[SUM_Y+:SUM_Y_BITS]},
                {{(OBJECT_SUM_X_WIDTH - SUM_X_BITS) {1'b0}}, record[SUM_X+:SUM_X_BITS]}
            };
        end else begin : g_no_first
            assign m_axis_tdata[OBJECT_SUM_XX_LSB-1:OBJECT_SUM_X_LSB] = 0;
        end
        if (MOMENTS >= 2) begin : g_second
            assign m_axis_tdata[OBJECT_RESERVED_1_LSB-1:OBJECT_SUM_XX_LSB] = {
                {{(OBJECT_SUM_XY_WIDTH - SUM_XY_BITS) {1'b0}}, record[SUM_XY+:SUM_XY_BITS]},
                {{(OBJECT_SUM_YY_WIDTH - SUM_YY_BITS) {1'b0}}, record[SUM_YY+:SUM_YY_BITS]},
                {{(OBJECT_SUM_XX_WIDTH - SUM_XX_BITS) {1'b0}}, record[SUM_XX+:SUM_XX_BITS]}
            };
        end else begin : g_no_second
            assign m_axis_tdata[OBJECT_RESERVED_1_LSB-1:OBJECT_SUM_XX_LSB] = 0;
        end
    endgenerate
    assign m_axis_tdata[511:OBJECT_RESERVED_1_LSB] = 0;
endmodule

`default_nettype wire
