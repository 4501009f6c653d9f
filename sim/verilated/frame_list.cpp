// SPDX-License-Identifier: Apache-2.0
#include "frame_list.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace touchdown {

namespace {
constexpr size_t HEADER_BYTES = 20;

uint32_t word(const uint8_t* at) {
    uint32_t value;
    std::memcpy(&value, at, sizeof value);
    return value;
}
}  // namespace

FrameList::FrameList(const std::string& path) {
    const int file = open(path.c_str(), O_RDONLY);
    struct stat status = {};
    if (file < 0 || fstat(file, &status) != 0) {
        if (file >= 0) close(file);
        throw std::runtime_error("the frame list " + path + " cannot be read.");
    }
    size_ = static_cast<size_t>(status.st_size);
    void* data = size_ >= HEADER_BYTES ? mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0) : MAP_FAILED;
    close(file);
    if (data == MAP_FAILED) throw std::runtime_error("the frame list " + path + " is shorter than its header.");
    data_ = static_cast<const uint8_t*>(data);
    width_ = word(data_ + 4);
    height_ = word(data_ + 8);
    count_ = word(data_ + 12);
    repeat_ = word(data_ + 16);
    frame_bytes_ = sizeof(uint32_t) + size_t{3} * width_ * height_;
    const size_t frames_end = HEADER_BYTES + count_ * frame_bytes_;
    const size_t messages_end = frames_end + count_ * (sizeof(uint32_t) + MESSAGE_BYTES);
    if (size_ == messages_end) messages_ = data_ + frames_end;
    if (std::memcmp(data_, "TDF1", 4) != 0 || width_ == 0 || height_ == 0 || count_ == 0 || repeat_ == 0 ||
        (size_ != frames_end && size_ != messages_end)) {
        munmap(const_cast<uint8_t*>(data_), size_);
        throw std::runtime_error("the frame list " + path + " is damaged: make it again.");
    }
}

FrameList::~FrameList() { munmap(const_cast<uint8_t*>(data_), size_); }

const uint8_t* FrameList::frame(uint32_t index) const {
    return data_ + HEADER_BYTES + index / repeat_ * frame_bytes_;
}

uint32_t FrameList::altitude_mm(uint32_t index) const { return word(frame(index)); }

std::string FrameList::from_autopilot(uint32_t index) const {
    if (messages_ == nullptr || index >= shown()) return {};
    const uint8_t* at = messages_ + index / repeat_ * (sizeof(uint32_t) + MESSAGE_BYTES);
    return {reinterpret_cast<const char*>(at + sizeof(uint32_t)), std::min<size_t>(word(at), MESSAGE_BYTES)};
}

}  // namespace touchdown
