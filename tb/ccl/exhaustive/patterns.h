// SPDX-License-Identifier: Apache-2.0
// Images that are hard for a labeller.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "flood.h"

using Rng = std::mt19937_64;

inline Image random_image(Rng &rng, int width, int height, int percent) {
    Image image(width, height);
    for (auto &pixel : image.pixels) pixel = rng() % 100 < static_cast<unsigned>(percent);
    return image;
}

// Bit i of `code` is pixel i.
inline Image coded_image(int width, int height, uint64_t code) {
    Image image(width, height);
    for (auto &pixel : image.pixels) {
        pixel = code & 1;
        code >>= 1;
    }
    return image;
}

// A wall of 1 pixel that winds to the centre, 1 pixel of free way between its turns.
inline Image spiral(int width, int height) {
    Image image(width, height);
    int left = 0, top = 0, right = width - 1, bottom = height - 1, x = 0, y = 0;
    while (true) {
        for (; x <= right; x++) image.at(x, y) = 1;
        x = right;
        top += 2;
        if (top > bottom) break;
        for (; y <= bottom; y++) image.at(x, y) = 1;
        y = bottom;
        right -= 2;
        if (right < left) break;
        for (; x >= left; x--) image.at(x, y) = 1;
        x = left;
        bottom -= 2;
        if (bottom < top) break;
        for (; y >= top; y--) image.at(x, y) = 1;
        y = top;
        left += 2;
        if (left > right) break;
    }
    return image;
}

// Names of the images of `structured`.
inline const std::vector<std::string> &structured_names() {
    static const std::vector<std::string> names = {
        "black",      "white",      "checkerboard", "anti-checkerboard", "dots",        "columns",   "lines",  "comb down",
        "comb up",    "double comb", "spiral",      "nested U",          "nested caps", "nested V",  "diamonds", "stairs",
        "zigzag",     "frames",     "interleaved combs", "hooks"};
    return names;
}

inline Image structured(const std::string &name, int width, int height) {
    if (name == "spiral") return spiral(width, height);
    Image image(width, height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const int mx = std::min(x, width - 1 - x), my = std::min(y, height - 1 - y);
            bool on = false;
            if (name == "white") on = true;
            if (name == "checkerboard") on = (x + y) % 2 == 0;
            if (name == "anti-checkerboard") on = (x + y) % 2 == 1;
            if (name == "dots") on = x % 2 == 0 && y % 2 == 0;
            if (name == "columns") on = x % 2 == 0;
            if (name == "lines") on = y % 2 == 0;
            if (name == "comb down") on = x % 2 == 0 || y == 0;
            if (name == "comb up") on = x % 2 == 0 || y == height - 1;
            if (name == "double comb") on = x % 2 == 0 || y == 0 || y == height - 1;
            // Classes that stay open side by side and close from the inside to the outside, or the other way round.
            if (name == "nested U") on = mx % 2 == 0 && mx <= height - 1 - y ? true : (height - 1 - y) % 2 == 0 && mx >= height - 1 - y;
            if (name == "nested caps") on = mx % 2 == 0 && mx <= y ? true : y % 2 == 0 && mx >= y;
            if (name == "nested V") on = (x + 2 * y) % 4 == 0 || (x + 4 * height - 2 * y) % 4 == 1;
            if (name == "diamonds") on = (x % 8 + y % 8) % 8 == 3 || (x % 8 + 8 - y % 8) % 8 == 4;
            if (name == "stairs") on = (x + y) % 3 == 0;
            if (name == "zigzag") on = (y / 2 % 2 ? x + y % 2 : x - y % 2 + 1) % 3 == 0;
            if (name == "frames") on = std::min(mx, my) % 2 == 0;
            if (name == "interleaved combs") on = x % 4 == 0 ? y < height - 1 : x % 4 == 2 ? y > 0 : (y == 0 && x % 4) ? false : y == 0;
            if (name == "hooks") on = (x % 6 == 0 && y % 6 < 5) || (x % 6 == 2 && y % 6 < 3) || (x % 6 < 3 && y % 6 == 4);
            image.at(x, y) = on;
        }
    return image;
}
