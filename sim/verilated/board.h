// SPDX-License-Identifier: Apache-2.0
// What surrounds the programmable logic: memory behind the AXI master, and
// somebody who wants to know when things happen. Times are nanoseconds since
// the start of the model.
#pragma once

#include <cstddef>
#include <cstdint>

namespace touchdown {

class Board {
public:
    virtual ~Board() = default;

    virtual void write_memory(uint64_t address, const uint8_t* bytes, size_t count) = 0;
    virtual void read_memory(uint64_t address, uint8_t* bytes, size_t count) = 0;

    // `index` counts the frames on the wire, from 0.
    virtual void first_pixel(uint32_t index, uint64_t time_ns) { (void)index, (void)time_ns; }
    virtual void last_pixel(uint32_t index, uint64_t time_ns) { (void)index, (void)time_ns; }
    virtual void irq(bool level, uint64_t time_ns) { (void)level, (void)time_ns; }
    // A record is complete in memory at `address`; its registers are up to date.
    virtual void record(uint64_t address, uint64_t time_ns) { (void)address, (void)time_ns; }
};

}  // namespace touchdown
