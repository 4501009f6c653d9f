// SPDX-License-Identifier: Apache-2.0
// Writes every beat that passes between the stages of landing_core to a file a
// stage, for comparison with the golden models.
//
// <folder>/<stage>.bin holds one entry a handshake: the payload, little endian,
// of the bytes given in STAGE_BYTES, then one byte {tlast, tuser}.
// sim/compare_stages.py reads it. A beat that changes or vanishes before it was
// taken is an error.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "landing_model.h"

namespace touchdown {

class StageTaps final : public Taps {
public:
    // Throws std::runtime_error if a file cannot be made.
    explicit StageTaps(const std::string& folder);
    ~StageTaps() override;
    StageTaps(const StageTaps&) = delete;
    StageTaps& operator=(const StageTaps&) = delete;

    // Throws std::runtime_error where a stream breaks its protocol.
    void sample(const Vlanding_core___024root& root) override;

private:
    struct Handshake {
        bool valid;
        bool ready;
    };

    // Entries as they are written to the files.
    void look(size_t stage, Handshake now, const void* payload, bool first, bool last);

    std::vector<std::FILE*> files_;
    std::vector<std::string> offers_;  // of each stage the entry that was not taken a cycle before, or nothing
};

}  // namespace touchdown
