// SPDX-License-Identifier: Apache-2.0
// Plays beats from stdin into a verilated stream core and writes the beats that come out to stdout.
// tb/exhaustive builds it, one core at a time, and runs it: player WIDTH HEIGHT FACTOR FLAT_LIMIT IDLE STALL
//
// IDLE, STALL: per cent of the cycles without a beat offered, and with the output held back, at random.
// A beat is 8 bytes: data in the low half; bit 0 (tuser) and bit 1 (tlast) of the high half.
// SIZED: the core has cfg_width and cfg_height. STATS: its stat stream counts, under cfg_factor and cfg_flat_limit.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "Vtop.h"
#include "verilated.h"

static const size_t CHUNK = 1 << 16;
static const int LONGEST_WAIT = 100000;

static uint64_t beat_of(uint32_t data, bool user, bool last) {
    return data | static_cast<uint64_t>(user) << 32 | static_cast<uint64_t>(last) << 33;
}

int main(int argc, char **argv) {
    if (argc != 7) {
        std::fprintf(stderr, "touchdown: give WIDTH HEIGHT FACTOR FLAT_LIMIT IDLE STALL.\n");
        return 1;
    }
    VerilatedContext context;
    Vtop top(&context);
    std::vector<uint64_t> in(CHUNK), out;
    size_t used = 0, held = 0;
    bool more = true;
    uint64_t idle = 0;
    int waited = 0;
    bool offered = false;
    std::mt19937 random;
    const unsigned idle_percent = atoi(argv[5]), stall_percent = atoi(argv[6]);
    const uint64_t drain = 4096 + 8 * strtoull(argv[1], nullptr, 10);
#ifdef SIZED
    top.cfg_width = atoi(argv[1]);
    top.cfg_height = atoi(argv[2]);
#endif
#ifdef STATS
    top.cfg_factor = atoi(argv[3]);
    top.cfg_flat_limit = atoi(argv[4]);
#endif
    for (int cycle = 0; idle < drain; cycle += cycle < 8) {
        top.rst = cycle < 4;
        if (used == held && more && cycle >= 8) {
            held = std::fread(in.data(), sizeof(uint64_t), CHUNK, stdin);
            used = 0;
            more = held != 0;
        }
        offered = used < held && (offered || random() % 100 >= idle_percent);
        const bool valid = offered, ready = random() % 100 >= stall_percent;
        top.m_axis_tready = ready;
#ifdef STATS
        top.m_stat_axis_tready = ready;
#endif
        const uint64_t beat = valid ? in[used] : 0;
        top.s_axis_tvalid = valid;
        top.s_axis_tdata = static_cast<uint32_t>(beat);
        top.s_axis_tuser = beat >> 32 & 1;
        top.s_axis_tlast = beat >> 33 & 1;
        top.clk = 0;
        top.eval();
        if (!top.rst) {
            waited = valid && !top.s_axis_tready ? waited + 1 : 0;
            if (waited == LONGEST_WAIT) {
                std::fprintf(stderr, "touchdown: the core has not taken a beat for %d cycles.\n", waited);
                return 2;
            }
            if (valid && top.s_axis_tready) {
                used++;
                offered = false;
            }
#ifdef STATS
            if (top.m_stat_axis_tvalid && ready)
                out.push_back(beat_of(top.m_stat_axis_tdata, top.m_stat_axis_tuser, top.m_stat_axis_tlast));
#else
            if (top.m_axis_tvalid && ready)
                out.push_back(beat_of(top.m_axis_tdata, top.m_axis_tuser, top.m_axis_tlast));
#endif
        }
        idle = more || used < held ? 0 : idle + 1;
        if (out.size() >= CHUNK || idle == drain) {
            if (std::fwrite(out.data(), sizeof(uint64_t), out.size(), stdout) != out.size()) return 1;
            out.clear();
        }
        top.clk = 1;
        top.eval();
    }
    return 0;
}
