// SPDX-License-Identifier: Apache-2.0
// Border rule of a window along one axis: replaces the taps that lie outside the
// frame. Tap 0 has the least coordinate and is in the least significant bits.
//
// Latency     0 cycles (combinational).
// BORDER      0 replicate        aaa|abcd|ddd
//             1 reflect_101      dcb|abcd|cba   (the frame needs TAPS / 2 + 1 pixels)
//             2 constant VALUE   vvv|abcd|vvv
// low_ok[d-1] is 1 if the tap d below the centre is inside the frame, high_ok the
// same above the centre.

`default_nettype none

module border_mux #(
    parameter                   TAPS       = 5,
    parameter                   DATA_WIDTH = 8,
    parameter                   BORDER     = 0,
    parameter [DATA_WIDTH-1:0] VALUE      = 0
) (
    input  wire [TAPS*DATA_WIDTH-1:0] taps,
    input  wire [         TAPS/2-1:0] low_ok,
    input  wire [         TAPS/2-1:0] high_ok,
    output wire [TAPS*DATA_WIDTH-1:0] resolved
);

  localparam REPLICATE = 0;
  localparam REFLECT_101 = 1;
  localparam CONSTANT = 2;
  localparam CENTRE = TAPS / 2;

  generate
    if (TAPS != 3 && TAPS != 5) begin : g_taps
      ERROR_taps_must_be_3_or_5 error_instance ();
    end
    if (BORDER != REPLICATE && BORDER != REFLECT_101 && BORDER != CONSTANT) begin : g_border
      ERROR_border_must_be_0_or_1_or_2 error_instance ();
    end
  endgenerate

  wire [DATA_WIDTH-1:0] centre = taps[CENTRE*DATA_WIDTH+:DATA_WIDTH];

  assign resolved[CENTRE*DATA_WIDTH+:DATA_WIDTH] = centre;

  genvar d;
  generate
    for (d = 1; d <= CENTRE; d = d + 1) begin : g_distance
      wire [DATA_WIDTH-1:0] low = taps[(CENTRE-d)*DATA_WIDTH+:DATA_WIDTH];
      wire [DATA_WIDTH-1:0] high = taps[(CENTRE+d)*DATA_WIDTH+:DATA_WIDTH];
      wire [DATA_WIDTH-1:0] low_outside;
      wire [DATA_WIDTH-1:0] high_outside;

      if (BORDER == CONSTANT) begin : g_constant
        assign low_outside  = VALUE;
        assign high_outside = VALUE;
      end else if (BORDER == REFLECT_101) begin : g_reflect
        // About the border pixel: the opposite tap if the centre is on the border,
        // the centre itself if it is one pixel inside (possible only for d = 2).
        if (d == 1) begin : g_near
          assign low_outside  = high;
          assign high_outside = low;
        end else begin : g_far
          assign low_outside  = low_ok[0] ? centre : high;
          assign high_outside = high_ok[0] ? centre : low;
        end
      end else begin : g_replicate
        // The border pixel: the centre, or one pixel further out (only for d = 2).
        if (d == 1) begin : g_near
          assign low_outside  = centre;
          assign high_outside = centre;
        end else begin : g_far
          assign low_outside  = low_ok[0] ? taps[(CENTRE-1)*DATA_WIDTH+:DATA_WIDTH] : centre;
          assign high_outside = high_ok[0] ? taps[(CENTRE+1)*DATA_WIDTH+:DATA_WIDTH] : centre;
        end
      end

      assign resolved[(CENTRE-d)*DATA_WIDTH+:DATA_WIDTH] = low_ok[d-1] ? low : low_outside;
      assign resolved[(CENTRE+d)*DATA_WIDTH+:DATA_WIDTH] = high_ok[d-1] ? high : high_outside;
    end
  endgenerate

endmodule

`default_nettype wire
