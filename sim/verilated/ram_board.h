// SPDX-License-Identifier: Apache-2.0
// A board with nothing but the memory of the result ring, and a log.
#pragma once

#include <cstring>
#include <stdexcept>
#include <vector>

#include "sim/cosim/run_log.h"
#include "sim/verilated/board.h"
#include "sim/verilated/landing_layout.h"

namespace touchdown {

class RamBoard : public Board {
public:
    static constexpr uint32_t RING_ADDRESS = 0x10000000;

    explicit RamBoard(RunLog& log) : log_(log), memory_(LANDING_RING_BUFFERS * LANDING_RING_STRIDE_BYTES) {}

    void write_memory(uint64_t address, const uint8_t* bytes, size_t count) override {
        std::memcpy(at(address, count), bytes, count);
    }
    void read_memory(uint64_t address, uint8_t* bytes, size_t count) override {
        std::memcpy(bytes, at(address, count), count);
    }
    void first_pixel(uint32_t index, uint64_t time_ns) override { log_.first_pixel(index, time_ns); }
    void last_pixel(uint32_t index, uint64_t time_ns) override {
        log_.last_pixel(index, time_ns);
        last_pixel_ns_ = time_ns;
    }
    void irq(bool level, uint64_t time_ns) override { log_.irq(level, time_ns); }
    void record(uint64_t address, uint64_t time_ns) override { log_.record(*this, address, time_ns); }

    uint64_t last_pixel_ns() const { return last_pixel_ns_; }

private:
    uint8_t* at(uint64_t address, size_t count) {
        const uint64_t offset = address - RING_ADDRESS;
        if (address < RING_ADDRESS || offset + count > memory_.size())
            throw std::runtime_error("m_axi: landing_core touches memory outside its ring.");
        return memory_.data() + offset;
    }

    RunLog& log_;
    std::vector<uint8_t> memory_;
    uint64_t last_pixel_ns_ = 0;
};

}  // namespace touchdown
