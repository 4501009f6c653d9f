// SPDX-License-Identifier: Apache-2.0
// Shows frames to landing_core and writes what passes between its stages
// (stage_taps.h) and its records (run_log.h).
//
// Arguments: frames=<file> out=<folder> frame-clocks=<n> threshold=<n> min-area=<n>
// ctrl=<n> random-memory=<0|1> seed=<n> taps=<0|1> full-hd=<0|1>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <memory>

#include "sim/cosim/run_log.h"
#include "sim/verilated/arguments.h"
#include "sim/verilated/landing_layout.h"
#include "sim/verilated/landing_model.h"
#include "sim/verilated/ram_board.h"
#include "sim/verilated/stage_taps.h"
#include "sim/verilated/video_source.h"

namespace touchdown {
namespace {

constexpr uint64_t QUANTUM_NS = 10'000;
// Flushing borders and ccl takes a few lines, writing at most 256 objects less
// than 1 ms even on a slow memory.
constexpr uint64_t TAIL_NS = 2'000'000;

void run(const Arguments& arguments) {
    RunLog log(arguments.text("out"));
    const FrameList frames(arguments.text("frames"));
    RamBoard board(log);
    const bool full_hd = arguments.number("full-hd") != 0;
    VideoTiming timing = full_hd ? VideoTiming::of_1080p60() : VideoTiming();
    timing.frame_clocks = arguments.number("frame-clocks");
    VideoSource video(frames, timing);
    ModelConfig config;
    if (full_hd) {
        config.clk_hz = 150'000'000;
        config.pix_hz = 148'500'000;
        config.clk_per_us = 150;
    }
    config.memory.random = arguments.number("random-memory") != 0;
    config.memory.seed = arguments.number("seed");
    LandingModel model(config, video, board);
    std::unique_ptr<StageTaps> taps;
    if (arguments.number("taps") != 0) {
        taps = std::make_unique<StageTaps>(arguments.text("out"));
        model.attach(*taps);
    }

    model.write(LANDING_REG_RING_BASE_OFFSET, RamBoard::RING_ADDRESS);
    model.write(LANDING_REG_FRAME_SIZE_OFFSET, frames.height() << 16 | frames.width());
    model.write(LANDING_REG_THRESHOLD_OFFSET, static_cast<uint32_t>(arguments.number("threshold")));
    model.write(LANDING_REG_MIN_AREA_OFFSET, static_cast<uint32_t>(arguments.number("min-area")));
    model.write(LANDING_REG_LIDAR_CTRL_OFFSET, LANDING_REG_LIDAR_CTRL_ENABLE_MASK);
    model.write(LANDING_REG_CTRL_OFFSET, static_cast<uint32_t>(arguments.number("ctrl")) | LANDING_REG_CTRL_ENABLE_MASK);

    const auto start = std::chrono::steady_clock::now();
    const uint64_t first_clock = model.clocks();
    uint64_t time_ns = model.now_ns();
    while (!video.finished() || time_ns < board.last_pixel_ns() + TAIL_NS) {
        time_ns += QUANTUM_NS;
        model.advance_to(time_ns);
    }
    log.end(time_ns);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    const uint64_t clocks = model.clocks() - first_clock;
    std::printf("clocks %" PRIu64 " seconds %.3f\n", clocks, wall.count());
}

}  // namespace
}  // namespace touchdown

int main(int count, char** values) {
    try {
        touchdown::run(touchdown::Arguments(count - 1, values + 1));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "touchdown: %s\n", error.what());
        return 1;
    }
    return 0;
}
