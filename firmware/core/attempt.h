// SPDX-License-Identifier: Apache-2.0
// One hypothesis, fitted to the record, and whether it may be the pad.
#ifndef TOUCHDOWN_ATTEMPT_H
#define TOUCHDOWN_ATTEMPT_H

#include "reading.h"

// 0 when it may be the pad: `pad` says where. What had no time to be fitted to its end is left in `round`: this hypothesis,
// of which nothing is known yet, or the mirror image of it. Without a round it is fitted as well as there is time.
int attempt(const struct detect_context *context, const struct hypothesis *hypothesis, struct search_round *round,
            struct pad_estimate *pad);

#endif
