// SPDX-License-Identifier: Apache-2.0
// What drives the video pins of landing_core, and how far its LiDAR is from the
// ground meanwhile.
#pragma once

#include <cstdint>

namespace touchdown {

struct VideoSample {
    uint32_t rgb = 0;  // {R, G, B}
    bool de = false;
    bool hsync = false;
    bool vsync = false;
};

class Camera {
public:
    virtual ~Camera() = default;

    // The firmware is ready for frames.
    virtual void start() = 0;
    // What is driven for the next pixel clock. `first` and `last` say whether it is
    // the first or the last pixel of frame index().
    virtual VideoSample next(bool& first, bool& last) = 0;
    // The frame on the wire, or the newest one when there is none.
    virtual uint32_t index() const = 0;
    // 0 = no return.
    virtual uint32_t altitude_mm() const = 0;
};

}  // namespace touchdown
