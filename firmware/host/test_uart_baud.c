// SPDX-License-Identifier: Apache-2.0
#include <math.h>

#include "test.h"
#include "uart_baud.h"

void test_uart_baud(void)
{
    static const uint32_t bauds[] = {9600, 57600, 115200, 230400, 460800, 921600};
    static const uint32_t clocks_hz[] = {50000000, 100000000};

    for (unsigned c = 0; c < sizeof clocks_hz / sizeof clocks_hz[0]; c++) {
        for (unsigned b = 0; b < sizeof bauds / sizeof bauds[0]; b++) {
            const struct uart_divisors divisors = uart_divisors_for(clocks_hz[c], bauds[b]);
            const double actual = (double)clocks_hz[c] / (double)divisors.clock / (double)(divisors.sample + 1U);
            test_case("%u baud from %u Hz", bauds[b], clocks_hz[c]);
            CHECK(divisors.clock >= 1U && divisors.clock <= 65535U);
            CHECK(divisors.sample >= 4U && divisors.sample <= 255U);
            NEAR(actual, bauds[b], 0.01 * bauds[b]); // 8N1 tolerates 2 %
        }
    }
}
