// SPDX-License-Identifier: Apache-2.0
// Clocks a verilated ccl: sends frames, receives objects, compares with flood fill, checks protocol, stalls and latency.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "Vccl.h"
#include "flood.h"
#include "patterns.h"
#include "verilated.h"

// REPORT_CLOCKS, REPORT_AT_EDGE_CLOCKS, LAST_LINE_CLOCKS, NEXT_CLOCKS: what docs/cores/ccl.md promises when neither side
// waits, given by the build (tb/ccl/tb_ccl.py).

constexpr uint64_t LONGEST_WAIT = 100000;  // clocks, for a pixel to be taken or a trailer to come

struct Frame {
    Image image;
    uint64_t min_area = 0;
    bool zeros = false;
    size_t sent_pixels = 0;  // fewer than the image has: the next frame cuts it off
    std::string name;

    bool complete() const { return sent_pixels == image.pixels.size(); }
};

class Bench {
public:
    unsigned idle_percent = 0;
    unsigned stall_percent = 0;
    uint64_t seed;
    uint64_t frames_checked = 0, objects_checked = 0, clocks = 0, greatest_close = 0;

    explicit Bench(uint64_t seed_) : seed(seed_), rng(seed_) {
        dut.rst = 1;
        dut.s_axis_tvalid = 0;
        dut.m_axis_tready = 0;
        for (int i = 0; i < 4; i++) edge();
        dut.rst = 0;
        edge();
    }

    Rng &random() { return rng; }

    void send(Frame frame) {
        const size_t total = frame.image.pixels.size();
        const int width = frame.image.width;
        Image labelled = frame.image;
        if (frame.zeros)
            for (auto &pixel : labelled.pixels) pixel ^= 1;
        expected.push_back({frame, flood(labelled, frame.min_area), std::vector<uint64_t>(), Image(), false});
        if (!frame.complete()) keep_what_is_due(expected.back());
        if (free_running()) expected.back().accepted.resize(total);
        const size_t me = first_expected + expected.size() - 1;
        for (size_t i = 0; i < frame.sent_pixels; i++) {
            while (percent(idle_percent)) {
                dut.s_axis_tvalid = 0;
                dut.s_axis_tdata = rng() & 1;
                dut.s_axis_tuser = rng() & 1;
                dut.s_axis_tlast = rng() & 1;
                cycle();
            }
            dut.s_axis_tvalid = 1;
            dut.s_axis_tdata = frame.image.pixels[i];
            dut.s_axis_tuser = i == 0;
            dut.s_axis_tlast = (i + 1) % width == 0;
            if (i == 0) {
                dut.cfg_width = width;
                dut.cfg_height = frame.image.height;
                dut.cfg_min_area = static_cast<uint32_t>(frame.min_area);
                dut.cfg_label_zeros = frame.zeros;
            }
            uint64_t waited = 0;
            while (!cycle())
                if (++waited > LONGEST_WAIT) fail("pixel %zu was not taken", i);
            if (waited > 0 && free_running() && i != 0) fail("the input stalled for %llu clocks at pixel %zu", waited, i);
            if (free_running() && i == 0 && after_complete) {
                greatest_close = std::max(greatest_close, waited);
                if (waited + 1 != last_line_runs + NEXT_CLOCKS)
                    fail("the input stalled for %llu clocks after a last line of %llu runs", waited, last_line_runs);
            }
            if (free_running()) expected[me - first_expected].accepted[i] = clocks - 1;
        }
        dut.s_axis_tvalid = 0;
        after_complete = frame.complete();
        last_line_runs = runs_of_last_line(labelled, width);
        if (after_complete && free_running()) expected[me - first_expected].labelled = labelled;
    }

    // Clocks on until everything that was sent has been answered.
    void drain() {
        dut.s_axis_tvalid = 0;
        uint64_t left = LONGEST_WAIT;
        while (!expected.empty() && expected.back().frame.complete()) {
            cycle();
            if (left-- == 0) fail("no trailer came");
        }
        for (int i = 0; i < 50; i++) cycle();
    }

private:
    struct Expected {
        Frame frame;
        std::vector<Object> objects;
        std::vector<uint64_t> accepted;  // clock at which each pixel was taken, in runs without stalls
        Image labelled;
        bool last_may_fail;  // of a frame that is cut off
    };

    struct Received {
        Object object;
        uint64_t clock;
    };

    Vccl dut;
    Rng rng;
    std::deque<Expected> expected;
    size_t first_expected = 0;
    std::vector<Received> group;  // of the frame being received
    bool in_frame = false;
    uint64_t last_line_runs = 0;
    bool after_complete = false;
    uint64_t blocked = 0;
    bool held = false;
    uint32_t held_beat[17] = {};

    bool free_running() const { return idle_percent == 0 && stall_percent == 0; }
    bool percent(unsigned p) { return p != 0 && rng() % 100 < p; }

    void edge() {
        dut.clk = 0;
        dut.eval();
        dut.clk = 1;
        dut.eval();
        clocks++;
    }

    // One clock; returns whether the source's beat was taken.
    bool cycle() {
        // Now and then long enough to fill the queue.
        if (stall_percent != 0 && blocked == 0 && rng() % 500 == 0) blocked = rng() % 200;
        blocked -= blocked != 0;
        dut.m_axis_tready = blocked == 0 && !percent(stall_percent);
        dut.clk = 0;
        dut.eval();
        const bool taken = dut.s_axis_tvalid && dut.s_axis_tready;
        if (held && (!dut.m_axis_tvalid || !same_beat())) fail("the payload changed while it was stalled");
        held = dut.m_axis_tvalid && !dut.m_axis_tready;
        for (int i = 0; i < 16; i++) held_beat[i] = dut.m_axis_tdata[i];
        held_beat[16] = dut.m_axis_tuser * 2 + dut.m_axis_tlast;
        if (dut.m_axis_tvalid && dut.m_axis_tready) receive();
        dut.clk = 1;
        dut.eval();
        clocks++;
        return taken;
    }

    bool same_beat() {
        for (int i = 0; i < 16; i++)
            if (held_beat[i] != dut.m_axis_tdata[i]) return false;
        return held_beat[16] == static_cast<uint32_t>(dut.m_axis_tuser * 2 + dut.m_axis_tlast);
    }

    uint64_t pair(int word) { return dut.m_axis_tdata[word] | static_cast<uint64_t>(dut.m_axis_tdata[word + 1]) << 32; }

    // Index of the pixel that tells that an object has ended; its line may be the one below the frame.
    static size_t tells(const Object &object, size_t width) {
        return object.last + width + ((object.last + 1) % width != 0);
    }

    // Of a frame that is cut off come the objects that its pixels show to be whole, and no others. One at the end of a line
    // is a clock late, so the next frame, if it comes at once, may forget it.
    static void keep_what_is_due(Expected &now) {
        const size_t width = now.frame.image.width, sent = now.frame.sent_pixels;
        auto is_open = [width, sent](const Object &object) { return tells(object, width) >= sent; };
        now.objects.erase(std::remove_if(now.objects.begin(), now.objects.end(), is_open), now.objects.end());
        if (now.objects.empty()) return;
        const Object &newest = now.objects.back();
        now.last_may_fail = (newest.last + 1) % width == 0 && tells(newest, width) + 1 == sent;
    }

    void pop_expected() {
        expected.pop_front();
        first_expected++;
    }

    void receive() {
        if (dut.m_axis_tuser) {
            if (in_frame) match_cut_frame();
            group.clear();
            in_frame = true;
        } else if (!in_frame) {
            fail("a beat without a start of frame");
        }
        if (!dut.m_axis_tlast) {
            group.push_back({received(), clocks});
            return;
        }
        for (int i = 0; i < 16; i++)
            if (dut.m_axis_tdata[i] != 0) fail("the trailer is not zero");
        in_frame = false;
        while (front_is_cut() && due() == 0) pop_expected();
        if (expected.empty()) fail("a trailer of no frame came");
        if (front_is_cut()) fail("%zu objects of a frame that was cut off did not come", due());
        const Expected &now = expected.front();
        compare();
        if (!now.accepted.empty())
            for (size_t i = 0; i < group.size(); i++) check_report(now, now.objects[i], group[i].clock);
        frames_checked++;
        objects_checked += group.size();
        pop_expected();
    }

    size_t due() const { return expected.front().objects.size() - expected.front().last_may_fail; }

    bool front_is_cut() const { return !expected.empty() && !expected.front().frame.complete(); }

    // The group has no trailer, so it must be what came of the next frame that was cut off, but for those that left nothing.
    void match_cut_frame() {
        while (front_is_cut() && due() == 0 && !front_fits()) pop_expected();
        if (!front_is_cut()) fail("%zu objects came without a trailer", group.size());
        compare();
        pop_expected();
    }

    bool front_fits() const {
        const std::vector<Object> &objects = expected.front().objects;
        return objects.size() == 1 && group.size() == 1 && group[0].object == objects[0];
    }

    void compare() {
        const std::vector<Object> &objects = expected.front().objects;
        for (size_t i = 0; i < std::min(group.size(), objects.size()); i++)
            if (!(group[i].object == objects[i])) {
                print("expected", objects[i]);
                print("got", group[i].object);
                fail("object %zu of %zu is wrong", i, objects.size());
            }
        if (group.size() < due() || group.size() > objects.size()) fail("%zu objects of %zu came", group.size(), objects.size());
    }

    // How many runs of ones end left of column `until` in the last line.
    static uint64_t runs_of_last_line(const Image &image, int until) {
        uint64_t runs = 0;
        const int y = image.height - 1;
        for (int x = 0; x < until; x++) runs += image.at(x, y) && (x + 1 == image.width || !image.at(x + 1, y));
        return runs;
    }

    void check_report(const Expected &now, const Object &object, uint64_t clock) {
        const uint64_t width = now.frame.image.width, x = object.last % width;
        uint64_t wanted;
        if (object.last + width >= now.accepted.size())
            wanted = now.accepted.back() + LAST_LINE_CLOCKS + runs_of_last_line(now.labelled, static_cast<int>(x));
        else
            wanted = now.accepted[tells(object, width)] + (x + 1 == width ? REPORT_AT_EDGE_CLOCKS : REPORT_CLOCKS);
        if (clock != wanted) fail("an object came in clock %llu, due %llu", clock, wanted);
    }

    Object received() {
        Object object;
        object.area = dut.m_axis_tdata[0];
        object.min_x = dut.m_axis_tdata[1] & 0xFFFF;
        object.min_y = dut.m_axis_tdata[1] >> 16;
        object.max_x = dut.m_axis_tdata[2] & 0xFFFF;
        object.max_y = dut.m_axis_tdata[2] >> 16;
        object.sum_x = pair(4);
        object.sum_y = pair(6);
        object.sum_xx = pair(8);
        object.sum_yy = pair(10);
        object.sum_xy = pair(12);
        if (dut.m_axis_tdata[3] || pair(14)) fail("a reserved word is not 0");
        return object;
    }

    static void print(const char *what, const Object &o) {
        std::fprintf(stderr, "%s: area %llu box %llu,%llu-%llu,%llu sums x %llu y %llu xx %llu yy %llu xy %llu\n", what,
                     (unsigned long long)o.area, (unsigned long long)o.min_x, (unsigned long long)o.min_y,
                     (unsigned long long)o.max_x, (unsigned long long)o.max_y, (unsigned long long)o.sum_x,
                     (unsigned long long)o.sum_y, (unsigned long long)o.sum_xx, (unsigned long long)o.sum_yy,
                     (unsigned long long)o.sum_xy);
    }

    [[noreturn]] void fail(const char *format, ...) {
        va_list arguments;
        va_start(arguments, format);
        std::fprintf(stderr, "FAIL: ");
        std::vfprintf(stderr, format, arguments);
        va_end(arguments);
        if (!expected.empty()) {
            const Frame &frame = expected.front().frame;
            std::fprintf(stderr, "; frame '%s' %dx%d, idle %u %%, stall %u %%, seed %llu\n", frame.name.c_str(), frame.image.width,
                         frame.image.height, idle_percent, stall_percent, (unsigned long long)seed);
            if (frame.image.width <= 64 && frame.image.height <= 64)
                for (int y = 0; y < frame.image.height; y++) {
                    for (int x = 0; x < frame.image.width; x++) std::fputc(frame.image.at(x, y) ? '#' : '.', stderr);
                    std::fputc('\n', stderr);
                }
        }
        std::exit(1);
    }
};
