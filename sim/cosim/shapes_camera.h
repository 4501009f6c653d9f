// SPDX-License-Identifier: Apache-2.0
// A camera for the build of landing_core with sim/verilated/stand_ins: it gives the
// shapes of a frame, a bit each pixel clock, in the time that a frame of pixels takes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sim/verilated/camera.h"

namespace touchdown {

class ShapesCamera final : public Camera {
public:
    // Of the last pixel after the first: 720 lines of 720p60, unless the objects take longer.
    static constexpr uint64_t SCAN_US = 16'000;

    explicit ShapesCamera(uint64_t clocks_per_us) : clocks_per_us_(clocks_per_us) {}

    // The frame starts now. `objects` are whole objects of the result record. Returns the microseconds to its last pixel.
    // Throws std::runtime_error where the frame before is still on the wire.
    uint64_t show(std::vector<uint8_t> objects) {
        begin();
        objects_ = std::move(objects);
        malformed_ = false;
        end_clock_ = std::max(SCAN_US * clocks_per_us_, uint64_t{objects_.size()} * 8 + LEAD_CLOCKS);
        return end_clock_ / clocks_per_us_;
    }

    // A frame whose lines are not what they should be.
    void show_malformed() {
        begin();
        objects_.clear();
        malformed_ = true;
        end_clock_ = SCAN_US * clocks_per_us_;
    }

    void set_altitude_mm(uint32_t altitude_mm) { altitude_mm_ = altitude_mm; }

    void start() override { started_ = true; }
    uint32_t index() const override { return shown_ == 0 ? 0 : shown_ - 1; }
    uint32_t altitude_mm() const override { return altitude_mm_; }

    VideoSample next(bool& first, bool& last) override {
        VideoSample sample;
        first = false;
        last = false;
        if (!busy_) return sample;
        const uint64_t bit = clock_ - LEAD_CLOCKS;
        if (clock_ == 0) {
            sample.vsync = true;
            sample.hsync = malformed_;
            first = true;
        } else if (clock_ == end_clock_) {
            sample.de = true;
            sample.hsync = true;
            last = true;
            busy_ = false;
        } else if (clock_ == 1) {
            sample.de = true;
        } else if (bit < objects_.size() * 8) {
            sample.de = true;
            sample.rgb = objects_[bit / 8] >> (bit % 8) & 1;
        }
        ++clock_;
        return sample;
    }

private:
    // Vertical sync, and the pixel that says that a frame has begun.
    static constexpr uint64_t LEAD_CLOCKS = 2;

    void begin() {
        if (busy_) throw std::runtime_error("a frame starts while the one before is on the wire.");
        busy_ = started_;
        clock_ = 0;
        if (started_) ++shown_;
    }

    uint64_t clocks_per_us_;
    uint64_t end_clock_ = 0;
    std::vector<uint8_t> objects_;
    uint64_t clock_ = 0;
    uint32_t altitude_mm_ = 0;
    uint32_t shown_ = 0;
    bool started_ = false;
    bool busy_ = false;
    bool malformed_ = false;
};

}  // namespace touchdown
