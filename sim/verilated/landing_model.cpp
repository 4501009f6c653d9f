// SPDX-License-Identifier: Apache-2.0
#include "landing_model.h"

#include <verilated.h>

#include <cstdio>
#include <numeric>
#include <stdexcept>

#include "Vlanding_core.h"
#include "Vlanding_core___024root.h"
#include "landing_layout.h"

namespace touchdown {

namespace {
constexpr uint64_t NS_PER_S = 1'000'000'000;
constexpr uint64_t RESET_CLOCKS = 16;
constexpr uint64_t BUS_TIMEOUT_CLOCKS = 1000;

// The CPU takes any other answer as a data abort.
void must_be_okay(uint8_t response, const char* access, uint32_t address) {
    if (response == 0) return;
    char text[96];
    std::snprintf(text, sizeof text, "landing_core refuses the CPU's %s at register offset 0x%x: a data abort on the board.",
                  access, static_cast<unsigned>(address));
    throw std::runtime_error(text);
}
}  // namespace

LandingModel::LandingModel(const ModelConfig& config, Camera& camera, Board& board)
    : config_(config),
      camera_(camera),
      board_(board),
      lidar_(config.clk_per_us),
      memory_(board, config.memory),
      context_(std::make_unique<VerilatedContext>()),
      top_(std::make_unique<Vlanding_core>(context_.get())),
      units_per_s_(std::lcm(config.clk_hz, config.pix_hz)),
      clk_period_(units_per_s_ / config.clk_hz),
      pix_period_(units_per_s_ / config.pix_hz),
      next_clk_(clk_period_),
      next_pix_(pix_period_) {
    top_->rst = 1;
    for (uint64_t i = 0; i < RESET_CLOCKS; ++i) wait_for([] { return true; });
    top_->rst = 0;
    settled_ = false;
}

LandingModel::~LandingModel() { top_->final(); }

// Split so that no product exceeds 64 bits in any run of less than years.
uint64_t LandingModel::now_ns() const {
    return now_ / units_per_s_ * NS_PER_S + static_cast<uint64_t>(static_cast<unsigned __int128>(now_ % units_per_s_) *
                                                                  NS_PER_S / units_per_s_);
}

void LandingModel::advance_to(uint64_t time_ns) {
    const auto limit = static_cast<uint64_t>(static_cast<unsigned __int128>(time_ns) * units_per_s_ / NS_PER_S);
    while (std::min(next_clk_, next_pix_) <= limit) step();
}

// One edge, or one of each clock where they coincide. A clock falls together with
// the next edge of the other one; it falls on its own only where it must, because
// every evaluation costs time.
void LandingModel::step() {
    const bool clk_edge = next_clk_ <= next_pix_;
    const bool pix_edge = next_pix_ <= next_clk_;
    now_ = clk_edge ? next_clk_ : next_pix_;
    if ((clk_edge && (top_->clk || !settled_)) || (pix_edge && top_->pix_clk)) {
        top_->clk = 0;
        top_->pix_clk = 0;
        top_->eval();
    }
    if (clk_edge) clk_sample();
    top_->clk = clk_edge;
    top_->pix_clk = pix_edge;
    top_->eval();
    settled_ = true;
    if (pix_edge) {
        pix_drive();
        next_pix_ += pix_period_;
    }
    if (clk_edge) {
        clk_drive();
        next_clk_ += clk_period_;
        ++clocks_;
    }
}

// What every clocked receiver sees at this edge of clk: the values before it.
void LandingModel::clk_sample() {
    cpu_ = {top_->s_axil_awvalid && top_->s_axil_awready,
            top_->s_axil_wvalid && top_->s_axil_wready,
            top_->s_axil_bvalid && top_->s_axil_bready,
            top_->s_axil_arvalid && top_->s_axil_arready,
            top_->s_axil_rvalid && top_->s_axil_rready,
            top_->s_axil_rdata,
            top_->s_axil_rresp,
            top_->s_axil_bresp};
    master_ = {static_cast<bool>(top_->m_axi_awvalid),
               top_->m_axi_awaddr,
               top_->m_axi_awlen,
               top_->m_axi_awsize,
               top_->m_axi_awburst,
               static_cast<bool>(top_->m_axi_wvalid),
               top_->m_axi_wdata,
               top_->m_axi_wstrb,
               static_cast<bool>(top_->m_axi_wlast),
               static_cast<bool>(top_->m_axi_bready)};
    if (taps_ != nullptr) taps_->sample(*top_->rootp);
}

// What changes after this edge of clk.
void LandingModel::clk_drive() {
    const AxiMemory::ToMaster& slave = memory_.clock(master_);
    const bool lidar = lidar_.next(top_->lidar_drive_low, camera_.altitude_mm());
    if (top_->m_axi_awready != slave.awready || top_->m_axi_wready != slave.wready ||
        top_->m_axi_bvalid != slave.bvalid || top_->lidar_in != lidar) {
        top_->m_axi_awready = slave.awready;
        top_->m_axi_wready = slave.wready;
        top_->m_axi_bvalid = slave.bvalid;
        top_->lidar_in = lidar;
        settled_ = false;
    }
    const bool irq = top_->irq;
    if (irq != irq_) {
        irq_ = irq;
        board_.irq(irq, now_ns());
    }
    const Vlanding_core___024root& root = *top_->rootp;
    if (root.landing_core__DOT__frame_done)
        board_.record(root.landing_core__DOT__ring_base + root.landing_core__DOT__ring_head * LANDING_RING_STRIDE_BYTES, now_ns());
    if (!camera_started_) start_camera();
}

// The camera's first frame waits for the firmware, as a pilot does: CTRL.ENABLE,
// and a LiDAR reading if one comes.
void LandingModel::start_camera() {
    const Vlanding_core___024root& root = *top_->rootp;
    if (!root.landing_core__DOT__ctrl_enable) return;
    if (camera_deadline_ns_ == 0) camera_deadline_ns_ = now_ns() + config_.camera_wait_ns;
    if (!root.landing_core__DOT__lidar_valid && now_ns() < camera_deadline_ns_) return;
    camera_started_ = true;
    camera_.start();
}

void LandingModel::pix_drive() {
    if (first_pixel_) board_.first_pixel(camera_.index(), now_ns());
    if (last_pixel_) board_.last_pixel(camera_.index(), now_ns());
    const VideoSample sample = camera_.next(first_pixel_, last_pixel_);
    if (sample.de) top_->vid_data = sample.rgb;
    top_->vid_de = sample.de;
    top_->vid_hsync = sample.hsync;
    top_->vid_vsync = sample.vsync;
}

// Steps until `done` holds just after an edge of clk.
template <typename Done>
void LandingModel::wait_for(Done done) {
    for (const uint64_t start = clocks_; clocks_ - start < BUS_TIMEOUT_CLOCKS;) {
        const uint64_t before = clocks_;
        step();
        if (clocks_ != before && done()) return;
    }
    throw std::runtime_error("s_axil: landing_core does not answer the CPU.");
}

uint32_t LandingModel::read(uint32_t address) {
    top_->s_axil_araddr = address & 0xFFF;
    top_->s_axil_arvalid = 1;
    top_->s_axil_rready = 1;
    settled_ = false;
    wait_for([this] { return cpu_.ar; });
    top_->s_axil_arvalid = 0;
    settled_ = false;
    if (!cpu_.r) wait_for([this] { return cpu_.r; });
    must_be_okay(cpu_.rresp, "read", address);
    const uint32_t value = cpu_.rdata;
    top_->s_axil_rready = 0;
    settled_ = false;
    return value;
}

void LandingModel::write(uint32_t address, uint32_t value, uint32_t strobes) {
    top_->s_axil_awaddr = address & 0xFFF;
    top_->s_axil_awvalid = 1;
    top_->s_axil_wdata = value;
    top_->s_axil_wstrb = static_cast<uint8_t>(strobes);
    top_->s_axil_wvalid = 1;
    top_->s_axil_bready = 1;
    settled_ = false;
    wait_for([this] {
        if (cpu_.aw) top_->s_axil_awvalid = 0;
        if (cpu_.w) top_->s_axil_wvalid = 0;
        settled_ = false;
        return cpu_.b;
    });
    must_be_okay(cpu_.bresp, "write", address);
    top_->s_axil_bready = 0;
    settled_ = false;
}

}  // namespace touchdown
