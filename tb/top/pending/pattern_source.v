// SPDX-License-Identifier: Apache-2.0
// Ports only, for tests of the board while rtl/ has no such core, or one without all of them.

`default_nettype none (* blackbox *)
module pattern_source (
    input wire pix_clk,
    input wire pix_rst,
    input wire move,
    output wire [23:0] out_data,
    output wire out_de,
    output wire out_hsync,
    output wire out_vsync
);

endmodule

`default_nettype wire
