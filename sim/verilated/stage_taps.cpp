// SPDX-License-Identifier: Apache-2.0
#include "stage_taps.h"

#include <array>
#include <stdexcept>

#include "Vlanding_core___024root.h"

namespace touchdown {

namespace {

struct Stage {
    const char* name;
    size_t bytes;
};

enum { RGB, GRAY, SMOOTH, CHECKED, STATS, BINARY, ERODED, MEDIAN, DILATED, OBJECTS, STAGES };

constexpr std::array<Stage, STAGES> STAGE_BYTES = {{{"rgb", 3},
                                                    {"gray", 1},
                                                    {"smooth", 1},
                                                    {"checked", 1},
                                                    {"stats", 4},
                                                    {"binary", 1},
                                                    {"eroded", 1},
                                                    {"median", 1},
                                                    {"dilated", 1},
                                                    {"objects", 64}}};

constexpr size_t FILE_BUFFER_BYTES = 1 << 16;

}  // namespace

StageTaps::StageTaps(const std::string& folder) {
    for (const Stage& stage : STAGE_BYTES) {
        const std::string path = folder + "/" + stage.name + ".bin";
        std::FILE* file = std::fopen(path.c_str(), "wb");
        if (file == nullptr) throw std::runtime_error("cannot write " + path + ".");
        std::setvbuf(file, nullptr, _IOFBF, FILE_BUFFER_BYTES);
        files_.push_back(file);
    }
}

StageTaps::~StageTaps() {
    for (std::FILE* file : files_) std::fclose(file);
}

void StageTaps::beat(size_t stage, const void* payload, bool first, bool last) {
    std::fwrite(payload, STAGE_BYTES[stage].bytes, 1, files_[stage]);
    std::putc(last << 1 | first, files_[stage]);
}

void StageTaps::sample(const Vlanding_core___024root& root) {
#define TAP(stage, name)                                                                                            \
    if (root.landing_core__DOT__##name##_tvalid && root.landing_core__DOT__##name##_tready)                         \
        beat(stage, &root.landing_core__DOT__##name##_tdata, root.landing_core__DOT__##name##_tuser,                \
             root.landing_core__DOT__##name##_tlast)
    TAP(RGB, rgb);
    TAP(GRAY, chain__DOT__gray);
    TAP(SMOOTH, chain__DOT__smooth);
    TAP(CHECKED, chain__DOT__checked);
    TAP(STATS, chain__DOT__stats);
    TAP(BINARY, chain__DOT__binary);
    TAP(ERODED, chain__DOT__eroded);
    TAP(MEDIAN, chain__DOT__median);
    TAP(DILATED, dilated);
    TAP(OBJECTS, objects);
#undef TAP
}

}  // namespace touchdown
