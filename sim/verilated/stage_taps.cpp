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
    offers_.resize(STAGES);
}

StageTaps::~StageTaps() {
    for (std::FILE* file : files_) std::fclose(file);
}

void StageTaps::look(size_t stage, Handshake now, const void* payload, bool first, bool last) {
    std::string& offer = offers_[stage];
    if (!now.valid && offer.empty()) return;
    std::string entry(static_cast<const char*>(payload), STAGE_BYTES[stage].bytes);
    entry.push_back(static_cast<char>(last << 1 | first));
    if (!offer.empty() && (!now.valid || entry != offer))
        throw std::runtime_error(std::string("stage ") + STAGE_BYTES[stage].name + ": a beat changed while stalled.");
    if (now.ready) std::fwrite(entry.data(), entry.size(), 1, files_[stage]);
    offer = now.ready ? std::string() : entry;
}

void StageTaps::sample(const Vlanding_core___024root& root) {
    if (root.rst) {
        for (std::string& offer : offers_) offer.clear();
        return;
    }
#define TAP(stage, name)                                                                                            \
    look(stage, {root.landing_core__DOT__##name##_tvalid != 0, root.landing_core__DOT__##name##_tready != 0},       \
         &root.landing_core__DOT__##name##_tdata, root.landing_core__DOT__##name##_tuser,                           \
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
