// SPDX-License-Identifier: Apache-2.0
// A LIDAR-Lite v3 on its mode-control pin.
//
// While the host holds the pin low the sensor measures continuously: it thinks
// for ACQUISITION_US and then drives the pin high for 1 us a millimetre. Without
// a return (0 mm) the pin stays low. The host's 1 kOhm never wins against the
// sensor's driver; with nobody driving, the level is taken for low.
#pragma once

#include <cstdint>

namespace touchdown {

class LidarPin {
public:
    static constexpr uint64_t ACQUISITION_US = 1000;

    explicit LidarPin(uint64_t clocks_per_us) : clocks_per_us_(clocks_per_us) {}

    // Level of the pin after one more clock.
    bool next(bool host_pulls_low, uint32_t altitude_mm) {
        if (left_ != 0) {
            --left_;
        } else if (phase_ == Phase::ACQUIRING && altitude_mm != 0) {
            phase_ = Phase::PULSE;
            left_ = altitude_mm * clocks_per_us_ - 1;
        } else if (host_pulls_low) {
            phase_ = Phase::ACQUIRING;
            left_ = ACQUISITION_US * clocks_per_us_ - 1;
        } else {
            phase_ = Phase::IDLE;
        }
        return phase_ == Phase::PULSE;
    }

private:
    enum class Phase { IDLE, ACQUIRING, PULSE };
    uint64_t clocks_per_us_;
    uint64_t left_ = 0;
    Phase phase_ = Phase::IDLE;
};

}  // namespace touchdown
