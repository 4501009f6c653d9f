// SPDX-License-Identifier: Apache-2.0
// result_writer: writes the objects of a frame and their header as one record into a ring of buffers in memory.
//
// Order: {frame number 0} and its response; objects as they come; the header without its last 8 bytes; all responses;
// {frame number} and its response; then ring_head_*, written_frame_number and frame_done. So a buffer whose frame
// number is not 0 is complete. docs/registers.md shows the record.
//
// Latency: object to its address: 1 clock; first object of a frame: 4 clocks and one memory round trip (last beat to
// response). Trailer to frame_done: 12 clocks and two round trips.
// Throughput: one object in 9 clocks, as long as MAX_OUTSTANDING bursts cover the latency of the memory.
// AXI: write channels only, 64 bit, INCR, at most 8 beats, 64-byte aligned objects (no burst crosses 4 KiB), no IDs,
// all strobes set: AXI4, and AXI3 when awlen[7:4] is left open. bready is always 1.
// Sampled with the first beat of a frame: ring_base. Sampled with the trailer: frame_*, threshold_factor, min_area,
// thresholds_*, scan_time_us. Sampled when the header is written: altitude_*, frames_malformed and frames_overflow.
// Beats before a first beat (tuser) are dropped. A first beat before the trailer abandons the frame; its buffer is
// used again. After a write error (SLVERR, DECERR) nothing more of the frame is written; axi_error pulses at its end.
// Overflow: objects beyond MAX_OBJECTS are taken and counted in the header. frames_unwritten wraps.
// Border, rounding: none; values are copied.
// Limits: a reset while a burst is under way breaks the protocol; reset the memory port too (system reset).

`default_nettype none

module result_writer #(
    parameter MAX_OBJECTS = 256,
    parameter MAX_OUTSTANDING = 8
) (
    input  wire         clk,
    input  wire         rst,

    input  wire [31:0]  ring_base,
    input  wire [31:0]  frame_number,
    input  wire [63:0]  frame_start_us,
    input  wire [15:0]  frame_width,
    input  wire [15:0]  frame_height,
    input  wire [8:0]   threshold_factor,
    input  wire [31:0]  min_area,
    input  wire         thresholds_missing,
    input  wire         thresholds_stale,
    input  wire [31:0]  scan_time_us,
    input  wire [31:0]  altitude_mm,
    input  wire [31:0]  altitude_age_us,
    input  wire         altitude_valid,
    input  wire [31:0]  frames_malformed,
    input  wire [31:0]  frames_overflow,

    input  wire [511:0] s_axis_tdata,
    input  wire         s_axis_tvalid,
    output wire         s_axis_tready,
    input  wire         s_axis_tuser,
    input  wire         s_axis_tlast,

    output wire [31:0]  m_axi_awaddr,
    output wire [7:0]   m_axi_awlen,
    output wire [2:0]   m_axi_awsize,
    output wire [1:0]   m_axi_awburst,
    output wire [3:0]   m_axi_awcache,
    output wire [2:0]   m_axi_awprot,
    output wire         m_axi_awvalid,
    input  wire         m_axi_awready,
    output wire [63:0]  m_axi_wdata,
    output wire [7:0]   m_axi_wstrb,
    output wire         m_axi_wlast,
    output wire         m_axi_wvalid,
    input  wire         m_axi_wready,
    input  wire [1:0]   m_axi_bresp,
    input  wire         m_axi_bvalid,
    output wire         m_axi_bready,

    output wire [7:0]   ring_head_index,
    output wire         ring_head_valid,
    output wire [31:0]  written_frame_number,
    output wire [31:0]  frames_unwritten,
    output wire         frame_done,
    output wire         axi_error
);

    `include "result_record.vh"

    generate
        if (MAX_OBJECTS < 1 || MAX_OBJECTS > RECORD_MAX_OBJECTS) begin : g_max_objects
            ERROR_max_objects_must_be_1_to_256 error_instance();
        end
        if (MAX_OUTSTANDING < 1 || MAX_OUTSTANDING > 255) begin : g_max_outstanding
            ERROR_max_outstanding_must_be_1_to_255 error_instance();
        end
    endgenerate

    localparam [2:0] IDLE = 3'd0;        // between frames
    localparam [2:0] DRAIN = 3'd1;       // first beat held; old bursts end, then frame number 0 is written
    localparam [2:0] INVALIDATE = 3'd2;  // its response is awaited
    localparam [2:0] OBJECTS = 3'd3;
    localparam [2:0] HEADER = 3'd4;
    localparam [2:0] SETTLE = 3'd5;      // all responses are awaited, then the frame number is written
    localparam [2:0] PUBLISH = 3'd6;     // its response is awaited

    // The last 8 bytes of the header hold the frame number; they are written apart from the rest.
    localparam [31:0] FRAME_NUMBER_OFFSET = HEADER_BYTES - 8;
    localparam [31:0] OBJECTS_OFFSET = RECORD_OBJECTS_OFFSET;
    localparam [31:0] STRIDE = RING_STRIDE;
    localparam [31:0] LAST_BUFFER = RING_BUFFERS - 1;
    localparam [31:0] HEADER_LEN = HEADER_BYTES / 8 - 2;
    localparam [31:0] OBJECT_LEN = OBJECT_BYTES / 8 - 1;
    localparam [31:0] OBJECT_LIMIT = MAX_OBJECTS;
    localparam [31:0] OUTSTANDING_LIMIT = MAX_OUTSTANDING;

    wire unused = &{1'b0, ring_base[11:0], m_axi_bresp[0]};

    reg [2:0] state_reg;
    reg held_is_trailer_reg;  // what the first beat of the frame was
    reg [8:0] object_count_reg;
    reg [31:0] objects_dropped_reg;
    reg error_reg;

    reg [31:0] base_reg;
    reg [31:0] offset_reg;
    reg [7:0] index_reg;

    reg [31:0] frame_number_reg;
    reg [63:0] frame_start_us_reg;
    reg [15:0] frame_width_reg;
    reg [15:0] frame_height_reg;
    reg [8:0] threshold_factor_reg;
    reg [31:0] min_area_reg;
    reg thresholds_missing_reg;
    reg thresholds_stale_reg;
    reg [31:0] scan_time_us_reg;

    reg [7:0] head_index_reg;
    reg head_valid_reg;
    reg [31:0] head_number_reg;
    reg [31:0] unwritten_reg;
    reg done_reg;
    reg axi_error_reg;

    assign ring_head_index = head_index_reg;
    assign ring_head_valid = head_valid_reg;
    assign written_frame_number = head_number_reg;
    assign frames_unwritten = unwritten_reg;
    assign frame_done = done_reg;
    assign axi_error = axi_error_reg;

    // ---- Burst engine: one burst at a time on AW and W, up to MAX_OUTSTANDING responses awaited.

    reg awvalid_reg;
    reg [31:0] awaddr_reg;
    reg [7:0] awlen_reg;
    reg wvalid_reg;
    reg [7:0] beats_left_reg;
    reg zero_reg;              // the burst writes zeros and leaves data_reg alone
    reg [511:0] data_reg;
    reg [7:0] outstanding_reg;
    // Kept, not compared: what is taken hangs on them.
    reg outstanding_none_reg;
    reg outstanding_most_reg;

    assign m_axi_awaddr = awaddr_reg;
    assign m_axi_awlen = awlen_reg;
    assign m_axi_awsize = 3'd3;
    assign m_axi_awburst = 2'b01;
    assign m_axi_awcache = 4'b0011;
    assign m_axi_awprot = 3'b000;
    assign m_axi_awvalid = awvalid_reg;
    assign m_axi_wdata = zero_reg ? 64'd0 : data_reg[63:0];
    assign m_axi_wstrb = 8'hFF;
    assign m_axi_wlast = beats_left_reg == 8'd0;
    assign m_axi_wvalid = wvalid_reg;
    assign m_axi_bready = 1'b1;

    wire engine_free = !awvalid_reg && !wvalid_reg;
    wire quiet = engine_free && outstanding_none_reg;
    wire room = engine_free && !outstanding_most_reg;
    wire response = m_axi_bvalid;

    assign s_axis_tready = state_reg == IDLE || (state_reg == OBJECTS && room);
    wire take = s_axis_tvalid && s_axis_tready;
    wire take_first = take && s_axis_tuser;
    wire take_next = take && !s_axis_tuser && state_reg == OBJECTS;
    wire take_object = take_next && !s_axis_tlast;
    wire fits = object_count_reg != OBJECT_LIMIT[8:0];

    wire start_invalidate = state_reg == DRAIN && quiet;
    // After an error nothing more of the frame is written: if the frame number could not be set to 0, the buffer still
    // names the frame that it held before.
    wire start_held_object = state_reg == INVALIDATE && quiet && !held_is_trailer_reg && !error_reg;
    wire start_object = start_held_object || (take_object && fits && !error_reg);
    wire start_header = state_reg == HEADER && room && !error_reg;
    wire start_publish = state_reg == SETTLE && quiet && !error_reg;
    wire start = start_invalidate || start_object || start_header || start_publish;

    wire next_is_object = state_reg == INVALIDATE || state_reg == OBJECTS;
    wire next_is_header = state_reg == HEADER;
    wire [31:0] next_offset = next_is_object ? offset_reg : next_is_header ? 32'd0 : FRAME_NUMBER_OFFSET;
    wire [7:0] next_len = next_is_object ? OBJECT_LEN[7:0] : next_is_header ? HEADER_LEN[7:0] : 8'd0;

    reg [511:0] header;
    always @* begin
        header = 512'd0;
        header[HEADER_ID_VERSION_LSB +: HEADER_ID_VERSION_WIDTH] = HEADER_ID_VERSION_VALUE;
        header[HEADER_ID_MAGIC_LSB +: HEADER_ID_MAGIC_WIDTH] = HEADER_ID_MAGIC_VALUE;
        header[HEADER_FLAGS_THRESHOLDS_MISSING_LSB] = thresholds_missing_reg;
        header[HEADER_FLAGS_THRESHOLDS_STALE_LSB] = thresholds_stale_reg;
        header[HEADER_FLAGS_OBJECTS_OVERFLOW_LSB] = objects_dropped_reg != 32'd0;
        header[HEADER_FLAGS_ALTITUDE_VALID_LSB] = altitude_valid;
        header[HEADER_START_TIME_US_LSB +: HEADER_START_TIME_US_WIDTH] = frame_start_us_reg;
        header[HEADER_SCAN_TIME_US_LSB +: HEADER_SCAN_TIME_US_WIDTH] = scan_time_us_reg;
        header[HEADER_ALTITUDE_MM_LSB +: HEADER_ALTITUDE_MM_WIDTH] = altitude_mm;
        header[HEADER_ALTITUDE_AGE_US_LSB +: HEADER_ALTITUDE_AGE_US_WIDTH] = altitude_age_us;
        header[HEADER_OBJECT_COUNT_LSB +: HEADER_OBJECT_COUNT_WIDTH] = {23'd0, object_count_reg};
        header[HEADER_OBJECTS_DROPPED_LSB +: HEADER_OBJECTS_DROPPED_WIDTH] = objects_dropped_reg;
        header[HEADER_FRAME_SIZE_WIDTH_LSB +: HEADER_FRAME_SIZE_WIDTH_WIDTH] = frame_width_reg;
        header[HEADER_FRAME_SIZE_HEIGHT_LSB +: HEADER_FRAME_SIZE_HEIGHT_WIDTH] = frame_height_reg;
        header[HEADER_THRESHOLD_FACTOR_LSB +: HEADER_THRESHOLD_FACTOR_WIDTH] = {23'd0, threshold_factor_reg};
        header[HEADER_MIN_AREA_LSB +: HEADER_MIN_AREA_WIDTH] = min_area_reg;
        header[HEADER_FRAMES_MALFORMED_LSB +: HEADER_FRAMES_MALFORMED_WIDTH] = frames_malformed;
        header[HEADER_FRAMES_OVERFLOW_LSB +: HEADER_FRAMES_OVERFLOW_WIDTH] = frames_overflow;
    end

    always @(posedge clk) begin
        if (awvalid_reg && m_axi_awready) awvalid_reg <= 1'b0;
        if (wvalid_reg && m_axi_wready) begin
            wvalid_reg <= beats_left_reg != 8'd0;
            beats_left_reg <= beats_left_reg - 8'd1;
            if (!zero_reg) data_reg <= {64'd0, data_reg[511:64]};
        end
        if (take) data_reg <= s_axis_tdata;

        if (start) begin
            awvalid_reg <= 1'b1;
            wvalid_reg <= 1'b1;
        end
        // Which burst is next is known before it starts.
        if (engine_free) begin
            zero_reg <= state_reg == DRAIN;
            awaddr_reg <= base_reg + next_offset;
            awlen_reg <= next_len;
            beats_left_reg <= next_len;
        end
        if (start_header) data_reg <= header;
        if (start_publish) data_reg[63:0] <= {frame_number_reg, 32'd0};

        if (start && !response) outstanding_reg <= outstanding_reg + 8'd1;
        if (!start && response) outstanding_reg <= outstanding_reg - 8'd1;
        // No burst starts while the most are open, and none is answered while none is open.
        outstanding_none_reg <= !start && (response ? outstanding_reg == 8'd1 : outstanding_none_reg);
        outstanding_most_reg <= !response
            && (start ? outstanding_reg == OUTSTANDING_LIMIT[7:0] - 8'd1 : outstanding_most_reg);

        if (rst) begin
            awvalid_reg <= 1'b0;
            wvalid_reg <= 1'b0;
            outstanding_reg <= 8'd0;
            outstanding_none_reg <= 1'b1;
            outstanding_most_reg <= 1'b0;
        end
    end

    // ---- Order of a frame.

    wire failed = error_reg || (response && m_axi_bresp[1]);

    always @(posedge clk) begin
        done_reg <= 1'b0;
        axi_error_reg <= 1'b0;
        error_reg <= failed;

        if (start_object) begin
            object_count_reg <= object_count_reg + 9'd1;
            offset_reg <= offset_reg + OBJECT_BYTES;
        end
        if (take_object && !fits) objects_dropped_reg <= objects_dropped_reg + 32'd1;
        if (take && s_axis_tlast) begin
            frame_number_reg <= frame_number;
            frame_start_us_reg <= frame_start_us;
            frame_width_reg <= frame_width;
            frame_height_reg <= frame_height;
            threshold_factor_reg <= threshold_factor;
            min_area_reg <= min_area;
            thresholds_missing_reg <= thresholds_missing;
            thresholds_stale_reg <= thresholds_stale;
            scan_time_us_reg <= scan_time_us;
        end

        case (state_reg)
            DRAIN: if (quiet) begin
                state_reg <= INVALIDATE;
                error_reg <= 1'b0;
                axi_error_reg <= error_reg;
            end
            INVALIDATE: if (quiet) state_reg <= held_is_trailer_reg ? HEADER : OBJECTS;
            OBJECTS: if (take_next && s_axis_tlast) state_reg <= HEADER;
            HEADER: if (start_header || error_reg) state_reg <= SETTLE;
            SETTLE: if (quiet) begin
                if (error_reg) begin
                    state_reg <= IDLE;
                    error_reg <= 1'b0;
                    axi_error_reg <= 1'b1;
                    unwritten_reg <= unwritten_reg + 32'd1;
                end else begin
                    state_reg <= PUBLISH;
                end
            end
            PUBLISH: if (quiet) begin
                state_reg <= IDLE;
                error_reg <= 1'b0;
                if (error_reg) begin
                    axi_error_reg <= 1'b1;
                    unwritten_reg <= unwritten_reg + 32'd1;
                end else begin
                    done_reg <= 1'b1;
                    head_index_reg <= index_reg;
                    head_valid_reg <= 1'b1;
                    head_number_reg <= frame_number_reg;
                    index_reg <= index_reg == LAST_BUFFER[7:0] ? 8'd0 : index_reg + 8'd1;
                end
            end
            default: ;  // IDLE: left below, by the first beat of a frame
        endcase

        if (take_first) begin
            state_reg <= DRAIN;
            held_is_trailer_reg <= s_axis_tlast;
            object_count_reg <= 9'd0;
            objects_dropped_reg <= 32'd0;
            offset_reg <= OBJECTS_OFFSET;
            base_reg <= {ring_base[31:12], 12'd0} + index_reg * STRIDE;
            if (state_reg == OBJECTS) unwritten_reg <= unwritten_reg + 32'd1;
        end

        if (rst) begin
            state_reg <= IDLE;
            error_reg <= 1'b0;
            index_reg <= 8'd0;
            head_index_reg <= 8'd0;
            head_valid_reg <= 1'b0;
            head_number_reg <= 32'd0;
            unwritten_reg <= 32'd0;
            done_reg <= 1'b0;
            axi_error_reg <= 1'b0;
        end
    end

endmodule

`default_nettype wire
