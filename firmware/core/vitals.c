// SPDX-License-Identifier: Apache-2.0
#include "vitals.h"

#include <string.h>

void vitals_init(struct vitals *vitals, uint64_t now_us)
{
    memset(vitals, 0, sizeof *vitals);
    vitals->round_us = now_us;
    vitals->fed_us = now_us;
    vitals->since_us = now_us;
    for (uint32_t i = 0; i < VITALS_WIRES; i++) {
        vitals->wires[i].moved_us = now_us;
    }
}

static bool wires_move(struct vitals *vitals, const struct vitals_signs *signs)
{
    bool all = true;

    for (uint32_t i = 0; i < VITALS_WIRES; i++) {
        if (!signs->wires[i].waiting || signs->wires[i].sent != vitals->wires[i].sent) {
            vitals->wires[i].moved_us = signs->now_us;
        }
        vitals->wires[i].sent = signs->wires[i].sent;
        all = all && signs->now_us <= vitals->wires[i].moved_us + VITALS_WIRE_MAX_US;
    }
    return all;
}

bool vitals_may_feed(struct vitals *vitals, const struct vitals_signs *signs)
{
    const bool in_time = signs->now_us <= vitals->round_us + VITALS_ROUND_MAX_US;
    const bool wires_well = wires_move(vitals, signs);

    vitals->round_us = signs->now_us;
    // Of clock and interrupts each could stand still while the loop goes round on the other.
    if (!in_time || !wires_well || signs->now_us <= vitals->fed_us || signs->ticks == vitals->fed_ticks) {
        return false;
    }
    vitals->fed_us = signs->now_us;
    vitals->fed_ticks = signs->ticks;
    return true;
}

void vitals_round(struct vitals *vitals, uint64_t woke_us, uint64_t sleeps_us)
{
    vitals->busy_us += sleeps_us - woke_us;
}

void vitals_frame(struct vitals *vitals, uint64_t from_us, uint64_t to_us)
{
    const uint64_t took_us = to_us - from_us;

    if (took_us > vitals->frame_worst_us) {
        vitals->frame_worst_us = took_us < UINT32_MAX ? (uint32_t)took_us : UINT32_MAX;
    }
}

uint32_t vitals_busy_permille(struct vitals *vitals, uint64_t now_us)
{
    const uint64_t passed_us = now_us - vitals->since_us;
    const uint32_t permille = passed_us == 0U ? 0U : (uint32_t)(vitals->busy_us * 1000U / passed_us);

    vitals->since_us = now_us;
    vitals->busy_us = 0U;
    return permille;
}
