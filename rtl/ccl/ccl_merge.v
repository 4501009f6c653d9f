// SPDX-License-Identifier: Apache-2.0
// Union of two component records, or one of them, or the empty one. Combinational.
//
// A record is, from bit 0: ~least x, ~least y, greatest x, then (AREA != 0) area, then (MOMENTS >= 1) sum x, sum y, then
// (MOMENTS >= 2) sum xx, sum yy, sum xy. The least corner is stored inverted, so that every field is a sum or a
// maximum and the record of no pixels is all zeros. The sums cannot overflow: their widths hold a whole white frame.
// The greatest y is not in it: a component is complete in the line after it.

`default_nettype none

module ccl_merge #(
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
    input  wire [RECORD_BITS-1:0] a,
    input  wire                   use_a,
    input  wire [RECORD_BITS-1:0] b,
    input  wire                   use_b,
    output wire [RECORD_BITS-1:0] y
);
    localparam MIN_Y  = X_BITS;
    localparam MAX_X  = MIN_Y + Y_BITS;
    localparam AREA_LSB = MAX_X + X_BITS;
    localparam SUM_X  = AREA_LSB + AREA_BITS;
    localparam SUM_Y  = SUM_X + SUM_X_BITS;
    localparam SUM_XX = SUM_Y + SUM_Y_BITS;
    localparam SUM_YY = SUM_XX + SUM_XX_BITS;
    localparam SUM_XY = SUM_YY + SUM_YY_BITS;

    // Compared first and chosen then: what is masked before comparing takes a LUT a bit more.
    wire a_least_x    = use_a && (!use_b || a[0+:X_BITS] > b[0+:X_BITS]);
    wire a_least_y    = use_a && (!use_b || a[MIN_Y+:Y_BITS] > b[MIN_Y+:Y_BITS]);
    wire a_greatest_x = use_a && (!use_b || a[MAX_X+:X_BITS] > b[MAX_X+:X_BITS]);
    wire [RECORD_BITS-1:0] b_or_empty = b & {RECORD_BITS{use_b}};

    assign y[0+:X_BITS]     = a_least_x ? a[0+:X_BITS] : b_or_empty[0+:X_BITS];
    assign y[MIN_Y+:Y_BITS] = a_least_y ? a[MIN_Y+:Y_BITS] : b_or_empty[MIN_Y+:Y_BITS];
    assign y[MAX_X+:X_BITS] = a_greatest_x ? a[MAX_X+:X_BITS] : b_or_empty[MAX_X+:X_BITS];

    generate
        if (AREA != 0) begin : g_area
            assign y[AREA_LSB+:AREA_BITS] = (use_a ? a[AREA_LSB+:AREA_BITS] : 0) + b_or_empty[AREA_LSB+:AREA_BITS];
        end
        if (MOMENTS >= 1) begin : g_first
            assign y[SUM_X+:SUM_X_BITS] = (use_a ? a[SUM_X+:SUM_X_BITS] : 0) + b_or_empty[SUM_X+:SUM_X_BITS];
            assign y[SUM_Y+:SUM_Y_BITS] = (use_a ? a[SUM_Y+:SUM_Y_BITS] : 0) + b_or_empty[SUM_Y+:SUM_Y_BITS];
        end
        if (MOMENTS >= 2) begin : g_second
            assign y[SUM_XX+:SUM_XX_BITS] = (use_a ? a[SUM_XX+:SUM_XX_BITS] : 0) + b_or_empty[SUM_XX+:SUM_XX_BITS];
            assign y[SUM_YY+:SUM_YY_BITS] = (use_a ? a[SUM_YY+:SUM_YY_BITS] : 0) + b_or_empty[SUM_YY+:SUM_YY_BITS];
            assign y[SUM_XY+:SUM_XY_BITS] = (use_a ? a[SUM_XY+:SUM_XY_BITS] : 0) + b_or_empty[SUM_XY+:SUM_XY_BITS];
        end
    endgenerate
endmodule

`default_nettype wire
