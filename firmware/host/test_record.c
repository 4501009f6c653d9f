// SPDX-License-Identifier: Apache-2.0
#include <math.h>
#include <string.h>

#include "detect.h"
#include "record.h"
#include "test.h"
#include "test_scene.h"

static struct landing_record good;
static struct landing_record bad;
static struct landing_record copy;
static struct detect_scratch scratch;

static size_t size_of(const struct landing_record *record)
{
    return sizeof record->header + record->header.object_count * sizeof record->objects[0];
}

static int check_bad(void)
{
    const int error = record_check(&bad, sizeof bad);

    bad = good;
    return error;
}

static void test_header(void)
{
    test_case("hostile headers");
    bad = good;
    CHECK(check_bad() == 0);
    bad.header.id_magic ^= 1U;
    CHECK(check_bad() == RECORD_E_MAGIC);
    bad.header.id_version++;
    CHECK(check_bad() == RECORD_E_MAGIC);
    bad.header.frame_number = 0U;
    CHECK(check_bad() == RECORD_E_TORN);
    bad.header.object_count = 257U;
    CHECK(check_bad() == RECORD_E_COUNT);
    bad.header.object_count = 0xFFFFFFFFU;
    CHECK(check_bad() == RECORD_E_COUNT);
    bad.header.frame_size_width = 0U;
    CHECK(check_bad() == RECORD_E_FRAME);
    bad.header.frame_size_height = 0xFFFFU;
    CHECK(check_bad() == RECORD_E_FRAME);
    CHECK(record_check(&good, 0) == RECORD_E_SIZE);
    CHECK(record_check(&good, sizeof good.header - 1U) == RECORD_E_SIZE);
    CHECK(record_check(&good, size_of(&good) - 1U) == RECORD_E_SIZE);
    CHECK(record_check(&good, size_of(&good)) == 0);
}

static void test_objects(void)
{
    struct landing_object *object = &bad.objects[2];

    test_case("hostile objects");
    object->area = 0U;
    CHECK(check_bad() == RECORD_E_OBJECT);
    object->area = 0xFFFFFFFFU;
    CHECK(check_bad() == RECORD_E_OBJECT);
    object->box_min_x = (uint16_t)(object->box_max_x + 1U);
    CHECK(check_bad() == RECORD_E_OBJECT);
    object->box_max_x = 1280U;
    CHECK(check_bad() == RECORD_E_OBJECT);
    object->box_max_y = 720U;
    CHECK(check_bad() == RECORD_E_OBJECT);
    object->sum_x = (uint64_t)object->area * object->box_max_x + 1U;
    CHECK(check_bad() == RECORD_E_OBJECT);
    object->sum_y = (uint64_t)object->area * object->box_min_y - 1U;
    CHECK(check_bad() == RECORD_E_OBJECT);
    object->sum_xx = UINT64_MAX;
    CHECK(check_bad() == RECORD_E_OBJECT);
    object->sum_yy = 0U;
    CHECK(check_bad() == RECORD_E_OBJECT);
    object->sum_xy = 1U;
    CHECK(check_bad() == RECORD_E_OBJECT);
}

static void test_copy(void)
{
    static uint32_t ring[sizeof(struct landing_record) / sizeof(uint32_t)];

    test_case("copy out of the ring");
    memcpy(ring, &good, sizeof good);
    memset(&copy, 0, sizeof copy);
    CHECK(record_copy_from_ring(&copy, ring, 1U) == (int)size_of(&good));
    CHECK(memcmp(&copy, &good, size_of(&good)) == 0);
    CHECK(record_copy_from_ring(&copy, ring, 2U) == RECORD_E_TORN); // not the frame that was announced
    ring[15] = 0U; // being written
    CHECK(record_copy_from_ring(&copy, ring, 1U) == RECORD_E_TORN);
    CHECK(record_copy_from_ring(&copy, ring, 0U) == RECORD_E_TORN);
    ring[15] = 7U;
    ring[7] = 1000U;
    CHECK(record_copy_from_ring(&copy, ring, 7U) == RECORD_E_COUNT);
}

// Random damage: whatever passes the check must go through the rest without a
// trap of the sanitizers, in bounded time, and end in finite numbers.
static void test_fuzz(void)
{
    uint32_t random = 12345U;
    int passed = 0;
    int found = 0;

    test_case("random damage");
    for (int round = 0; round < 20000; round++) {
        struct pad_estimate pad;
        bad = good;
        for (int hits = 0; hits < 1 + round % 3; hits++) {
            random = random * 1664525U + 1013904223U;
            const size_t place = (random >> 8) % size_of(&good);
            ((unsigned char *)&bad)[place] ^= (unsigned char)(1U << (random >> 5 & 7U));
        }
        if (record_check(&bad, sizeof bad) != 0) {
            continue;
        }
        passed++;
        if (detect_pad(&bad, &camera_default, &detect_no_hint, DETECT_ALL, &scratch, &pad) == 0) {
            found++;
            CHECK(pad.x_px > -1.0 && pad.x_px < 1280.0 && pad.y_px > -1.0 && pad.y_px < 720.0);
            CHECK(pad.height_m > 0.0 && pad.height_m < 100.0);
            CHECK(pad.angle_deg >= -180.0 && pad.angle_deg <= 180.0);
            CHECK(pad.doubt >= 0.0 && isfinite(pad.right_m) && isfinite(pad.forward_m) && isfinite(pad.depth_m));
        }
    }
    CHECK(passed > 1000);
    CHECK(found > 500);
}

void test_record(void)
{
    const struct scene scene = {.height_m = 0.9, .right_m = 0.1, .heading_deg = 70.0};

    scene_clear(&good);
    scene_paint_pad(&good, &scene);
    bad = good;
    test_header();
    test_objects();
    test_copy();
    test_fuzz();
}
