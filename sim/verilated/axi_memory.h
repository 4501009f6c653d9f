// SPDX-License-Identifier: Apache-2.0
// The write side of an AXI4 memory: 64 bits wide, incrementing bursts.
//
// A burst reaches memory when its response is given, so nobody reads early what
// the master may not yet count on. With `random`, readiness and the delay of
// each response vary; without, the memory is always ready and answers after
// `response_clocks`.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "board.h"
#include "random.h"

namespace touchdown {

struct AxiMemoryTiming {
    uint32_t response_clocks = 20;
    bool random = false;
    uint64_t seed = 1;
};

class AxiMemory {
public:
    struct FromMaster {
        bool awvalid;
        uint32_t awaddr;
        uint32_t awlen;
        uint32_t awsize;
        uint32_t awburst;
        bool wvalid;
        uint64_t wdata;
        uint32_t wstrb;
        bool wlast;
        bool bready;
    };
    struct ToMaster {
        bool awready = false;
        bool wready = false;
        bool bvalid = false;
    };

    AxiMemory(Board& board, const AxiMemoryTiming& timing) : board_(board), timing_(timing), random_(timing.seed) {}

    // One clock: what the master showed before the edge -> what it sees after.
    // Throws std::runtime_error where the master breaks the protocol.
    const ToMaster& clock(const FromMaster& master);

private:
    struct Address {
        uint64_t address;
        uint32_t beats;
    };
    struct Beat {
        uint64_t data;
        uint32_t strobes;
        bool last;
    };
    struct Response {
        uint64_t due;
        uint64_t address;
        std::vector<Beat> beats;
    };

    void accept(const FromMaster& master);
    void match();
    void commit(const Response& response);

    Board& board_;
    AxiMemoryTiming timing_;
    Random random_;
    uint64_t now_ = 0;
    ToMaster out_;
    std::deque<Address> addresses_;
    std::vector<Beat> beats_;          // of the burst that is coming in
    std::deque<std::vector<Beat>> bursts_;  // complete, waiting for their address
    std::deque<Response> responses_;
};

}  // namespace touchdown
