// SPDX-License-Identifier: Apache-2.0
// A camera: shows a frame list with the timing of 720p60 (CEA-861: 1650 x 750
// pixel clocks in all, sync pulses active high), or with that of 1080p60 (2200 x
// 1125).
//
// Other frame sizes keep the blanking. `frame_clocks` lengthens the
// vertical front porch by whole lines until a frame takes at least that long.
#pragma once

#include <cstdint>

#include "camera.h"
#include "frame_list.h"

namespace touchdown {

struct VideoTiming {
    uint32_t h_front = 110;
    uint32_t h_sync = 40;
    uint32_t h_back = 220;
    uint32_t v_front = 5;
    uint32_t v_sync = 5;
    uint32_t v_back = 20;
    uint64_t frame_clocks = 0;

    static VideoTiming of_1080p60() {
        VideoTiming timing;
        timing.h_front = 88;
        timing.h_sync = 44;
        timing.h_back = 148;
        timing.v_front = 4;
        timing.v_sync = 5;
        timing.v_back = 36;
        return timing;
    }
};

class VideoSource final : public Camera {
public:
    VideoSource(const FrameList& frames, const VideoTiming& timing);

    void start() override { running_ = true; }
    VideoSample next(bool& first, bool& last) override;
    uint32_t index() const override { return finished() ? index_ - 1 : index_; }
    uint32_t altitude_mm() const override { return frames_.altitude_mm(index()); }

    bool finished() const { return index_ == frames_.shown(); }

private:
    const FrameList& frames_;
    VideoTiming timing_;
    uint32_t line_clocks_;
    uint32_t lines_;
    bool running_ = false;
    uint32_t index_ = 0;
    uint32_t column_ = 0;  // 0 = first pixel of the line
    uint32_t line_ = 0;    // 0 = vertical sync starts
    const uint8_t* pixel_ = nullptr;
};

}  // namespace touchdown
