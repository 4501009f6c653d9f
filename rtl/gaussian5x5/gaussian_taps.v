// SPDX-License-Identifier: Apache-2.0
// One axis of the Gaussian kernel: t0 + 48 t1 + 158 t2 + 48 t3 + t4, exact, by
// shifts and one addition a stage, for PPC windows side by side. Tags travel beside it.
//
// Latency     4 cycles of advance.
// Throughput  PPC sums a cycle.
// The weights sum to 256, so WIDTH + 8 bits cannot overflow.

`default_nettype none

module gaussian_taps #(
    parameter WIDTH     = 8,
    parameter PPC       = 1,
    parameter TAG_WIDTH = 1
) (
    input  wire                     clk,
    input  wire                     rst,
    input  wire                     advance,
    input  wire [  5*WIDTH*PPC-1:0] taps,
    input  wire [    TAG_WIDTH-1:0] tags,
    input  wire                     valid,
    output wire [(WIDTH+8)*PPC-1:0] sum,
    output wire [    TAG_WIDTH-1:0] sum_tags,
    output wire                     sum_valid
);

  genvar pixel;
  generate
    for (pixel = 0; pixel < PPC; pixel = pixel + 1) begin : g_pixel
      wire [WIDTH-1:0] outer_low = taps[(5*pixel+0)*WIDTH+:WIDTH];
      wire [WIDTH-1:0] inner_low = taps[(5*pixel+1)*WIDTH+:WIDTH];
      wire [WIDTH-1:0] centre = taps[(5*pixel+2)*WIDTH+:WIDTH];
      wire [WIDTH-1:0] inner_high = taps[(5*pixel+3)*WIDTH+:WIDTH];
      wire [WIDTH-1:0] outer_high = taps[(5*pixel+4)*WIDTH+:WIDTH];

      // Numbers in the names are the weights the values already carry.
      reg  [  WIDTH:0] outer_1_reg;
      reg  [  WIDTH:0] outer_2_reg;
      reg  [  WIDTH:0] inner_1_reg;
      reg  [WIDTH+2:0] inner_3_reg;
      reg  [WIDTH-1:0] centre_1_reg;
      reg  [WIDTH+2:0] centre_5_reg;
      reg  [WIDTH+7:0] centre_158_reg;
      reg  [WIDTH+7:0] centre_delayed_reg;
      reg  [WIDTH+7:0] side_reg;
      reg  [WIDTH+7:0] sum_reg;

      assign sum[pixel*(WIDTH+8)+:WIDTH+8] = sum_reg;

      always @(posedge clk) begin
        if (advance) begin
          outer_1_reg        <= {1'b0, outer_low} + {1'b0, outer_high};
          inner_1_reg        <= {1'b0, inner_low} + {1'b0, inner_high};
          centre_1_reg       <= centre;
          centre_5_reg       <= {1'b0, centre, 2'b0} + {3'b0, centre};

          outer_2_reg        <= outer_1_reg;
          inner_3_reg        <= {1'b0, inner_1_reg, 1'b0} + {2'b0, inner_1_reg};
          centre_158_reg     <= {centre_5_reg, 5'b0} - {7'b0, centre_1_reg, 1'b0};

          side_reg           <= {1'b0, inner_3_reg, 4'b0} + {7'b0, outer_2_reg};
          centre_delayed_reg <= centre_158_reg;

          sum_reg            <= side_reg + centre_delayed_reg;
        end
      end
    end
  endgenerate

  reg [4*TAG_WIDTH-1:0] tags_reg;
  reg [            3:0] valid_reg;

  assign sum_tags  = tags_reg[4*TAG_WIDTH-1:3*TAG_WIDTH];
  assign sum_valid = valid_reg[3];

  always @(posedge clk) begin
    if (advance) begin
      tags_reg  <= {tags_reg[3*TAG_WIDTH-1:0], tags};
      valid_reg <= {valid_reg[2:0], valid};
    end

    if (rst) valid_reg <= 4'b0;
  end

endmodule

`default_nettype wire
