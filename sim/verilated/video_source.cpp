// SPDX-License-Identifier: Apache-2.0
#include "video_source.h"

namespace touchdown {

VideoSource::VideoSource(const FrameList& frames, const VideoTiming& timing) : frames_(frames), timing_(timing) {
    line_clocks_ = frames.width() + timing.h_front + timing.h_sync + timing.h_back;
    lines_ = frames.height() + timing.v_front + timing.v_sync + timing.v_back;
    const uint64_t least_lines = (timing.frame_clocks + line_clocks_ - 1) / line_clocks_;
    if (least_lines > lines_) lines_ = static_cast<uint32_t>(least_lines);
}

VideoSample VideoSource::next(bool& first, bool& last) {
    VideoSample sample;
    first = false;
    last = false;
    if (!running_ || finished()) return sample;

    const uint32_t top = timing_.v_sync + timing_.v_back;
    const bool visible_line = line_ >= top && line_ < top + frames_.height();
    sample.vsync = line_ < timing_.v_sync;
    const uint32_t sync_start = frames_.width() + timing_.h_front;
    sample.hsync = column_ >= sync_start && column_ < sync_start + timing_.h_sync;
    if (visible_line && column_ < frames_.width()) {
        first = line_ == top && column_ == 0;
        last = line_ == top + frames_.height() - 1 && column_ == frames_.width() - 1;
        if (first) pixel_ = frames_.pixels(index_);
        sample.de = true;
        sample.rgb = static_cast<uint32_t>(pixel_[0] << 16 | pixel_[1] << 8 | pixel_[2]);
        pixel_ += 3;
    }

    if (++column_ == line_clocks_) {
        column_ = 0;
        if (++line_ == lines_) {
            line_ = 0;
            ++index_;
        }
    }
    return sample;
}

}  // namespace touchdown
