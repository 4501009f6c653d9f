// SPDX-License-Identifier: Apache-2.0
#include "keep.h"

struct keep keep __attribute__((aligned(64), section(".keep")));
