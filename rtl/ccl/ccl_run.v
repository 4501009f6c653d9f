// SPDX-License-Identifier: Apache-2.0
// Record of the run of set pixels that is being scanned, built up by one addition a pixel, without multipliers:
// x*x, x*y and y*y of the scan position are kept by differences.
//
// `column_in` steps the scan position by one pixel; `restart_in` puts it to the top left pixel. The pixel counts if
// `set_in`, and begins a new run if `begin_in`. Two cycles later `record` (format: ccl_merge) holds the run up to that pixel and
// `line` is the pixel's line; after the last pixel it is the number of lines.

`default_nettype none

module ccl_run #(
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
    input  wire                   clk,
    input  wire                   restart_in,
    input  wire                   column_in,
    input  wire                   last_in,
    input  wire                   set_in,
    input  wire                   begin_in,
    output wire [     Y_BITS-1:0] line,
    output wire [RECORD_BITS-1:0] record
);

    reg restart, column, last_of_line, count, begin_run;
    always @(posedge clk) begin
        restart      <= restart_in;
        column       <= column_in;
        last_of_line <= last_in;
        count        <= column_in && set_in;
        begin_run    <= begin_in;
    end

    wire end_line = column && last_of_line;
    reg [X_BITS-1:0] x_reg, first_x_reg, last_x_reg;
    reg [Y_BITS-1:0] y_reg, line_reg;

    always @(posedge clk) begin
        if (column) x_reg <= x_reg + 1'b1;
        if (end_line) begin
            x_reg <= 0;
            y_reg <= y_reg + 1'b1;
        end
        if (count && begin_run) first_x_reg <= x_reg;
        last_x_reg <= x_reg;
        line_reg   <= y_reg;
        if (restart) begin
            x_reg <= 0;
            y_reg <= 0;
        end
    end

    localparam BOX_END = 2 * X_BITS + Y_BITS;
    localparam AREA_END = BOX_END + AREA_BITS;
    localparam FIRST_END = AREA_END + SUM_X_BITS + SUM_Y_BITS;
    assign line = line_reg;
    assign record[BOX_END-1:0] = {last_x_reg, ~line_reg, ~first_x_reg};

    // Masks: what a single line can add up to; the higher bits of each sum are constant 0.
    generate
        if (AREA != 0) begin : g_area
            localparam [AREA_BITS-1:0] LENGTH_MASK = ~({AREA_BITS{1'b1}} << (X_BITS + 1));
            reg [AREA_BITS-1:0] length_reg;
            always @(posedge clk) begin
                if (count) length_reg <= ((begin_run ? 0 : length_reg) + 1'b1) & LENGTH_MASK;
            end
            assign record[AREA_END-1:BOX_END] = length_reg;
        end
        if (MOMENTS >= 1) begin : g_first
            localparam [SUM_X_BITS-1:0] SUM_X_MASK = ~({SUM_X_BITS{1'b1}} << (2 * X_BITS - 1));
            localparam [SUM_Y_BITS-1:0] SUM_Y_MASK = ~({SUM_Y_BITS{1'b1}} << (X_BITS + Y_BITS));
            wire [SUM_X_BITS-1:0] x = {{(SUM_X_BITS - X_BITS) {1'b0}}, x_reg};
            wire [SUM_Y_BITS-1:0] y = {{(SUM_Y_BITS - Y_BITS) {1'b0}}, y_reg};
            reg [SUM_X_BITS-1:0] sum_x_reg;
            reg [SUM_Y_BITS-1:0] sum_y_reg;

            always @(posedge clk) begin
                if (count) begin
                    sum_x_reg <= ((begin_run ? 0 : sum_x_reg) + x) & SUM_X_MASK;
                    sum_y_reg <= ((begin_run ? 0 : sum_y_reg) + y) & SUM_Y_MASK;
                end
            end
            assign record[FIRST_END-1:AREA_END] = {sum_y_reg, sum_x_reg};
        end
        if (MOMENTS >= 2) begin : g_second
            localparam [SUM_XX_BITS-1:0] SUM_XX_MASK = ~({SUM_XX_BITS{1'b1}} << (3 * X_BITS - 1));
            localparam [SUM_YY_BITS-1:0] SUM_YY_MASK = ~({SUM_YY_BITS{1'b1}} << (X_BITS + 2 * Y_BITS));
            localparam [SUM_XY_BITS-1:0] SUM_XY_MASK = ~({SUM_XY_BITS{1'b1}} << (2 * X_BITS + Y_BITS - 1));
            localparam XX_BITS = 2 * X_BITS;
            localparam YY_BITS = 2 * Y_BITS;
            localparam XY_BITS = X_BITS + Y_BITS;
            reg [XX_BITS-1:0] xx_reg;
            reg [YY_BITS-1:0] yy_reg;
            reg [XY_BITS-1:0] xy_reg;
            wire [SUM_XX_BITS-1:0] xx = {{(SUM_XX_BITS - XX_BITS) {1'b0}}, xx_reg};
            wire [SUM_YY_BITS-1:0] yy = {{(SUM_YY_BITS - YY_BITS) {1'b0}}, yy_reg};
            wire [SUM_XY_BITS-1:0] xy = {{(SUM_XY_BITS - XY_BITS) {1'b0}}, xy_reg};
            reg [SUM_XX_BITS-1:0] sum_xx_reg;
            reg [SUM_YY_BITS-1:0] sum_yy_reg;
            reg [SUM_XY_BITS-1:0] sum_xy_reg;

            always @(posedge clk) begin
                if (column) begin
                    // (x + 1)^2 = x^2 + 2 x + 1, (x + 1) y = x y + y
                    xx_reg <= xx_reg + {{(X_BITS - 1) {1'b0}}, x_reg, 1'b1};
                    xy_reg <= xy_reg + {{X_BITS{1'b0}}, y_reg};
                end
                if (end_line) begin
                    xx_reg <= 0;
                    xy_reg <= 0;
                    yy_reg <= yy_reg + {{(Y_BITS - 1) {1'b0}}, y_reg, 1'b1};
                end
                if (count) begin
                    sum_xx_reg <= ((begin_run ? 0 : sum_xx_reg) + xx) & SUM_XX_MASK;
                    sum_yy_reg <= ((begin_run ? 0 : sum_yy_reg) + yy) & SUM_YY_MASK;
                    sum_xy_reg <= ((begin_run ? 0 : sum_xy_reg) + xy) & SUM_XY_MASK;
                end
                if (restart) begin
                    xx_reg <= 0;
                    yy_reg <= 0;
                    xy_reg <= 0;
                end
            end
            assign record[RECORD_BITS-1:FIRST_END] = {sum_xy_reg, sum_yy_reg, sum_xx_reg};
        end
    endgenerate
endmodule

`default_nettype wire
