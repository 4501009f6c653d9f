// SPDX-License-Identifier: Apache-2.0
// Parameters set by index and by PARAM_SET, stored, and loaded from damaged blocks. No
// value ever leaves its limits, and what was stored comes back.
#include "parameters.h"

#include <math.h>
#include <string.h>

#include <common/mavlink.h>

#include "ground.h"
#include "input.h"
#include "sent.h"
#include "target.h"

static struct flight flight;
static struct links links;
static struct sent sent;

static bool same(const struct parameters *a, const struct parameters *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

static void set(struct input *input)
{
    const struct parameters before = flight.parameters;
    const size_t index = input_u8(input) % (PARAMETERS_COUNT + 2U);
    const float value = input_float(input);
    const int error = parameters_set(&flight.parameters, index, value);

    DEMAND(error == 0 ? parameters_get(&flight.parameters, index) == value : same(&before, &flight.parameters));
    DEMAND(isfinite(value) || error != 0);
}

static void ask(struct input *input)
{
    static const enum mavlink_in_kind kinds[] = {MAVLINK_IN_PARAM_SET, MAVLINK_IN_PARAM_READ, MAVLINK_IN_PARAM_LIST};
    const uint8_t how = input_u8(input);
    struct mavlink_in_message message = {.kind = kinds[how % 3U]};
    struct mavlink_in_param *param = &message.as.param;
    const uint8_t name = input_u8(input);

    param->index = (how & 0x10U) != 0U ? (int16_t)input_u16(input) : -1;
    param->type = (how & 0x20U) != 0U ? input_u8(input) : (uint8_t)MAV_PARAM_TYPE_REAL32;
    param->value = input_float(input);
    if (name < PARAMETERS_COUNT) {
        (void)strncpy(param->name, parameters_name(name), MAVLINK_IN_PARAM_NAME_CHARS);
    } else {
        (void)input_take(input, param->name, MAVLINK_IN_PARAM_NAME_CHARS);
    }
    ground_on_parameter(&flight, &links, APP_LINK_GROUND, &message);
}

// Whether a block is taken or not, `parameters` must hold what it may.
static void load(const uint8_t *bytes, size_t size)
{
    const struct parameters before = flight.parameters;
    const int error = parameters_load(&flight.parameters, bytes, size);

    DEMAND(error == 0 || same(&before, &flight.parameters));
}

static void store(struct input *input)
{
    uint8_t bytes[PARAMETERS_STORED_BYTES];
    struct parameters loaded;

    parameters_store(&flight.parameters, bytes);
    parameters_init(&loaded);
    DEMAND(parameters_load(&loaded, bytes, sizeof bytes) == 0 && same(&loaded, &flight.parameters));
    bytes[input_u8(input) % sizeof bytes] ^= input_u8(input);
    load(bytes, sizeof bytes - input_u8(input) % 2U);
}

// A block with the right checksum around values that may be anything.
static void load_values(struct input *input)
{
    uint8_t bytes[PARAMETERS_STORED_BYTES];
    struct parameters values;

    (void)input_take(input, &values, sizeof values);
    parameters_store(&values, bytes);
    load(bytes, sizeof bytes);
}

static void load_noise(struct input *input)
{
    uint8_t bytes[PARAMETERS_STORED_BYTES + 4U];
    const size_t size = input_u8(input) % sizeof bytes;

    load(bytes, input_take(input, bytes, size));
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct input input = {.bytes = bytes, .left = size};
    const struct app_port port = {.write = sent_write, .context = &sent};

    sent_init(&sent, &flight);
    links_init(&links, &port);
    flight_init(&flight, rates_of(RATES_AUTOPILOT, 0U), 0U);
    while (input.left != 0U) {
        const uint8_t what = input_u8(&input);

        if (what % 8U < 2U) {
            set(&input);
        } else if (what % 8U < 4U) {
            ask(&input);
        } else if (what % 8U == 4U) {
            store(&input);
        } else if (what % 8U == 5U) {
            load_values(&input);
        } else if (what % 8U == 6U) {
            load_noise(&input);
        } else {
            ground_tick(&flight, &links, flight.next_said_us + input_u8(&input));
        }
        sent_parameters_are_sane(&flight.parameters);
    }
    return 0;
}
