// SPDX-License-Identifier: Apache-2.0
#include <math.h>
#include <string.h>

#include "parameters.h"
#include "test.h"

static struct parameters parameters;

static void test_names(void)
{
    test_case("each parameter is found by its name and is within its limits");
    parameters_init(&parameters);
    for (size_t i = 0; i < PARAMETERS_COUNT; i++) {
        CHECK(strlen(parameters_name(i)) <= 16U);
        CHECK(parameters_find(parameters_name(i)) == (int)i);
        CHECK(parameters_set(&parameters, i, parameters_get(&parameters, i)) == 0);
    }
    CHECK(parameters_name(PARAMETERS_COUNT) == NULL);
    CHECK(parameters_find("TD_NOTHING") == PARAMETERS_E_NAME);
    CHECK(parameters_find("") == PARAMETERS_E_NAME);
    CHECK(parameters_get(&parameters, PARAMETERS_COUNT) == 0.0F);
}

static void test_limits(void)
{
    const float wrong[] = {NAN, INFINITY, -INFINITY, 1.0e9F, -1.0e9F};

    test_case("what is beyond the limits changes nothing");
    for (size_t i = 0; i < PARAMETERS_COUNT; i++) {
        const float before = parameters_get(&parameters, i);

        for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
            CHECK(parameters_set(&parameters, i, wrong[k]) == PARAMETERS_E_RANGE);
            CHECK(parameters_get(&parameters, i) == before);
        }
    }
    CHECK(parameters_set(&parameters, PARAMETERS_COUNT, 1.0F) == PARAMETERS_E_NAME);
}

static void test_stored(void)
{
    uint8_t bytes[PARAMETERS_STORED_BYTES];
    struct parameters other;
    const int speed = parameters_find("TD_SPEED");

    test_case("what was stored comes back");
    parameters_init(&parameters);
    CHECK(parameters_set(&parameters, (size_t)speed, 0.3F) == 0);
    parameters_store(&parameters, bytes);
    parameters_init(&other);
    CHECK(parameters_load(&other, bytes, sizeof bytes) == 0);
    CHECK(memcmp(&other, &parameters, sizeof other) == 0);
    test_case("a flipped bit anywhere that counts leaves all as it was");
    for (size_t bit = 0; bit < 8U * sizeof bytes; bit++) {
        if (bit / 8U >= 12U && bit / 8U < 16U) {
            continue; // reserved
        }
        bytes[bit / 8U] ^= (uint8_t)(1U << bit % 8U);
        parameters_init(&other);
        CHECK(parameters_load(&other, bytes, sizeof bytes) == PARAMETERS_E_STORED);
        CHECK(other.speed_m_s == 0.5F);
        bytes[bit / 8U] ^= (uint8_t)(1U << bit % 8U);
    }
    CHECK(parameters_load(&other, bytes, sizeof bytes - 1U) == PARAMETERS_E_STORED);
    test_case("a stored value beyond its limits is left out, the others count");
    parameters.descent_m_s = 9.0F;
    parameters_store(&parameters, bytes);
    parameters_init(&other);
    CHECK(parameters_load(&other, bytes, sizeof bytes) == 0);
    CHECK(other.speed_m_s == 0.3F);
    CHECK(other.descent_m_s == 0.25F);
}

void test_parameters(void)
{
    test_names();
    test_limits();
    test_stored();
}
