// SPDX-License-Identifier: Apache-2.0
// What happened in a run, as files that sim/cosim/run.py reads.
//
// events.txt, one line each, times in nanoseconds of simulated time:
//   first <frame> <time>           first pixel of a frame on the wire
//   last <frame> <time>            last pixel of a frame on the wire
//   irq <level> <time>             the interrupt of the programmable logic changed
//   record <time>                  a record was complete in memory
//   uart <n> <push> <done> <byte>  the firmware pushed a byte; its stop bit ended
//   end <time>                     the run ended well
// records.bin holds the records in the order of their events, each as a whole
// struct landing_record with zeros behind the last object.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "sim/verilated/board.h"

namespace touchdown {

class RunLog {
public:
    // Throws std::runtime_error if a file cannot be made.
    explicit RunLog(const std::string& folder);
    ~RunLog();
    RunLog(const RunLog&) = delete;
    RunLog& operator=(const RunLog&) = delete;

    void first_pixel(uint32_t index, uint64_t time_ns);
    void last_pixel(uint32_t index, uint64_t time_ns);
    void irq(bool level, uint64_t time_ns);
    // Copies the record at `address` out of the board's memory.
    void record(Board& board, uint64_t address, uint64_t time_ns);
    void uart(unsigned port, uint64_t push_ns, uint64_t done_ns, uint8_t byte);
    void end(uint64_t time_ns);

private:
    std::FILE* events_;
    std::FILE* records_;
};

// The line behind a UART: 8 data bits, no parity, 1 stop bit, no gap between
// bytes that wait. QEMU does not pace its UARTs; this gives the time at which a
// byte would have left the board.
class UartWire {
public:
    static constexpr uint64_t BITS_A_BYTE = 10;

    // End of the stop bit of a byte pushed at `push_ns` at `baud`.
    uint64_t send(uint64_t push_ns, double baud);

private:
    uint64_t free_ns_ = 0;
};

}  // namespace touchdown
