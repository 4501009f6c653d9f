// SPDX-License-Identifier: Apache-2.0
// Generated from rtl/landing_regs/landing_core.rdl by python -m scripts.regmap. Do not edit.
//
// landing_regs: AXI4-Lite registers of landing_core. docs/registers.md is the reference.
//
// Latency: read data one clock after the address is taken; write response two clocks after the later of address and
// data. Throughput: one read and one write in two clocks, independent of each other.
// AW and W are taken in any order. Ready depends on registers only, never on the valid of its channel.
// The low two address bits are ignored. Unmapped offsets answer SLVERR, read 0 and change nothing; writes to read-only
// fields are ignored with OKAY. Byte strobes are honoured in every field.
// Interrupt: irq = OR of enabled status bits, registered. A set and a clear in one clock leave the status bit set.
// Border, rounding: none, no picture. Overflow: none; counters are those of the cores that own them.
// Limits: AxPROT is ignored.

`default_nettype none

module landing_regs (
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
    output wire ctrl_enable,
    output wire ctrl_dark_is_one,
    output wire ctrl_label_zeros,
    output wire [15:0] frame_size_width,
    output wire [15:0] frame_size_height,
    output wire [8:0] threshold_factor,
    output wire [7:0] threshold_flat_limit,
    output wire [31:0] min_area_pixels,
    output wire [31:0] ring_base_address,
    input wire [7:0] ring_info_buffers,
    input wire [15:0] ring_info_max_objects,
    input wire [7:0] ring_head_index,
    input wire ring_head_valid,
    input wire [31:0] frame_number_number,
    input wire irq_status_frame_done_set,
    input wire irq_status_frame_malformed_set,
    input wire irq_status_frame_overflow_set,
    input wire irq_status_axi_error_set,
    input wire irq_status_lidar_fault_set,
    input wire [31:0] frames_seen_count,
    input wire [31:0] frames_malformed_count,
    input wire [31:0] frames_overflow_count,
    input wire [31:0] frames_unwritten_count,
    input wire [15:0] measured_size_width,
    input wire [15:0] measured_size_height,
    output wire lidar_ctrl_enable,
    input wire [31:0] lidar_distance_mm,
    input wire [31:0] lidar_age_us,
    input wire lidar_status_valid,
    input wire lidar_status_timeout,
    input wire lidar_status_too_long,
    input wire lidar_status_too_short,
    input wire [31:0] time_lo_us,
    input wire [31:0] time_hi_us,
    input wire features_display,
    output wire irq
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
    reg ctrl_enable_reg;
    reg ctrl_dark_is_one_reg;
    reg ctrl_label_zeros_reg;
    reg [15:0] frame_size_width_reg;
    reg [15:0] frame_size_height_reg;
    reg [8:0] threshold_factor_reg;
    reg [7:0] threshold_flat_limit_reg;
    reg [31:0] min_area_pixels_reg;
    reg [31:0] ring_base_address_reg;
    reg irq_status_frame_done_reg;
    reg irq_status_frame_malformed_reg;
    reg irq_status_frame_overflow_reg;
    reg irq_status_axi_error_reg;
    reg irq_status_lidar_fault_reg;
    reg irq_enable_frame_done_reg;
    reg irq_enable_frame_malformed_reg;
    reg irq_enable_frame_overflow_reg;
    reg irq_enable_axi_error_reg;
    reg irq_enable_lidar_fault_reg;
    reg lidar_ctrl_enable_reg;
    reg [31:0] time_hi_us_reg;
    reg [31:0] scratch_value_reg;
    assign ctrl_enable = ctrl_enable_reg;
    assign ctrl_dark_is_one = ctrl_dark_is_one_reg;
    assign ctrl_label_zeros = ctrl_label_zeros_reg;
    assign frame_size_width = frame_size_width_reg;
    assign frame_size_height = frame_size_height_reg;
    assign threshold_factor = threshold_factor_reg;
    assign threshold_flat_limit = threshold_flat_limit_reg;
    assign min_area_pixels = min_area_pixels_reg;
    assign ring_base_address = ring_base_address_reg;
    assign lidar_ctrl_enable = lidar_ctrl_enable_reg;

    wire ctrl_write = write && aw_word_reg == 10'h2;
    wire frame_size_write = write && aw_word_reg == 10'h3;
    wire threshold_write = write && aw_word_reg == 10'h4;
    wire min_area_write = write && aw_word_reg == 10'h5;
    wire ring_base_write = write && aw_word_reg == 10'h6;
    wire irq_status_write = write && aw_word_reg == 10'hA;
    wire irq_enable_write = write && aw_word_reg == 10'hB;
    wire lidar_ctrl_write = write && aw_word_reg == 10'h11;
    wire time_lo_read = read && read_word == 10'h15;
    wire scratch_write = write && aw_word_reg == 10'h17;

    always @(posedge clk) begin
        if (ctrl_write && w_strb_reg[0]) ctrl_enable_reg <= w_data_reg[0];
        if (ctrl_write && w_strb_reg[0]) ctrl_dark_is_one_reg <= w_data_reg[1];
        if (ctrl_write && w_strb_reg[0]) ctrl_label_zeros_reg <= w_data_reg[2];
        if (frame_size_write && w_strb_reg[0]) frame_size_width_reg[7:0] <= w_data_reg[7:0];
        if (frame_size_write && w_strb_reg[1]) frame_size_width_reg[15:8] <= w_data_reg[15:8];
        if (frame_size_write && w_strb_reg[2]) frame_size_height_reg[7:0] <= w_data_reg[23:16];
        if (frame_size_write && w_strb_reg[3]) frame_size_height_reg[15:8] <= w_data_reg[31:24];
        if (threshold_write && w_strb_reg[0]) threshold_factor_reg[7:0] <= w_data_reg[7:0];
        if (threshold_write && w_strb_reg[1]) threshold_factor_reg[8] <= w_data_reg[8];
        if (threshold_write && w_strb_reg[2]) threshold_flat_limit_reg <= w_data_reg[23:16];
        if (min_area_write && w_strb_reg[0]) min_area_pixels_reg[7:0] <= w_data_reg[7:0];
        if (min_area_write && w_strb_reg[1]) min_area_pixels_reg[15:8] <= w_data_reg[15:8];
        if (min_area_write && w_strb_reg[2]) min_area_pixels_reg[23:16] <= w_data_reg[23:16];
        if (min_area_write && w_strb_reg[3]) min_area_pixels_reg[31:24] <= w_data_reg[31:24];
        if (ring_base_write && w_strb_reg[0]) ring_base_address_reg[7:0] <= w_data_reg[7:0];
        if (ring_base_write && w_strb_reg[1]) ring_base_address_reg[15:8] <= w_data_reg[15:8];
        if (ring_base_write && w_strb_reg[2]) ring_base_address_reg[23:16] <= w_data_reg[23:16];
        if (ring_base_write && w_strb_reg[3]) ring_base_address_reg[31:24] <= w_data_reg[31:24];
        if (irq_status_frame_done_set) irq_status_frame_done_reg <= 1'b1;
        else if (irq_status_write && w_strb_reg[0] && w_data_reg[0]) irq_status_frame_done_reg <= 1'b0;
        if (irq_status_frame_malformed_set) irq_status_frame_malformed_reg <= 1'b1;
        else if (irq_status_write && w_strb_reg[0] && w_data_reg[1]) irq_status_frame_malformed_reg <= 1'b0;
        if (irq_status_frame_overflow_set) irq_status_frame_overflow_reg <= 1'b1;
        else if (irq_status_write && w_strb_reg[0] && w_data_reg[2]) irq_status_frame_overflow_reg <= 1'b0;
        if (irq_status_axi_error_set) irq_status_axi_error_reg <= 1'b1;
        else if (irq_status_write && w_strb_reg[0] && w_data_reg[3]) irq_status_axi_error_reg <= 1'b0;
        if (irq_status_lidar_fault_set) irq_status_lidar_fault_reg <= 1'b1;
        else if (irq_status_write && w_strb_reg[0] && w_data_reg[4]) irq_status_lidar_fault_reg <= 1'b0;
        if (irq_enable_write && w_strb_reg[0]) irq_enable_frame_done_reg <= w_data_reg[0];
        if (irq_enable_write && w_strb_reg[0]) irq_enable_frame_malformed_reg <= w_data_reg[1];
        if (irq_enable_write && w_strb_reg[0]) irq_enable_frame_overflow_reg <= w_data_reg[2];
        if (irq_enable_write && w_strb_reg[0]) irq_enable_axi_error_reg <= w_data_reg[3];
        if (irq_enable_write && w_strb_reg[0]) irq_enable_lidar_fault_reg <= w_data_reg[4];
        if (lidar_ctrl_write && w_strb_reg[0]) lidar_ctrl_enable_reg <= w_data_reg[0];
        if (time_lo_read) time_hi_us_reg <= time_hi_us;
        if (scratch_write && w_strb_reg[0]) scratch_value_reg[7:0] <= w_data_reg[7:0];
        if (scratch_write && w_strb_reg[1]) scratch_value_reg[15:8] <= w_data_reg[15:8];
        if (scratch_write && w_strb_reg[2]) scratch_value_reg[23:16] <= w_data_reg[23:16];
        if (scratch_write && w_strb_reg[3]) scratch_value_reg[31:24] <= w_data_reg[31:24];
        if (rst) begin
            ctrl_enable_reg <= 1'h0;
            ctrl_dark_is_one_reg <= 1'h0;
            ctrl_label_zeros_reg <= 1'h1;
            frame_size_width_reg <= 16'h500;
            frame_size_height_reg <= 16'h2D0;
            threshold_factor_reg <= 9'h40;
            threshold_flat_limit_reg <= 8'h0;
            min_area_pixels_reg <= 32'h1E;
            ring_base_address_reg <= 32'h0;
            irq_status_frame_done_reg <= 1'h0;
            irq_status_frame_malformed_reg <= 1'h0;
            irq_status_frame_overflow_reg <= 1'h0;
            irq_status_axi_error_reg <= 1'h0;
            irq_status_lidar_fault_reg <= 1'h0;
            irq_enable_frame_done_reg <= 1'h0;
            irq_enable_frame_malformed_reg <= 1'h0;
            irq_enable_frame_overflow_reg <= 1'h0;
            irq_enable_axi_error_reg <= 1'h0;
            irq_enable_lidar_fault_reg <= 1'h0;
            lidar_ctrl_enable_reg <= 1'h0;
            time_hi_us_reg <= 32'h0;
            scratch_value_reg <= 32'h0;
        end
    end

    always @* begin
        case (aw_word_reg)
            10'h0, 10'h1, 10'h2, 10'h3, 10'h4, 10'h5, 10'h6, 10'h7,
            10'h8, 10'h9, 10'hA, 10'hB, 10'hC, 10'hD, 10'hE, 10'hF,
            10'h10, 10'h11, 10'h12, 10'h13, 10'h14, 10'h15, 10'h16, 10'h17,
            10'h18:
                write_mapped = 1'b1;
            default: write_mapped = 1'b0;
        endcase
    end

    always @* begin
        read_mapped = 1'b1;
        case (read_word)
            10'h0: read_data = 32'h5444574E;  // ID
            10'h1: read_data = {8'h0, 8'h0, 8'h2, 8'h0};  // VERSION
            10'h2: read_data = {29'h0, ctrl_label_zeros_reg, ctrl_dark_is_one_reg, ctrl_enable_reg};  // CTRL
            10'h3: read_data = {frame_size_height_reg, frame_size_width_reg};  // FRAME_SIZE
            10'h4: read_data = {8'h0, threshold_flat_limit_reg, 7'h0, threshold_factor_reg};  // THRESHOLD
            10'h5: read_data = min_area_pixels_reg;  // MIN_AREA
            10'h6: read_data = ring_base_address_reg;  // RING_BASE
            10'h7: read_data = {ring_info_max_objects, 8'h0, ring_info_buffers};  // RING_INFO
            10'h8: read_data = {ring_head_valid, 23'h0, ring_head_index};  // RING_HEAD
            10'h9: read_data = frame_number_number;  // FRAME_NUMBER
            10'hA: read_data = {
                27'h0,
                irq_status_lidar_fault_reg,
                irq_status_axi_error_reg,
                irq_status_frame_overflow_reg,
                irq_status_frame_malformed_reg,
                irq_status_frame_done_reg
            };  // IRQ_STATUS
            10'hB: read_data = {
                27'h0,
                irq_enable_lidar_fault_reg,
                irq_enable_axi_error_reg,
                irq_enable_frame_overflow_reg,
                irq_enable_frame_malformed_reg,
                irq_enable_frame_done_reg
            };  // IRQ_ENABLE
            10'hC: read_data = frames_seen_count;  // FRAMES_SEEN
            10'hD: read_data = frames_malformed_count;  // FRAMES_MALFORMED
            10'hE: read_data = frames_overflow_count;  // FRAMES_OVERFLOW
            10'hF: read_data = frames_unwritten_count;  // FRAMES_UNWRITTEN
            10'h10: read_data = {measured_size_height, measured_size_width};  // MEASURED_SIZE
            10'h11: read_data = {31'h0, lidar_ctrl_enable_reg};  // LIDAR_CTRL
            10'h12: read_data = lidar_distance_mm;  // LIDAR_DISTANCE
            10'h13: read_data = lidar_age_us;  // LIDAR_AGE
            10'h14: read_data = {
                28'h0,
                lidar_status_too_short,
                lidar_status_too_long,
                lidar_status_timeout,
                lidar_status_valid
            };  // LIDAR_STATUS
            10'h15: read_data = time_lo_us;  // TIME_LO
            10'h16: read_data = time_hi_us_reg;  // TIME_HI
            10'h17: read_data = scratch_value_reg;  // SCRATCH
            10'h18: read_data = {31'h0, features_display};  // FEATURES
            default: begin
                read_data = 32'h0;
                read_mapped = 1'b0;
            end
        endcase
    end

    reg irq_reg;
    assign irq = irq_reg;

    always @(posedge clk) begin
        irq_reg <=
            (irq_status_frame_done_reg && irq_enable_frame_done_reg) ||
            (irq_status_frame_malformed_reg && irq_enable_frame_malformed_reg) ||
            (irq_status_frame_overflow_reg && irq_enable_frame_overflow_reg) ||
            (irq_status_axi_error_reg && irq_enable_axi_error_reg) ||
            (irq_status_lidar_fault_reg && irq_enable_lidar_fault_reg);
        if (rst) irq_reg <= 1'b0;
    end

endmodule

`default_nettype wire
