// SPDX-License-Identifier: Apache-2.0
// The generated C header of registers and record, for C++.
#pragma once

#define _Static_assert static_assert
#include "firmware/generated/landing_regs.h"
#undef _Static_assert
