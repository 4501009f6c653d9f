// SPDX-License-Identifier: Apache-2.0
// The same numbers on every machine for the same seed (xorshift64*).
#pragma once

#include <cstdint>

namespace touchdown {

class Random {
public:
    explicit Random(uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 1) {}

    // 0 .. limit - 1
    uint32_t below(uint32_t limit) {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        return static_cast<uint32_t>((state_ * 0x2545F4914F6CDD1Du >> 33) % limit);
    }

private:
    uint64_t state_;
};

}  // namespace touchdown
