// SPDX-License-Identifier: Apache-2.0
// landing_core in time: its two clocks, a camera, a LiDAR, memory behind the AXI
// master and a CPU port, driven from C++.
//
// Both clocks follow an exact rational schedule from time 0; the same calls give
// the same run. Errors of the design under test (a broken protocol, a bus that
// hangs) are std::runtime_error.
#pragma once

#include <cstdint>
#include <memory>

#include "axi_memory.h"
#include "board.h"
#include "camera.h"
#include "lidar_pin.h"

class VerilatedContext;
class Vlanding_core;
class Vlanding_core___024root;

namespace touchdown {

// Somebody who looks inside.
class Taps {
public:
    virtual ~Taps() = default;

    // The values just before an edge of clk.
    virtual void sample(const Vlanding_core___024root& root) = 0;
};

struct ModelConfig {
    uint64_t clk_hz = 100'000'000;
    uint64_t pix_hz = 74'250'000;
    uint64_t clk_per_us = 100;  // as landing_core was built
    // How long the camera waits after CTRL.ENABLE for the first LiDAR reading.
    uint64_t camera_wait_ns = 60'000'000;
    AxiMemoryTiming memory;
};

class LandingModel {
public:
    LandingModel(const ModelConfig& config, Camera& camera, Board& board);
    ~LandingModel();

    void attach(Taps& taps) { taps_ = &taps; }

    // Runs until the next clock edge would lie after `time_ns`. A time that has
    // passed already does nothing.
    void advance_to(uint64_t time_ns);

    // One AXI4-Lite access from the present on; it takes the clocks that it takes.
    // An SLVERR reads 0 and loses what was written, as on the bus of the CPU.
    uint32_t read(uint32_t address);
    void write(uint32_t address, uint32_t value, uint32_t strobes = 0xF);

    uint64_t now_ns() const;
    uint64_t clocks() const { return clocks_; }  // of clk, so far
    bool irq() const { return irq_; }

private:
    void step();
    void clk_sample();
    void clk_drive();
    void pix_drive();
    void start_camera();
    template <typename Done>
    void wait_for(Done done);

    ModelConfig config_;
    Camera& camera_;
    Board& board_;
    LidarPin lidar_;
    AxiMemory memory_;
    Taps* taps_ = nullptr;

    std::unique_ptr<VerilatedContext> context_;
    std::unique_ptr<Vlanding_core> top_;

    // Time counts in units of 1 / lcm(clk_hz, pix_hz).
    uint64_t units_per_s_;
    uint64_t clk_period_;
    uint64_t pix_period_;
    uint64_t now_ = 0;
    uint64_t next_clk_;
    uint64_t next_pix_;
    uint64_t clocks_ = 0;

    bool settled_ = false;  // the model has seen its inputs as they are
    bool irq_ = false;
    bool camera_started_ = false;
    uint64_t camera_deadline_ns_ = 0;
    bool first_pixel_ = false;  // of a frame, on the wire now
    bool last_pixel_ = false;

    AxiMemory::FromMaster master_ = {};
    // Handshakes of the CPU port at the last clock edge.
    struct {
        bool aw, w, b, ar, r;
        uint32_t rdata;
        uint8_t rresp, bresp;
    } cpu_ = {};
};

}  // namespace touchdown
