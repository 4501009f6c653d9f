// SPDX-License-Identifier: Apache-2.0
// A list of frames in one file, mapped into memory.
//
// Layout, little endian: "TDF1", then width, height, count and repeat (uint32
// each), then `count` frames of altitude_mm (uint32, 0 = the LiDAR sees nothing)
// and width * height * 3 bytes R, G, B in raster order; then, if the autopilot
// says anything, `count` times how many bytes (uint32) and room for 64 of them.
// Each frame is shown `repeat` times in a row. sim/cosim/frame_list.py writes it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace touchdown {

class FrameList {
public:
    // Throws std::runtime_error with a sentence that names the file.
    explicit FrameList(const std::string& path);
    ~FrameList();
    FrameList(const FrameList&) = delete;
    FrameList& operator=(const FrameList&) = delete;

    uint32_t width() const { return width_; }
    uint32_t height() const { return height_; }
    uint32_t shown() const { return count_ * repeat_; }  // frames on the wire

    // `index` counts frames on the wire, from 0.
    const uint8_t* pixels(uint32_t index) const { return frame(index) + sizeof(uint32_t); }
    uint32_t altitude_mm(uint32_t index) const;
    // What the autopilot sends before the record of the frame; may be empty.
    std::string from_autopilot(uint32_t index) const;

private:
    static constexpr size_t MESSAGE_BYTES = 64;

    const uint8_t* frame(uint32_t index) const;

    const uint8_t* data_ = nullptr;
    size_t size_ = 0;
    size_t frame_bytes_ = 0;
    const uint8_t* messages_ = nullptr;
    uint32_t width_ = 0;
    uint32_t height_ = 0;
    uint32_t count_ = 0;
    uint32_t repeat_ = 0;
};

}  // namespace touchdown
