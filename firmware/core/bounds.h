// SPDX-License-Identifier: Apache-2.0
// fmin and fmax in the three instructions that they are where NaN need not be asked for twice: a `value` that is NaN
// becomes the bound.
#ifndef TOUCHDOWN_BOUNDS_H
#define TOUCHDOWN_BOUNDS_H

static inline double at_least(double value, double least)
{
    return value > least ? value : least;
}

static inline double at_most(double value, double most)
{
    return value < most ? value : most;
}

#endif
