// SPDX-License-Identifier: Apache-2.0
// Generated from rtl/display/display.rdl by python -m scripts.regmap. Do not edit.
//
// display_regs: AXI4-Lite registers of display. Places are pixels from the top left corner of the frame, signed (two's complement) in 14 bits. docs/display_registers.md is the reference.
//
// Latency: read data one clock after the address is taken; write response two clocks after the later of address and
// data. Throughput: one read and one write in two clocks, independent of each other.
// AW and W are taken in any order. Ready depends on registers only, never on the valid of its channel.
// The low two address bits are ignored. Unmapped offsets answer SLVERR, read 0 and change nothing; writes to read-only
// fields are ignored with OKAY. Byte strobes are honoured in every field.
// <register>_<field>_written is 1 in the clock in which a write has arrived in that register.
// Border, rounding: none, no picture. Overflow: none; counters are those of the cores that own them.
// Limits: AxPROT is ignored.

`default_nettype none

module display_regs (
    input wire clk,
    input wire rst,
    input wire [11:0] s_axil_awaddr,
    input wire [2:0] s_axil_awprot,
    input wire s_axil_awvalid,
    output wire s_axil_awready,
    input wire [31:0] s_axil_wdata,
    input wire [3:0] s_axil_wstrb,
    input wire s_axil_wvalid,
    output wire s_axil_wready,
    output wire [1:0] s_axil_bresp,
    output wire s_axil_bvalid,
    input wire s_axil_bready,
    input wire [11:0] s_axil_araddr,
    input wire [2:0] s_axil_arprot,
    input wire s_axil_arvalid,
    output wire s_axil_arready,
    output wire [31:0] s_axil_rdata,
    output wire [1:0] s_axil_rresp,
    output wire s_axil_rvalid,
    input wire s_axil_rready,
    output wire [1:0] ctrl_source,
    output wire [1:0] ctrl_view,
    output wire ctrl_pattern_move,
    output wire ctrl_hold,
    output wire show_text,
    output wire show_text_bank,
    output wire show_pad,
    output wire show_crosshair,
    output wire [3:0] show_boxes,
    output wire [13:0] ring_from_left,
    output wire [13:0] ring_from_top,
    output wire [13:0] ring_to_right,
    output wire [13:0] ring_to_bottom,
    output wire [13:0] square_from_left,
    output wire [13:0] square_from_top,
    output wire [13:0] square_to_right,
    output wire [13:0] square_to_bottom,
    output wire [13:0] rectangle_from_left,
    output wire [13:0] rectangle_from_top,
    output wire [13:0] rectangle_to_right,
    output wire [13:0] rectangle_to_bottom,
    output wire [13:0] small_ring_from_left,
    output wire [13:0] small_ring_from_top,
    output wire [13:0] small_ring_to_right,
    output wire [13:0] small_ring_to_bottom,
    output wire [13:0] centre_x,
    output wire [13:0] centre_y,
    output wire [13:0] tip_x,
    output wire [13:0] tip_y,
    output wire [6:0] text_char,
    output wire text_char_written,
    output wire [5:0] text_column,
    output wire text_line,
    output wire text_bank,
    output wire [3:0] leds_on,
    input wire status_clock_runs,
    input wire status_clock_locked,
    input wire status_monitor,
    input wire [3:0] status_buttons,
    input wire [1:0] status_switches,
    input wire events_clock_lost_set,
    input wire events_frame_blank_set,
    input wire events_stored_underflow_set,
    input wire events_stored_error_set,
    input wire [19:0] pix_clk_khz,
    input wire [31:0] frames_blank_count,
    output wire [31:0] stored_base_address
);

    localparam [1:0] OKAY = 2'b00;
    localparam [1:0] SLVERR = 2'b10;

    wire unused = &{1'b0, s_axil_awprot, s_axil_arprot, s_axil_awaddr[1:0], s_axil_araddr[1:0]};

    // A write waits until address and data are both held and the response register is free.
    reg aw_held_reg;
    reg w_held_reg;
    reg [9:0] aw_word_reg;
    reg [31:0] w_data_reg;
    reg [3:0] w_strb_reg;
    reg bvalid_reg;
    reg [1:0] bresp_reg;

    assign s_axil_awready = !aw_held_reg;
    assign s_axil_wready = !w_held_reg;
    assign s_axil_bvalid = bvalid_reg;
    assign s_axil_bresp = bresp_reg;

    wire write = aw_held_reg && w_held_reg && (!bvalid_reg || s_axil_bready);
    reg write_mapped;

    always @(posedge clk) begin
        if (s_axil_awvalid && s_axil_awready) begin
            aw_held_reg <= 1'b1;
            aw_word_reg <= s_axil_awaddr[11:2];
        end
        if (s_axil_wvalid && s_axil_wready) begin
            w_held_reg <= 1'b1;
            w_data_reg <= s_axil_wdata;
            w_strb_reg <= s_axil_wstrb;
        end
        if (s_axil_bready) bvalid_reg <= 1'b0;
        if (write) begin
            aw_held_reg <= 1'b0;
            w_held_reg <= 1'b0;
            bvalid_reg <= 1'b1;
            bresp_reg <= write_mapped ? OKAY : SLVERR;
        end
        if (rst) begin
            aw_held_reg <= 1'b0;
            w_held_reg <= 1'b0;
            bvalid_reg <= 1'b0;
        end
    end

    reg rvalid_reg;
    reg [1:0] rresp_reg;
    reg [31:0] rdata_reg;
    reg [31:0] read_data;
    reg read_mapped;

    assign s_axil_arready = !rvalid_reg;
    assign s_axil_rvalid = rvalid_reg;
    assign s_axil_rresp = rresp_reg;
    assign s_axil_rdata = rdata_reg;

    wire read = s_axil_arvalid && s_axil_arready;
    wire [9:0] read_word = s_axil_araddr[11:2];

    always @(posedge clk) begin
        if (s_axil_rready) rvalid_reg <= 1'b0;
        if (read) begin
            rvalid_reg <= 1'b1;
            rresp_reg <= read_mapped ? OKAY : SLVERR;
            rdata_reg <= read_data;
        end
        if (rst) rvalid_reg <= 1'b0;
    end

    // Fields.
    reg [1:0] ctrl_source_reg;
    reg [1:0] ctrl_view_reg;
    reg ctrl_pattern_move_reg;
    reg ctrl_hold_reg;
    reg show_text_reg;
    reg show_text_bank_reg;
    reg show_pad_reg;
    reg show_crosshair_reg;
    reg [3:0] show_boxes_reg;
    reg [13:0] ring_from_left_reg;
    reg [13:0] ring_from_top_reg;
    reg [13:0] ring_to_right_reg;
    reg [13:0] ring_to_bottom_reg;
    reg [13:0] square_from_left_reg;
    reg [13:0] square_from_top_reg;
    reg [13:0] square_to_right_reg;
    reg [13:0] square_to_bottom_reg;
    reg [13:0] rectangle_from_left_reg;
    reg [13:0] rectangle_from_top_reg;
    reg [13:0] rectangle_to_right_reg;
    reg [13:0] rectangle_to_bottom_reg;
    reg [13:0] small_ring_from_left_reg;
    reg [13:0] small_ring_from_top_reg;
    reg [13:0] small_ring_to_right_reg;
    reg [13:0] small_ring_to_bottom_reg;
    reg [13:0] centre_x_reg;
    reg [13:0] centre_y_reg;
    reg [13:0] tip_x_reg;
    reg [13:0] tip_y_reg;
    reg [6:0] text_char_reg;
    reg [5:0] text_column_reg;
    reg text_line_reg;
    reg text_bank_reg;
    reg [3:0] leds_on_reg;
    reg events_clock_lost_reg;
    reg events_frame_blank_reg;
    reg events_stored_underflow_reg;
    reg events_stored_error_reg;
    reg [31:0] stored_base_address_reg;
    assign ctrl_source = ctrl_source_reg;
    assign ctrl_view = ctrl_view_reg;
    assign ctrl_pattern_move = ctrl_pattern_move_reg;
    assign ctrl_hold = ctrl_hold_reg;
    assign show_text = show_text_reg;
    assign show_text_bank = show_text_bank_reg;
    assign show_pad = show_pad_reg;
    assign show_crosshair = show_crosshair_reg;
    assign show_boxes = show_boxes_reg;
    assign ring_from_left = ring_from_left_reg;
    assign ring_from_top = ring_from_top_reg;
    assign ring_to_right = ring_to_right_reg;
    assign ring_to_bottom = ring_to_bottom_reg;
    assign square_from_left = square_from_left_reg;
    assign square_from_top = square_from_top_reg;
    assign square_to_right = square_to_right_reg;
    assign square_to_bottom = square_to_bottom_reg;
    assign rectangle_from_left = rectangle_from_left_reg;
    assign rectangle_from_top = rectangle_from_top_reg;
    assign rectangle_to_right = rectangle_to_right_reg;
    assign rectangle_to_bottom = rectangle_to_bottom_reg;
    assign small_ring_from_left = small_ring_from_left_reg;
    assign small_ring_from_top = small_ring_from_top_reg;
    assign small_ring_to_right = small_ring_to_right_reg;
    assign small_ring_to_bottom = small_ring_to_bottom_reg;
    assign centre_x = centre_x_reg;
    assign centre_y = centre_y_reg;
    assign tip_x = tip_x_reg;
    assign tip_y = tip_y_reg;
    assign text_char = text_char_reg;
    assign text_column = text_column_reg;
    assign text_line = text_line_reg;
    assign text_bank = text_bank_reg;
    assign leds_on = leds_on_reg;
    assign stored_base_address = stored_base_address_reg;
    reg text_char_written_reg;
    assign text_char_written = text_char_written_reg;

    wire ctrl_write = write && aw_word_reg == 10'h2;
    wire show_write = write && aw_word_reg == 10'h3;
    wire ring_from_write = write && aw_word_reg == 10'h4;
    wire ring_to_write = write && aw_word_reg == 10'h5;
    wire square_from_write = write && aw_word_reg == 10'h6;
    wire square_to_write = write && aw_word_reg == 10'h7;
    wire rectangle_from_write = write && aw_word_reg == 10'h8;
    wire rectangle_to_write = write && aw_word_reg == 10'h9;
    wire small_ring_from_write = write && aw_word_reg == 10'hA;
    wire small_ring_to_write = write && aw_word_reg == 10'hB;
    wire centre_write = write && aw_word_reg == 10'hC;
    wire tip_write = write && aw_word_reg == 10'hD;
    wire text_write = write && aw_word_reg == 10'hE;
    wire leds_write = write && aw_word_reg == 10'hF;
    wire events_write = write && aw_word_reg == 10'h11;
    wire stored_base_write = write && aw_word_reg == 10'h14;

    always @(posedge clk) begin
        if (ctrl_write && w_strb_reg[0]) ctrl_source_reg <= w_data_reg[1:0];
        if (ctrl_write && w_strb_reg[0]) ctrl_view_reg <= w_data_reg[5:4];
        if (ctrl_write && w_strb_reg[1]) ctrl_pattern_move_reg <= w_data_reg[8];
        if (ctrl_write && w_strb_reg[2]) ctrl_hold_reg <= w_data_reg[16];
        if (show_write && w_strb_reg[0]) show_text_reg <= w_data_reg[0];
        if (show_write && w_strb_reg[0]) show_text_bank_reg <= w_data_reg[1];
        if (show_write && w_strb_reg[0]) show_pad_reg <= w_data_reg[2];
        if (show_write && w_strb_reg[0]) show_crosshair_reg <= w_data_reg[3];
        if (show_write && w_strb_reg[0]) show_boxes_reg <= w_data_reg[7:4];
        if (ring_from_write && w_strb_reg[0]) ring_from_left_reg[7:0] <= w_data_reg[7:0];
        if (ring_from_write && w_strb_reg[1]) ring_from_left_reg[13:8] <= w_data_reg[13:8];
        if (ring_from_write && w_strb_reg[2]) ring_from_top_reg[7:0] <= w_data_reg[23:16];
        if (ring_from_write && w_strb_reg[3]) ring_from_top_reg[13:8] <= w_data_reg[29:24];
        if (ring_to_write && w_strb_reg[0]) ring_to_right_reg[7:0] <= w_data_reg[7:0];
        if (ring_to_write && w_strb_reg[1]) ring_to_right_reg[13:8] <= w_data_reg[13:8];
        if (ring_to_write && w_strb_reg[2]) ring_to_bottom_reg[7:0] <= w_data_reg[23:16];
        if (ring_to_write && w_strb_reg[3]) ring_to_bottom_reg[13:8] <= w_data_reg[29:24];
        if (square_from_write && w_strb_reg[0]) square_from_left_reg[7:0] <= w_data_reg[7:0];
        if (square_from_write && w_strb_reg[1]) square_from_left_reg[13:8] <= w_data_reg[13:8];
        if (square_from_write && w_strb_reg[2]) square_from_top_reg[7:0] <= w_data_reg[23:16];
        if (square_from_write && w_strb_reg[3]) square_from_top_reg[13:8] <= w_data_reg[29:24];
        if (square_to_write && w_strb_reg[0]) square_to_right_reg[7:0] <= w_data_reg[7:0];
        if (square_to_write && w_strb_reg[1]) square_to_right_reg[13:8] <= w_data_reg[13:8];
        if (square_to_write && w_strb_reg[2]) square_to_bottom_reg[7:0] <= w_data_reg[23:16];
        if (square_to_write && w_strb_reg[3]) square_to_bottom_reg[13:8] <= w_data_reg[29:24];
        if (rectangle_from_write && w_strb_reg[0]) rectangle_from_left_reg[7:0] <= w_data_reg[7:0];
        if (rectangle_from_write && w_strb_reg[1]) rectangle_from_left_reg[13:8] <= w_data_reg[13:8];
        if (rectangle_from_write && w_strb_reg[2]) rectangle_from_top_reg[7:0] <= w_data_reg[23:16];
        if (rectangle_from_write && w_strb_reg[3]) rectangle_from_top_reg[13:8] <= w_data_reg[29:24];
        if (rectangle_to_write && w_strb_reg[0]) rectangle_to_right_reg[7:0] <= w_data_reg[7:0];
        if (rectangle_to_write && w_strb_reg[1]) rectangle_to_right_reg[13:8] <= w_data_reg[13:8];
        if (rectangle_to_write && w_strb_reg[2]) rectangle_to_bottom_reg[7:0] <= w_data_reg[23:16];
        if (rectangle_to_write && w_strb_reg[3]) rectangle_to_bottom_reg[13:8] <= w_data_reg[29:24];
        if (small_ring_from_write && w_strb_reg[0]) small_ring_from_left_reg[7:0] <= w_data_reg[7:0];
        if (small_ring_from_write && w_strb_reg[1]) small_ring_from_left_reg[13:8] <= w_data_reg[13:8];
        if (small_ring_from_write && w_strb_reg[2]) small_ring_from_top_reg[7:0] <= w_data_reg[23:16];
        if (small_ring_from_write && w_strb_reg[3]) small_ring_from_top_reg[13:8] <= w_data_reg[29:24];
        if (small_ring_to_write && w_strb_reg[0]) small_ring_to_right_reg[7:0] <= w_data_reg[7:0];
        if (small_ring_to_write && w_strb_reg[1]) small_ring_to_right_reg[13:8] <= w_data_reg[13:8];
        if (small_ring_to_write && w_strb_reg[2]) small_ring_to_bottom_reg[7:0] <= w_data_reg[23:16];
        if (small_ring_to_write && w_strb_reg[3]) small_ring_to_bottom_reg[13:8] <= w_data_reg[29:24];
        if (centre_write && w_strb_reg[0]) centre_x_reg[7:0] <= w_data_reg[7:0];
        if (centre_write && w_strb_reg[1]) centre_x_reg[13:8] <= w_data_reg[13:8];
        if (centre_write && w_strb_reg[2]) centre_y_reg[7:0] <= w_data_reg[23:16];
        if (centre_write && w_strb_reg[3]) centre_y_reg[13:8] <= w_data_reg[29:24];
        if (tip_write && w_strb_reg[0]) tip_x_reg[7:0] <= w_data_reg[7:0];
        if (tip_write && w_strb_reg[1]) tip_x_reg[13:8] <= w_data_reg[13:8];
        if (tip_write && w_strb_reg[2]) tip_y_reg[7:0] <= w_data_reg[23:16];
        if (tip_write && w_strb_reg[3]) tip_y_reg[13:8] <= w_data_reg[29:24];
        if (text_write && w_strb_reg[0]) text_char_reg <= w_data_reg[6:0];
        if (text_write && w_strb_reg[2]) text_column_reg <= w_data_reg[21:16];
        if (text_write && w_strb_reg[2]) text_line_reg <= w_data_reg[22];
        if (text_write && w_strb_reg[2]) text_bank_reg <= w_data_reg[23];
        if (leds_write && w_strb_reg[0]) leds_on_reg <= w_data_reg[3:0];
        if (events_clock_lost_set) events_clock_lost_reg <= 1'b1;
        else if (events_write && w_strb_reg[0] && w_data_reg[0]) events_clock_lost_reg <= 1'b0;
        if (events_frame_blank_set) events_frame_blank_reg <= 1'b1;
        else if (events_write && w_strb_reg[0] && w_data_reg[1]) events_frame_blank_reg <= 1'b0;
        if (events_stored_underflow_set) events_stored_underflow_reg <= 1'b1;
        else if (events_write && w_strb_reg[0] && w_data_reg[2]) events_stored_underflow_reg <= 1'b0;
        if (events_stored_error_set) events_stored_error_reg <= 1'b1;
        else if (events_write && w_strb_reg[0] && w_data_reg[3]) events_stored_error_reg <= 1'b0;
        if (stored_base_write && w_strb_reg[0]) stored_base_address_reg[7:0] <= w_data_reg[7:0];
        if (stored_base_write && w_strb_reg[1]) stored_base_address_reg[15:8] <= w_data_reg[15:8];
        if (stored_base_write && w_strb_reg[2]) stored_base_address_reg[23:16] <= w_data_reg[23:16];
        if (stored_base_write && w_strb_reg[3]) stored_base_address_reg[31:24] <= w_data_reg[31:24];
        text_char_written_reg <= text_write;
        if (rst) begin
            text_char_written_reg <= 1'b0;
            ctrl_source_reg <= 2'h0;
            ctrl_view_reg <= 2'h0;
            ctrl_pattern_move_reg <= 1'h0;
            ctrl_hold_reg <= 1'h0;
            show_text_reg <= 1'h0;
            show_text_bank_reg <= 1'h0;
            show_pad_reg <= 1'h0;
            show_crosshair_reg <= 1'h1;
            show_boxes_reg <= 4'h0;
            ring_from_left_reg <= 14'h0;
            ring_from_top_reg <= 14'h0;
            ring_to_right_reg <= 14'h0;
            ring_to_bottom_reg <= 14'h0;
            square_from_left_reg <= 14'h0;
            square_from_top_reg <= 14'h0;
            square_to_right_reg <= 14'h0;
            square_to_bottom_reg <= 14'h0;
            rectangle_from_left_reg <= 14'h0;
            rectangle_from_top_reg <= 14'h0;
            rectangle_to_right_reg <= 14'h0;
            rectangle_to_bottom_reg <= 14'h0;
            small_ring_from_left_reg <= 14'h0;
            small_ring_from_top_reg <= 14'h0;
            small_ring_to_right_reg <= 14'h0;
            small_ring_to_bottom_reg <= 14'h0;
            centre_x_reg <= 14'h0;
            centre_y_reg <= 14'h0;
            tip_x_reg <= 14'h0;
            tip_y_reg <= 14'h0;
            text_char_reg <= 7'h0;
            text_column_reg <= 6'h0;
            text_line_reg <= 1'h0;
            text_bank_reg <= 1'h0;
            leds_on_reg <= 4'h0;
            events_clock_lost_reg <= 1'h0;
            events_frame_blank_reg <= 1'h0;
            events_stored_underflow_reg <= 1'h0;
            events_stored_error_reg <= 1'h0;
            stored_base_address_reg <= 32'h0;
        end
    end

    always @* begin
        case (aw_word_reg)
            10'h0, 10'h1, 10'h2, 10'h3, 10'h4, 10'h5, 10'h6, 10'h7,
            10'h8, 10'h9, 10'hA, 10'hB, 10'hC, 10'hD, 10'hE, 10'hF,
            10'h10, 10'h11, 10'h12, 10'h13, 10'h14:
                write_mapped = 1'b1;
            default: write_mapped = 1'b0;
        endcase
    end

    always @* begin
        read_mapped = 1'b1;
        case (read_word)
            10'h0: read_data = 32'h54444450;  // ID
            10'h1: read_data = {8'h0, 8'h0, 8'h1, 8'h0};  // VERSION
            10'h2: read_data = {
                15'h0,
                ctrl_hold_reg,
                7'h0,
                ctrl_pattern_move_reg,
                2'h0,
                ctrl_view_reg,
                2'h0,
                ctrl_source_reg
            };  // CTRL
            10'h3: read_data = {
                24'h0,
                show_boxes_reg,
                show_crosshair_reg,
                show_pad_reg,
                show_text_bank_reg,
                show_text_reg
            };  // SHOW
            10'h4: read_data = {2'h0, ring_from_top_reg, 2'h0, ring_from_left_reg};  // RING_FROM
            10'h5: read_data = {2'h0, ring_to_bottom_reg, 2'h0, ring_to_right_reg};  // RING_TO
            10'h6: read_data = {2'h0, square_from_top_reg, 2'h0, square_from_left_reg};  // SQUARE_FROM
            10'h7: read_data = {2'h0, square_to_bottom_reg, 2'h0, square_to_right_reg};  // SQUARE_TO
            10'h8: read_data = {2'h0, rectangle_from_top_reg, 2'h0, rectangle_from_left_reg};  // RECTANGLE_FROM
            10'h9: read_data = {2'h0, rectangle_to_bottom_reg, 2'h0, rectangle_to_right_reg};  // RECTANGLE_TO
            10'hA: read_data = {2'h0, small_ring_from_top_reg, 2'h0, small_ring_from_left_reg};  // SMALL_RING_FROM
            10'hB: read_data = {2'h0, small_ring_to_bottom_reg, 2'h0, small_ring_to_right_reg};  // SMALL_RING_TO
            10'hC: read_data = {2'h0, centre_y_reg, 2'h0, centre_x_reg};  // CENTRE
            10'hD: read_data = {2'h0, tip_y_reg, 2'h0, tip_x_reg};  // TIP
            10'hE: read_data = {8'h0, text_bank_reg, text_line_reg, text_column_reg, 9'h0, text_char_reg};  // TEXT
            10'hF: read_data = {28'h0, leds_on_reg};  // LEDS
            10'h10: read_data = {
                22'h0,
                status_switches,
                status_buttons,
                1'h0,
                status_monitor,
                status_clock_locked,
                status_clock_runs
            };  // STATUS
            10'h11: read_data = {
                28'h0,
                events_stored_error_reg,
                events_stored_underflow_reg,
                events_frame_blank_reg,
                events_clock_lost_reg
            };  // EVENTS
            10'h12: read_data = {12'h0, pix_clk_khz};  // PIX_CLK
            10'h13: read_data = frames_blank_count;  // FRAMES_BLANK
            10'h14: read_data = stored_base_address_reg;  // STORED_BASE
            default: begin
                read_data = 32'h0;
                read_mapped = 1'b0;
            end
        endcase
    end

endmodule

`default_nettype wire
