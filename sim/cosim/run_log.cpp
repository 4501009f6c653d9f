// SPDX-License-Identifier: Apache-2.0
#include "sim/cosim/run_log.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <stdexcept>

#include "sim/verilated/landing_layout.h"

namespace touchdown {

namespace {
std::FILE* create(const std::string& path) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) throw std::runtime_error("cannot write " + path + ".");
    return file;
}
}  // namespace

RunLog::RunLog(const std::string& folder)
    : events_(create(folder + "/events.txt")), records_(create(folder + "/records.bin")) {}

RunLog::~RunLog() {
    std::fclose(events_);
    std::fclose(records_);
}

void RunLog::first_pixel(uint32_t index, uint64_t time_ns) {
    std::fprintf(events_, "first %" PRIu32 " %" PRIu64 "\n", index, time_ns);
}

// Flushed, so that whoever waits can tell how far the run is.
void RunLog::last_pixel(uint32_t index, uint64_t time_ns) {
    std::fprintf(events_, "last %" PRIu32 " %" PRIu64 "\n", index, time_ns);
    std::fflush(events_);
}

void RunLog::irq(bool level, uint64_t time_ns) { std::fprintf(events_, "irq %d %" PRIu64 "\n", level, time_ns); }

void RunLog::record(Board& board, uint64_t address, uint64_t time_ns) {
    landing_record record = {};
    board.read_memory(address, reinterpret_cast<uint8_t*>(&record.header), sizeof record.header);
    const size_t objects = std::min<size_t>(record.header.object_count, LANDING_RECORD_MAX_OBJECTS);
    board.read_memory(address + sizeof record.header, reinterpret_cast<uint8_t*>(record.objects),
                      objects * sizeof record.objects[0]);
    std::fwrite(&record, sizeof record, 1, records_);
    std::fprintf(events_, "record %" PRIu64 "\n", time_ns);
}

void RunLog::uart(unsigned port, uint64_t push_ns, uint64_t done_ns, uint8_t byte) {
    std::fprintf(events_, "uart %u %" PRIu64 " %" PRIu64 " %02x\n", port, push_ns, done_ns, byte);
}

void RunLog::end(uint64_t time_ns) {
    std::fprintf(events_, "end %" PRIu64 "\n", time_ns);
    std::fflush(events_);
    std::fflush(records_);
}

uint64_t UartWire::send(uint64_t push_ns, double baud) {
    free_ns_ = std::max(push_ns, free_ns_) + static_cast<uint64_t>(std::llround(BITS_A_BYTE * 1e9 / baud));
    return free_ns_;
}

}  // namespace touchdown
