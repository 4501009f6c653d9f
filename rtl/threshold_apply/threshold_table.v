// SPDX-License-Identifier: Apache-2.0
// The thresholds of two frames: one set serves the frame that runs while the next one comes in.
//
// start is the handshake of the first pixel of a good frame. At that moment the set that came in serves if it is whole
// and has the window rows and columns of the new frame; otherwise the set that served goes on serving (stale), unless
// there is none or the rows or columns have changed (missing). A set that is not whole by then is dropped, and a beat
// that is handed over in the cycle of start with it.
//
// Latency of reading: address to node_top and node_bottom 2 cycles of advance. node_bottom means nothing where
// read_row is the last row. The memories have one port for writing and one for reading.

`default_nettype none

module threshold_table #(
    parameter MAX_WIDTH   = 1280,
    parameter MAX_HEIGHT  = 720,
    parameter WINDOW_LOG2 = 7
) (
    input wire clk,
    input wire rst,

    input wire        start,
    input wire [15:0] cfg_width,
    input wire [15:0] cfg_height,

    input  wire [15:0] s_stat_axis_tdata,
    input  wire        s_stat_axis_tvalid,
    output wire        s_stat_axis_tready,
    input  wire        s_stat_axis_tuser,
    input  wire        s_stat_axis_tlast,

    output reg        missing,
    output reg        stale,
    output reg [15:0] last_column,
    output reg [15:0] last_row,

    input  wire        advance,
    input  wire [15:0] read_row,
    input  wire [15:0] read_column,
    output wire [15:0] node_top,
    output wire [15:0] node_bottom
);

  localparam COLUMNS = (MAX_WIDTH + (1 << WINDOW_LOG2) - 1) >> WINDOW_LOG2;
  localparam ROWS = (MAX_HEIGHT + (1 << WINDOW_LOG2) - 1) >> WINDOW_LOG2;
  localparam COLUMN_BITS = (COLUMNS > 1) ? $clog2(COLUMNS) : 1;
  // Even and odd rows lie in memories of their own, so that a node and the one below are read at once.
  localparam PAIR_BITS = (ROWS > 2) ? $clog2((ROWS + 1) / 2) : 1;
  localparam ADDRESS_BITS = 1 + PAIR_BITS + COLUMN_BITS;

  reg [15:0] even_rows[0:(1<<ADDRESS_BITS)-1];
  reg [15:0] odd_rows[0:(1<<ADDRESS_BITS)-1];

  reg serving_bank_reg;
  reg serving_valid_reg;
  reg size_known_reg;

  // After start, the last read for the frame before is still to come: it must not find the next set.
  reg reading_reg;

  // The set that comes in.
  reg open_reg;
  reg whole_reg;
  reg [15:0] column_reg;
  reg [15:0] row_reg;
  wire [15:0] column = s_stat_axis_tuser ? 16'd0 : column_reg;
  wire [15:0] row = s_stat_axis_tuser ? 16'd0 : row_reg;
  wire at_last_column = column == last_column;
  wire told = s_stat_axis_tvalid && s_stat_axis_tready && !start;
  wire in_set = told && size_known_reg && (s_stat_axis_tuser || open_reg);
  wire good = in_set && s_stat_axis_tlast == at_last_column;
  wire [ADDRESS_BITS-1:0] write_address = {
    !serving_bank_reg, row[PAIR_BITS:1], column[COLUMN_BITS-1:0]
  };

  // A node goes into memory a cycle later, so that whether its beat counts need not be known sooner.
  reg write_even_reg;
  reg write_odd_reg;
  reg [ADDRESS_BITS-1:0] write_address_reg;
  reg [15:0] write_node_reg;

  wire [15:0] new_last_column = (cfg_width - 16'd1) >> WINDOW_LOG2;
  wire [15:0] new_last_row = (cfg_height - 16'd1) >> WINDOW_LOG2;
  wire same_size = size_known_reg && new_last_column == last_column && new_last_row == last_row;
  wire fresh = same_size && whole_reg;
  wire older = same_size && serving_valid_reg && !whole_reg;

  wire [15:0] row_below = read_row + 16'd1;
  wire unused = &{1'b0, row_below[15:PAIR_BITS+1], row_below[0], read_column[15:COLUMN_BITS]};
  reg [ADDRESS_BITS-1:0] even_address_reg;
  reg [ADDRESS_BITS-1:0] odd_address_reg;
  reg address_odd_reg;
  reg node_odd_reg;
  reg [15:0] even_node_reg;
  reg [15:0] odd_node_reg;

  assign s_stat_axis_tready = !reading_reg;
  assign node_top    = node_odd_reg ? odd_node_reg : even_node_reg;
  assign node_bottom = node_odd_reg ? even_node_reg : odd_node_reg;

  always @(posedge clk) begin
    if (told) begin
      column_reg <= s_stat_axis_tlast ? 16'd0 : column + 16'd1;
      row_reg    <= s_stat_axis_tlast ? row + 16'd1 : row;
    end
    if (in_set) begin
      open_reg  <= good && !(at_last_column && row == last_row);
      whole_reg <= good && at_last_column && row == last_row;
    end
    write_even_reg    <= good && !row[0];
    write_odd_reg     <= good && row[0];
    write_address_reg <= write_address;
    write_node_reg    <= s_stat_axis_tdata;
    if (write_even_reg) even_rows[write_address_reg] <= write_node_reg;
    if (write_odd_reg) odd_rows[write_address_reg] <= write_node_reg;

    if (start) reading_reg <= 1'b1;
    else if (advance) reading_reg <= 1'b0;

    if (start) begin
      if (fresh) serving_bank_reg <= !serving_bank_reg;
      serving_valid_reg <= fresh || older;
      missing           <= !fresh && !older;
      stale             <= older;
      size_known_reg    <= 1'b1;
      last_column       <= new_last_column;
      last_row          <= new_last_row;
      open_reg          <= 1'b0;
      whole_reg         <= 1'b0;
    end

    if (advance) begin
      even_address_reg <= {serving_bank_reg, row_below[PAIR_BITS:1], read_column[COLUMN_BITS-1:0]};
      odd_address_reg  <= {serving_bank_reg, read_row[PAIR_BITS:1], read_column[COLUMN_BITS-1:0]};
      address_odd_reg  <= read_row[0];
      even_node_reg    <= even_rows[even_address_reg];
      odd_node_reg     <= odd_rows[odd_address_reg];
      node_odd_reg     <= address_odd_reg;
    end

    if (rst) begin
      reading_reg       <= 1'b0;
      serving_bank_reg  <= 1'b0;
      serving_valid_reg <= 1'b0;
      size_known_reg    <= 1'b0;
      open_reg          <= 1'b0;
      whole_reg         <= 1'b0;
    end
  end

endmodule

`default_nettype wire
