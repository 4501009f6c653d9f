// SPDX-License-Identifier: Apache-2.0
// The linked lists of runs of ccl: decides in one clock what one column event does to the components.
//
// Runs of set pixels are numbered in raster order; the number, modulo the ring size, is the slot of the run. `p` is the
// leftmost run of the line above whose right end the scan has not passed, `c` the next run of the current line to end. A
// component that crosses the scan line is a class: its `pending` runs are the ones from `p` on, its `current` runs those of
// the current line, each a list from left to right linked through `next`. Classes do not cross (they are
// connected sets in a plane), so of two classes that meet at `p` and `c` all lists can be joined by linking one tail to
// one head. What is known of a class - its lists - lives in one place, its home: the slot of its first pending run or,
// when none is pending, of its first current run. The class of the run being scanned, once touched, lives in x_*.
// The class of p, if p is its home, is prefetched into y_*.
//
// One event a clock, no stalls, no search, no label that points to a label. For ccl_store each event says, one cycle later,
// what to do with the record of the class; the record has the same home as the class.

`default_nettype none

module ccl_lists #(
    parameter SLOT_BITS = 10
) (
    input wire clk,
    input wire rst,

    input wire restart,    // forget everything
    input wire end_above,  // the run p ends in this column
    input wire end_here,   // the run c ends in this column
    input wire touch,      // p and c are 8-connected; only with one of the two above

    output wire [SLOT_BITS-1:0] above,  // p
    output wire open_runs,  // p and c differ behind the event of this clock

    // One cycle later: the record of the class that the event is about becomes the accumulator.
    output reg                 load,       // the accumulator does not hold it: take the record stored at `load_slot`
    output reg [SLOT_BITS-1:0] load_slot,
    output reg                 keep,       // what the accumulator holds belongs to it
    output reg                 add_run,    // the run that ended belongs to it
    output reg                 complete,   // it is a whole component
    output reg                 save,       // the accumulator holds another class: store that at `save_slot`
    output reg [SLOT_BITS-1:0] save_slot
);
    localparam INFO_BITS = 3 * SLOT_BITS + 1;
    localparam SLOTS = 1 << SLOT_BITS;

    // Much hangs on p and what follows it: both are kept.
    reg [SLOT_BITS-1:0] p_reg, p_plus_1_reg, c_reg;
    wire [SLOT_BITS-1:0] p_next = end_above ? p_plus_1_reg : p_reg;
    wire [SLOT_BITS-1:0] c_plus_1 = c_reg + 1'b1;

    // Class of the run c, once c has touched a run above; the current list ends with c.
    reg x_active_reg, x_pending_reg;
    reg [SLOT_BITS-1:0] x_head_reg, x_tail_reg, x_first_reg;

    // Class of the run p if p is its home. Without current runs first and last mean nothing.
    reg y_current_reg, y_held_reg;
    reg [SLOT_BITS-1:0] y_tail_reg, y_first_reg, y_last_reg, y_next_reg;

    // Kept, not compared: much hangs on them. They mean nothing unless x has pending runs.
    reg x_head_is_p_reg, x_tail_is_p_reg;
    wire x_is_y = x_active_reg && x_pending_reg && x_head_is_p_reg;
    wire y_more = y_tail_reg != p_reg;

    // ---- Where the class of the event has its home afterwards, and what is known of it there.
    // Planarity: pending runs of y precede those of x, current ones too, and not both kinds of list need a link.

    wire x_has_pending = x_active_reg && x_pending_reg;
    wire leave = end_above && !touch;  // the class of p, without the run c
    // With p consumed.
    wire joined_pending = x_is_y ? !x_tail_is_p_reg : x_has_pending || y_more;
    wire pending_above = touch ? joined_pending : y_more;
    wire stays_pending = end_above ? pending_above : touch || x_has_pending;

    wire first_of_y = touch ? y_current_reg && !x_is_y : end_above;
    wire head_of_x = touch ? x_active_reg && !x_is_y && !y_more : !end_above;
    wire [SLOT_BITS-1:0] first = first_of_y ? y_first_reg : x_active_reg ? x_first_reg : c_reg;
    wire [SLOT_BITS-1:0] last = leave ? y_last_reg : c_reg;
    wire [SLOT_BITS-1:0] pending_tail = x_has_pending && !leave ? x_tail_reg : y_tail_reg;
    wire [SLOT_BITS-1:0] pending_head = head_of_x ? x_head_reg : y_next_reg;
    // Without pending runs the current ones are those that the next line finds.
    wire [SLOT_BITS-1:0] tail = stays_pending ? pending_tail : last;

    wire complete_now = leave && !y_more && !y_current_reg;
    wire settle = end_here || (leave && !complete_now);
    wire [SLOT_BITS-1:0] home = !stays_pending ? first : touch && !end_above ? p_reg : pending_head;
    wire [INFO_BITS-1:0] home_info = {stays_pending && (y_current_reg || !leave), last, first, tail};

    // Two lists become one.
    wire link_enable = touch && !x_is_y && (y_current_reg || x_has_pending);
    wire [SLOT_BITS-1:0] link_from = x_has_pending ? y_tail_reg : y_last_reg;
    wire [SLOT_BITS-1:0] link_to = x_has_pending ? x_head_reg : x_active_reg ? x_first_reg : c_reg;

    // All candidates for a place are compared with p and with p + 1, so that comparing is not behind choosing.
    wire c_is_p = c_reg == p_reg;
    wire c_is_p_plus_1 = c_reg == p_plus_1_reg;
    wire x_head_is_p_plus_1 = x_head_reg == p_plus_1_reg;
    wire x_first_is_p_plus_1 = x_first_reg == p_plus_1_reg;
    wire x_tail_is_p_plus_1 = x_tail_reg == p_plus_1_reg;
    wire y_first_is_p_plus_1 = y_first_reg == p_plus_1_reg;
    wire y_next_is_p_plus_1 = y_next_reg == p_plus_1_reg;
    wire y_tail_is_p_plus_1 = y_tail_reg == p_plus_1_reg;
    // If p ends:
    wire pending_head_is_p_plus_1 = touch && !head_of_x ? y_next_is_p_plus_1 : x_head_is_p_plus_1;
    wire first_is_p_plus_1 = first_of_y ? y_first_is_p_plus_1 : x_active_reg ? x_first_is_p_plus_1 : c_is_p_plus_1;
    wire home_above_is_p_plus_1 =
        !pending_above ? first_is_p_plus_1 : touch ? pending_head_is_p_plus_1 : y_next_is_p_plus_1;
    wire returns_above = settle && home_above_is_p_plus_1;
    // If it does not:
    wire x_first_or_c_is_p = x_active_reg ? x_first_reg == p_reg : c_is_p;
    wire returns_here = end_here && (touch || (x_has_pending ? x_head_is_p_reg : x_first_or_c_is_p));
    // A current run that p touches is not p.
    wire link_from_is_next = !end_above ? x_has_pending && !y_more :
        x_has_pending ? y_tail_is_p_plus_1 : y_last_reg == p_plus_1_reg;

    // Both memories are read at the slot after p_next; a write to the slot that is being read is passed by.
    reg [INFO_BITS-1:0] info[0:SLOTS-1];
    reg [SLOT_BITS-1:0] next[0:SLOTS-1];
    reg [INFO_BITS-1:0] info_read_reg, info_passed_reg;
    reg [SLOT_BITS-1:0] next_read_reg, next_passed_reg;
    reg info_pass_reg, next_pass_reg;
    wire [SLOT_BITS-1:0] prefetch = p_plus_1_reg + {{(SLOT_BITS - 1) {1'b0}}, end_above};

    always @(posedge clk) begin
        info_read_reg   <= info[prefetch];
        info_pass_reg   <= settle && home == prefetch;
        info_passed_reg <= home_info;
        if (settle) info[home] <= home_info;
    end

    always @(posedge clk) begin
        next_read_reg   <= next[prefetch];
        next_pass_reg   <= link_enable && link_from == prefetch;
        next_passed_reg <= link_to;
        if (link_enable) next[link_from] <= link_to;
    end

    wire [INFO_BITS-1:0] info_ahead = info_pass_reg ? info_passed_reg : info_read_reg;
    wire [SLOT_BITS-1:0] next_ahead = next_pass_reg ? next_passed_reg : next_read_reg;

    always @(posedge clk) begin
        if (end_above) {y_current_reg, y_last_reg, y_first_reg, y_tail_reg} <= returns_above ? home_info : info_ahead;
        else if (returns_here) {y_current_reg, y_last_reg, y_first_reg, y_tail_reg} <= home_info;
        if (link_enable && link_from_is_next) y_next_reg <= link_to;
        else if (end_above) y_next_reg <= next_ahead;

        if (end_above) begin
            x_head_is_p_reg <= pending_head_is_p_plus_1;
            x_tail_is_p_reg <= touch && !x_has_pending ? y_tail_is_p_plus_1 : x_tail_is_p_plus_1;
        end
        // If c goes on, p has ended.
        if (touch) begin
            x_pending_reg <= joined_pending;
            x_head_reg    <= pending_head;
            x_tail_reg    <= tail;
            x_first_reg   <= first;
        end
    end

    // Which class the accumulator of ccl_store holds after this event: that of the event, at `home` or active.
    reg held_reg;
    reg [SLOT_BITS-1:0] held_home_reg;
    wire fresh = end_here && !touch && !x_active_reg;
    wire fetch = !x_active_reg && !y_held_reg && (touch || end_above);
    wire event_valid = end_above || end_here;

    always @(posedge clk) begin
        load      <= event_valid && (fetch || (touch && x_active_reg && !x_is_y));
        load_slot <= p_reg;
        keep      <= !(event_valid && (fetch || fresh));
        add_run   <= end_here;
        complete  <= complete_now;
        save      <= event_valid && (fetch || fresh) && held_reg;
        save_slot <= held_home_reg;
        if (event_valid) held_home_reg <= home;
        // The event of the clock of a reset is void, also if the reset is one clock long.
        if (rst) begin
            complete <= 1'b0;
            save     <= 1'b0;
        end
    end

    always @(posedge clk) begin
        p_reg        <= p_next;
        p_plus_1_reg <= prefetch;
        if (end_here) c_reg <= c_plus_1;
        if (event_valid) begin
            x_active_reg <= touch && !end_here;
            held_reg     <= !complete_now;
            y_held_reg   <= end_above ? returns_above : returns_here;
        end
        if (rst || restart) begin
            p_reg        <= 0;
            p_plus_1_reg <= 1;
            c_reg        <= 0;
            x_active_reg <= 1'b0;
            y_held_reg   <= 1'b0;
            held_reg     <= 1'b0;
        end
    end

    assign above = p_reg;
    // Behind a run that ends c is at least p.
    assign open_runs = end_here ? !end_above || !c_is_p : end_above ? !c_is_p_plus_1 : !c_is_p;
endmodule

`default_nettype wire
