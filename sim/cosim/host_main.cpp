// SPDX-License-Identifier: Apache-2.0
// FIRMWARE=host: the firmware's core compiled for this machine, on the same
// model of landing_core. It takes no time: a record is handled in the instant in
// which its interrupt rises, and bytes go to the wire at once.
//
// Arguments: frames=<file> out=<folder> frame-clocks=<n> tail-us=<n>
#include <cstdio>
#include <exception>

#include "sim/cosim/run_log.h"
#include "sim/verilated/arguments.h"
#include "sim/verilated/landing_layout.h"
#include "sim/verilated/landing_model.h"
#include "sim/verilated/ram_board.h"
#include "sim/verilated/video_source.h"

extern "C" {
#include "firmware/board/board.h"
#include "firmware/host/host.h"
}

namespace touchdown {
namespace {

// Of the main loop, between interrupts.
constexpr uint64_t QUANTUM_NS = 1'000;
constexpr uint64_t TICK_NS = 1'000'000;
constexpr double BAUD[2] = {BOARD_AUTOPILOT_BAUD, BOARD_GROUND_BAUD};

class Host {
public:
    explicit Host(const Arguments& arguments)
        : log_(arguments.text("out")),
          frames_(arguments.text("frames")),
          video_(frames_, timing(arguments)),
          board_(log_),
          model_(ModelConfig(), video_, board_),
          tail_ns_(arguments.number("tail-us") * 1000) {}

    void run() {
        touchdown_init([](void* self, int link, const uint8_t* bytes,
                          size_t count) { static_cast<Host*>(self)->write(link, bytes, count); },
                       this, now_us());
        configure();
        uint64_t time_ns = model_.now_ns();
        uint64_t next_tick_ns = time_ns;
        while (!video_.finished() || time_ns < board_.last_pixel_ns() + tail_ns_) {
            time_ns += QUANTUM_NS;
            model_.advance_to(time_ns);
            if (model_.irq()) take_record();
            if (time_ns >= next_tick_ns) {
                next_tick_ns += TICK_NS;
                tick();
            }
        }
        log_.end(time_ns);
    }

private:
    static VideoTiming timing(const Arguments& arguments) {
        VideoTiming timing;
        timing.frame_clocks = arguments.number("frame-clocks");
        return timing;
    }

    uint64_t now_us() {
        const uint64_t low = model_.read(LANDING_REG_TIME_LO_OFFSET);
        return uint64_t{model_.read(LANDING_REG_TIME_HI_OFFSET)} << 32 | low;
    }

    // As firmware/board/landing_hw.c does.
    void configure() {
        model_.write(LANDING_REG_RING_BASE_OFFSET, RamBoard::RING_ADDRESS);
        model_.write(LANDING_REG_FRAME_SIZE_OFFSET, frames_.height() << 16 | frames_.width());
        adapt();
        model_.write(LANDING_REG_LIDAR_CTRL_OFFSET, LANDING_REG_LIDAR_CTRL_ENABLE_MASK);
        model_.write(LANDING_REG_IRQ_ENABLE_OFFSET, LANDING_REG_IRQ_ENABLE_FRAME_DONE_MASK);
        model_.write(LANDING_REG_CTRL_OFFSET, LANDING_REG_CTRL_DARK_IS_ONE_MASK | LANDING_REG_CTRL_ENABLE_MASK);
    }

    void take_record() {
        model_.write(LANDING_REG_IRQ_STATUS_OFFSET, LANDING_REG_IRQ_STATUS_FRAME_DONE_MASK);
        const uint32_t head = model_.read(LANDING_REG_RING_HEAD_OFFSET) & LANDING_REG_RING_HEAD_INDEX_MASK;
        landing_record record;
        board_.read_memory(RamBoard::RING_ADDRESS + head * LANDING_RING_STRIDE_BYTES,
                           reinterpret_cast<uint8_t*>(&record), sizeof record);
        listen(record.header.frame_number - 1);
        touchdown_on_record(&record, sizeof record, now_us());
        adapt();
    }

    // On the board these bytes come at any time; here just before the record.
    void listen(uint32_t index) {
        const std::string said = frames_.from_autopilot(index);
        touchdown_on_bytes(TOUCHDOWN_AUTOPILOT, reinterpret_cast<const uint8_t*>(said.data()), said.size(), now_us());
    }

    void adapt() {
        model_.write(LANDING_REG_THRESHOLD_OFFSET, touchdown_threshold());
        model_.write(LANDING_REG_MIN_AREA_OFFSET, touchdown_min_area());
    }

    void tick() {
        const bool valid =
            (model_.read(LANDING_REG_LIDAR_STATUS_OFFSET) & LANDING_REG_LIDAR_STATUS_VALID_MASK) != 0;
        const uint32_t distance_mm = model_.read(LANDING_REG_LIDAR_DISTANCE_OFFSET);
        const uint32_t age_us = model_.read(LANDING_REG_LIDAR_AGE_OFFSET);
        touchdown_tick(now_us(), valid, distance_mm, age_us);
    }

    void write(int link, const uint8_t* bytes, size_t count) {
        const uint64_t now = model_.now_ns();
        for (size_t i = 0; i < count; ++i)
            log_.uart(static_cast<unsigned>(link), now, wires_[link].send(now, BAUD[link]), bytes[i]);
    }

    RunLog log_;
    FrameList frames_;
    VideoSource video_;
    RamBoard board_;
    LandingModel model_;
    UartWire wires_[2];
    uint64_t tail_ns_;
};

}  // namespace
}  // namespace touchdown

int main(int count, char** values) {
    try {
        touchdown::Host(touchdown::Arguments(count - 1, values + 1)).run();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "touchdown: %s\n", error.what());
        return 1;
    }
    return 0;
}
