// SPDX-License-Identifier: Apache-2.0
// The plugin that flies: what the camera shows, what the LiDAR measures and what
// the autopilot and the ground say comes from another process, which in turn gets
// what the firmware says. landing_core is built with sim/verilated/stand_ins.
//
// Each process waits for the other: sim/flight/board.py sends one GO, the machine runs
// to the time in it and answers with one BEEN. Integers are little endian.
//   GO    u64 run to, ns; u32 altitude_mm; i32 frame; u32 bytes to UART0; u32 bytes to UART1; the bytes; the objects
//         frame: how many objects of 64 bytes a frame has that starts now; -1 = none starts; -2 = a malformed one
//   BEEN  u32 bytes from UART0; u32 bytes from UART1; the bytes whose stop bits have ended
//
// Arguments: world=<path of a Unix socket>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/cosim/qemu_machine.h"
#include "sim/cosim/shapes_camera.h"
#include "sim/verilated/arguments.h"

namespace touchdown {
namespace {

// Nothing of what landing_core does here needs a faster clock, and each clock costs time.
constexpr uint64_t CLK_PER_US = 2;
constexpr uint64_t CLK_HZ = CLK_PER_US * 1'000'000;
// Each look at the world costs time: there is one when something is due.
constexpr uint64_t RECORD_LOOK_NS = 20'000;
constexpr uint64_t IDLE_LOOK_NS = 1'000'000;
// Bytes come in clumps of at most so many; QEMU's FIFO has room for 16.
constexpr size_t CLUMP_BYTES = 12;
constexpr int32_t NO_FRAME = -1;
constexpr int32_t MALFORMED_FRAME = -2;
constexpr size_t OBJECT_BYTES = 64;
constexpr size_t MAX_BYTES = 1 << 20;
constexpr double BITS_A_BYTE = 10.0;

ModelConfig config() {
    ModelConfig config;
    config.clk_hz = CLK_HZ;
    config.pix_hz = CLK_HZ;
    config.clk_per_us = CLK_PER_US;
    return config;
}

// The other process. When it has gone, so have we.
class World {
public:
    explicit World(const std::string& path) : socket_(socket(AF_UNIX, SOCK_STREAM, 0)) {
        sockaddr_un address = {};
        address.sun_family = AF_UNIX;
        if (path.size() >= sizeof address.sun_path) throw std::runtime_error("the path of world= is too long.");
        std::strcpy(address.sun_path, path.c_str());
        if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
            throw std::runtime_error("nobody listens at world=" + path + ".");
    }

    std::vector<uint8_t> take(size_t count) {
        if (count > MAX_BYTES) throw std::runtime_error("the world says more than it may.");
        std::vector<uint8_t> bytes(count);
        for (size_t done = 0; done < count;) {
            const ssize_t got = recv(socket_, bytes.data() + done, count - done, 0);
            if (got <= 0) leave(0);
            done += static_cast<size_t>(got);
        }
        return bytes;
    }

    template <typename T>
    T take_value() {
        T value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }

    void give(const std::vector<uint8_t>& bytes) {
        for (size_t done = 0; done < bytes.size();) {
            const ssize_t sent = send(socket_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
            if (sent <= 0) leave(0);
            done += static_cast<size_t>(sent);
        }
    }

private:
    int socket_;
};

struct ShapesCameraHolder {
    ShapesCamera camera{CLK_PER_US};
};

class FlightMachine final : private ShapesCameraHolder, public Machine {
public:
    explicit FlightMachine(const Arguments& arguments) : Machine(config(), camera), world_(arguments.text("world")) {}

    void uart(unsigned port, uint64_t, uint64_t done_ns, uint8_t byte) override {
        sent_[port].push_back({done_ns, byte});
    }
    void last_pixel(uint32_t, uint64_t) override { record_due_ = true; }
    void record(uint64_t, uint64_t) override { record_due_ = false; }

private:
    struct Byte {
        uint64_t time_ns;
        uint8_t value;
    };

    uint64_t frame_size(uint64_t written, unsigned) const override { return written; }

    uint64_t tick(uint64_t now_ns) override {
        for (unsigned port = 0; port < 2; ++port) receive(port, now_ns);
        if (now_ns >= until_ns_) {
            if (until_ns_ != 0) tell(now_ns);
            until_ns_ = now_ns + 1;
            hear(now_ns);
        }
        uint64_t next_ns = std::min(until_ns_, now_ns + (record_due_ ? RECORD_LOOK_NS : IDLE_LOOK_NS));
        if (frame_end_ns_ > now_ns) next_ns = std::min(next_ns, frame_end_ns_);
        for (const std::deque<Byte>& line : received_) {
            if (!line.empty()) next_ns = std::min(next_ns, line[std::min(line.size(), CLUMP_BYTES) - 1].time_ns);
        }
        return std::max(next_ns, now_ns + RECORD_LOOK_NS);
    }

    // Bytes go on at the rate of the line.
    void receive(unsigned port, uint64_t now_ns) {
        std::deque<Byte>& line = received_[port];
        while (!line.empty() && line.front().time_ns <= now_ns) {
            void* wire = qemu_chr_find(port == 0 ? "serial0" : "serial1");
            if (qemu_chr_be_can_write(wire) == 0) return;
            qemu_chr_be_write(wire, &line.front().value, 1);
            line.pop_front();
        }
    }

    void tell(uint64_t now_ns) {
        std::vector<uint8_t> answer(2 * sizeof(uint32_t));
        for (unsigned port = 0; port < 2; ++port) {
            uint32_t count = 0;
            for (; !sent_[port].empty() && sent_[port].front().time_ns <= now_ns; ++count) {
                answer.push_back(sent_[port].front().value);
                sent_[port].pop_front();
            }
            std::memcpy(answer.data() + port * sizeof count, &count, sizeof count);
        }
        world_.give(answer);
    }

    void hear(uint64_t now_ns) {
        until_ns_ = world_.take_value<uint64_t>();
        if (until_ns_ <= now_ns) throw std::runtime_error("the world goes back in time.");
        camera.set_altitude_mm(world_.take_value<uint32_t>());
        const auto frame = world_.take_value<int32_t>();
        const auto to_0 = world_.take_value<uint32_t>();
        const auto to_1 = world_.take_value<uint32_t>();
        say(0, world_.take(to_0), now_ns);
        say(1, world_.take(to_1), now_ns);
        if (frame == MALFORMED_FRAME) {
            camera.show_malformed();
        } else if (frame != NO_FRAME) {
            const uint64_t scan_us = camera.show(world_.take(static_cast<uint32_t>(frame) * OBJECT_BYTES));
            frame_end_ns_ = now_ns + scan_us * 1000 + RECORD_LOOK_NS;
        }
    }

    void say(unsigned port, const std::vector<uint8_t>& bytes, uint64_t now_ns) {
        const auto byte_ns = static_cast<uint64_t>(BITS_A_BYTE * 1e9 / tap(port).baud());
        for (const uint8_t byte : bytes) {
            free_ns_[port] = std::max(free_ns_[port], now_ns) + byte_ns;
            received_[port].push_back({free_ns_[port], byte});
        }
    }

    World world_;
    std::deque<Byte> sent_[2];      // by the firmware, on the wire
    std::deque<Byte> received_[2];  // by the firmware, on the wire
    uint64_t free_ns_[2] = {};
    uint64_t until_ns_ = 0;
    uint64_t frame_end_ns_ = 0;
    bool record_due_ = false;
};

}  // namespace
}  // namespace touchdown

extern "C" __attribute__((visibility("default"))) int qemu_plugin_install(uint64_t, const qemu::PluginInfo*, int count,
                                                                          char** arguments) {
    touchdown::Machine::install<touchdown::FlightMachine>(touchdown::Arguments(count, arguments));
    return 0;
}
