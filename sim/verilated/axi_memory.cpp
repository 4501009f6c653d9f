// SPDX-License-Identifier: Apache-2.0
#include "axi_memory.h"

#include <stdexcept>
#include <utility>

namespace touchdown {

namespace {
constexpr uint32_t BEAT_BYTES = 8;
constexpr uint32_t SIZE_8_BYTES = 3;
constexpr uint32_t BURST_INCR = 1;
constexpr uint32_t AXI3_MAX_BEATS = 16;
constexpr uint64_t PAGE_BYTES = 4096;
constexpr uint32_t RANDOM_MAX_DELAY = 100;
}  // namespace

void AxiMemory::accept(const FromMaster& master) {
    if (master.awvalid && out_.awready) {
        const uint32_t beats = master.awlen + 1;
        const uint64_t last = master.awaddr + uint64_t{beats} * BEAT_BYTES - 1;
        if (master.awsize != SIZE_8_BYTES || (beats > 1 && master.awburst != BURST_INCR))
            throw std::runtime_error("m_axi: only incrementing bursts of 8-byte beats are allowed.");
        if (beats > AXI3_MAX_BEATS) throw std::runtime_error("m_axi: a burst is longer than 16 beats.");
        if (master.awaddr % BEAT_BYTES != 0) throw std::runtime_error("m_axi: a burst is not aligned to 8 bytes.");
        if (master.awaddr / PAGE_BYTES != last / PAGE_BYTES)
            throw std::runtime_error("m_axi: a burst crosses a 4 KiB boundary.");
        addresses_.push_back({master.awaddr, beats});
    }
    if (master.wvalid && out_.wready) {
        beats_.push_back({master.wdata, master.wstrb, master.wlast});
        if (master.wlast) bursts_.push_back(std::exchange(beats_, {}));
    }
}

void AxiMemory::match() {
    while (!addresses_.empty() && !bursts_.empty()) {
        const Address address = addresses_.front();
        if (bursts_.front().size() != address.beats)
            throw std::runtime_error("m_axi: wlast does not agree with awlen.");
        const uint64_t delay = timing_.random ? 1 + random_.below(RANDOM_MAX_DELAY) : timing_.response_clocks;
        responses_.push_back({now_ + delay, address.address, std::move(bursts_.front())});
        addresses_.pop_front();
        bursts_.pop_front();
    }
}

void AxiMemory::commit(const Response& response) {
    uint64_t address = response.address;
    for (const Beat& beat : response.beats) {
        uint8_t bytes[BEAT_BYTES];
        for (uint32_t i = 0; i < BEAT_BYTES; ++i) bytes[i] = static_cast<uint8_t>(beat.data >> (8 * i));
        for (uint32_t i = 0; i < BEAT_BYTES;) {
            uint32_t end = i;
            while (end < BEAT_BYTES && (beat.strobes >> end & 1) != 0) ++end;
            if (end != i) board_.write_memory(address + i, bytes + i, end - i);
            i = end + 1;
        }
        address += BEAT_BYTES;
    }
}

const AxiMemory::ToMaster& AxiMemory::clock(const FromMaster& master) {
    ++now_;
    if (master.awvalid || master.wvalid) {
        accept(master);
        match();
    }
    if (out_.bvalid && master.bready) out_.bvalid = false;
    if (!out_.bvalid && !responses_.empty() && responses_.front().due <= now_) {
        commit(responses_.front());
        responses_.pop_front();
        out_.bvalid = true;
    }
    out_.awready = !timing_.random || random_.below(4) != 0;
    out_.wready = !timing_.random || random_.below(4) != 0;
    return out_;
}

}  // namespace touchdown
