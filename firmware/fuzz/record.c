// SPDX-License-Identifier: Apache-2.0
// Records from the ring into the application. The hardware writes the next record into the
// buffer while it is read; what comes out of the copy must be one record, whole. Then
// all that is detected and sent must be finite.
#include <stdatomic.h>

static void hardware_writes(void);

// Each fence of the copy lets the hardware go on; between the fences no word is read twice.
#undef atomic_thread_fence
#define atomic_thread_fence(order) hardware_writes()
#define record_copy_from_ring copy_while_hardware_writes
#define record_check check_of_copy
#include "../core/record.c"
#undef record_check

#include <stdlib.h>

#include "app.h"
#include "records.h"
#include "sent.h"
#include "target.h"

#define WORDS (sizeof(struct landing_record) / sizeof(uint32_t))
#define ROUNDS_MAX 10
#define FENCES 2U
#define LEAST_AREA_PX 30U
#define WORK_MOST (3 * WORK_A_FRAME / 2)
#define MOST_AREA_PX 150U

// In this order the hardware fills a buffer.
enum stage { UNTOUCHED, NUMBER_ZEROED, HEADER_WRITTEN, OBJECTS_WRITTEN, COMPLETE };

static struct app app;
static struct sent sent;
static struct landing_record record; // in the ring
static struct landing_record next;   // that the hardware is about to write
static struct landing_record copy;
static uint32_t ring[WORDS];
static enum stage stage;
static enum stage until[FENCES]; // how far it gets by each fence
static size_t fences;

static void write_stage(enum stage what)
{
    switch (what) {
    case UNTOUCHED:
        break;
    case NUMBER_ZEROED:
        ring[FRAME_NUMBER_WORD] = 0U;
        break;
    case HEADER_WRITTEN:
        memcpy(ring, &next, FRAME_NUMBER_WORD * WORD_BYTES);
        break;
    case OBJECTS_WRITTEN:
        memcpy(ring + HEADER_WORDS, next.objects, records_size(&next) - sizeof next.header);
        break;
    case COMPLETE:
        ring[FRAME_NUMBER_WORD] = next.header.frame_number;
        break;
    }
}

static void write_until(enum stage last)
{
    while (stage < last) {
        stage++;
        write_stage(stage);
    }
}

static void hardware_writes(void)
{
    DEMAND(fences < FENCES);
    write_until(until[fences]);
    fences++;
}

// Through the ring; returns what the copy returned.
static int take(struct input *input)
{
    const uint8_t how_far = input_u8(input);
    const uint8_t other = input_u8(input);
    const uint32_t number = record.header.frame_number + (other >= 250U ? other - 250U : 0U);

    memcpy(ring, &record, records_size(&record));
    next.header.frame_number = record.header.frame_number + LANDING_RING_BUFFERS;
    // Mostly it does not touch the buffer.
    until[0] = how_far < 128U ? UNTOUCHED : (enum stage)(how_far % 5U);
    until[1] = how_far < 128U ? UNTOUCHED : (enum stage)(how_far / 5U % 5U);
    stage = UNTOUCHED;
    fences = 0U;
    // What the fences do not see of the copy are numbers of the frame that were there before.
    write_until(how_far >= 128U && other >= 128U ? (enum stage)(other % 5U) : UNTOUCHED);
    const enum stage first = stage;
    const int result = copy_while_hardware_writes(&copy, ring, number);

    // Whichever record was asked for was there from the first read to the last, or it is torn.
    const bool still = stage == first && (first == UNTOUCHED || first == COMPLETE);
    const struct landing_record *whole = first == COMPLETE ? &next : &record;
    const bool asked = number != 0U && whole->header.frame_number == number;
    if (still && asked) {
        DEMAND(result == (whole->header.object_count > LANDING_RECORD_MAX_OBJECTS ? RECORD_E_COUNT
                                                                                  : (int)records_size(whole)));
    } else {
        DEMAND(result == RECORD_E_TORN);
    }
    DEMAND(result < 0 || memcmp(&copy, whole, (size_t)result) == 0);
    return result;
}

static void check_state(void)
{
    DEMAND(app_min_area_px(&app) >= LEAST_AREA_PX && app_min_area_px(&app) <= MOST_AREA_PX);
    DEMAND(app.scratch.work >= 0 && app.scratch.work <= WORK_MOST);
    DEMAND((app_threshold_register(&app) >> LANDING_REG_THRESHOLD_FACTOR_SHIFT & 0xFFU) >= 72U);
}

static void give(size_t size, uint64_t now_us)
{
    const uint32_t before = sent.count[APP_LINK_GROUND];
    const uint32_t before_autopilot = sent.count[APP_LINK_AUTOPILOT];
    const int error = app_on_record(&app, &copy, size, now_us);

    // One array a good frame, and at most one target; nothing for a bad one.
    DEMAND(sent.count[APP_LINK_GROUND] - before == (error == 0 ? 1U : 0U));
    DEMAND(sent.count[APP_LINK_AUTOPILOT] - before_autopilot <= (error == 0 ? 1U : 0U));
    check_state();
}

// The input is the record, in memory that ends where it does.
static void give_raw(struct input *input)
{
    const size_t size = input->left < sizeof record ? input->left : sizeof record;
    struct landing_record *raw = malloc(size != 0U ? size : 1U);

    DEMAND(raw != NULL);
    (void)input_take(input, raw, size);
    if (check_of_copy(raw, size) == 0) {
        memcpy(&copy, raw, size);
        give(size, 0U);
    }
    free(raw);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct input input = {.bytes = bytes, .left = size};
    const struct app_port port = {.write = sent_write, .context = &sent};
    const uint8_t what = input_u8(&input);

    sent_init(&sent, &app.flight);
    app_init(&app, &port, 0U, NULL);
    records_clear(&record);
    records_clear(&next);
    if (what >= 250U) {
        give_raw(&input);
        return 0;
    }
    if (what >= 128U) {
        app.detect_options = what % (DETECT_ALL + 1U);
    }
    for (int round = 0; round < ROUNDS_MAX && input.left != 0U; round++) {
        const uint64_t now_us = 20000U * (uint64_t)round;
        const uint8_t attitude = input_u8(&input);

        if (attitude >= 200U) {
            const double roll_rad = (double)input_float(&input);
            attitude_set(&app.attitude, roll_rad, (double)input_float(&input), now_us, now_us);
        } else if (attitude >= 100U) {
            attitude_set(&app.attitude, (double)(attitude - 150) / 100.0, 0.0, now_us, now_us);
        }
        if (attitude % 4U == 3U) {
            next = record;
        }
        records_next(&input, &record);
        const int copied = take(&input);
        if (copied > 0) {
            give((size_t)copied, now_us);
        }
    }
    return 0;
}
