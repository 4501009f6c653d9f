// SPDX-License-Identifier: Apache-2.0
// The plugin that shows a list of frames and logs what happens.
//
// Arguments: frames=<file> out=<folder> frame-clocks=<n> tail-us=<n>
#include <stdexcept>
#include <string>

#include "sim/cosim/qemu_machine.h"
#include "sim/verilated/arguments.h"
#include "sim/verilated/frame_list.h"
#include "sim/verilated/video_source.h"

namespace touchdown {
namespace {

// An interrupt reaches the CPU at most this late: each wait for a record is
// finely divided, the rest of a frame coarsely, because a division costs time.
constexpr uint64_t FINE_NS = 1'000;
constexpr uint64_t COARSE_NS = 10'000;

// The board's camera, in FRAME_SIZE.
constexpr uint64_t CAMERA_SIZE = 720 << 16 | 1280;

// Made before the machine, which takes the camera.
struct FrameCamera {
    explicit FrameCamera(const Arguments& arguments) : frames(arguments.text("frames")), video(frames, timing(arguments)) {}

    static VideoTiming timing(const Arguments& arguments) {
        VideoTiming timing;
        timing.frame_clocks = arguments.number("frame-clocks");
        return timing;
    }

    FrameList frames;
    VideoSource video;
};

class FramesMachine final : private FrameCamera, public Machine {
public:
    explicit FramesMachine(const Arguments& arguments)
        : FrameCamera(arguments),
          Machine(ModelConfig(), video),
          log_(arguments.text("out")),
          tail_ns_(arguments.number("tail-us") * 1000) {}

    void first_pixel(uint32_t index, uint64_t time_ns) override { log_.first_pixel(index, time_ns); }
    void last_pixel(uint32_t index, uint64_t time_ns) override {
        log_.last_pixel(index, time_ns);
        last_pixel_ns_ = time_ns;
        record_due_ = true;
        finished_ = index + 1 == frames.shown();
    }
    void irq(bool level, uint64_t time_ns) override {
        log_.irq(level, time_ns);
        Machine::irq(level, time_ns);
    }
    void record(uint64_t address, uint64_t time_ns) override {
        log_.record(*this, address, time_ns);
        record_due_ = false;
    }
    void uart(unsigned port, uint64_t push_ns, uint64_t done_ns, uint8_t byte) override {
        log_.uart(port, push_ns, done_ns, byte);
    }

private:
    // The firmware is built for its camera; a test camera may be smaller.
    uint64_t frame_size(uint64_t written, unsigned size) const override {
        const uint64_t shown = frames.height() << 16 | frames.width();
        if (shown == CAMERA_SIZE) return written;
        if (size == 4 && written == CAMERA_SIZE) return shown;
        throw std::runtime_error("the firmware wrote " + std::to_string(written) + " to FRAME_SIZE and not " +
                                 std::to_string(CAMERA_SIZE) + ", the 1280x720 of the board's camera.");
    }

    uint64_t tick(uint64_t now_ns) override {
        if (finished_ && now_ns >= last_pixel_ns_ + tail_ns_) {
            log_.end(now_ns);
            leave(0);
        }
        return now_ns + (record_due_ ? FINE_NS : COARSE_NS);
    }

    RunLog log_;
    uint64_t tail_ns_;
    uint64_t last_pixel_ns_ = 0;
    bool finished_ = false;
    bool record_due_ = false;
};

}  // namespace
}  // namespace touchdown

extern "C" __attribute__((visibility("default"))) int qemu_plugin_install(uint64_t, const qemu::PluginInfo*, int count,
                                                                          char** arguments) {
    touchdown::Machine::install<touchdown::FramesMachine>(touchdown::Arguments(count, arguments));
    return 0;
}
