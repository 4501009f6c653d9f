// SPDX-License-Identifier: Apache-2.0
// Reference for ccl in C++: flood fill. Shares nothing with the RTL nor with golden/ccl.py.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

struct Image {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> pixels;  // 0 or 1, raster order

    Image() = default;
    Image(int w, int h) : width(w), height(h), pixels(static_cast<size_t>(w) * h, 0) {}
    uint8_t &at(int x, int y) { return pixels[static_cast<size_t>(y) * width + x]; }
    uint8_t at(int x, int y) const { return pixels[static_cast<size_t>(y) * width + x]; }
};

struct Object {
    uint64_t area = 0;
    uint64_t min_x = ~0ull, min_y = ~0ull, max_x = 0, max_y = 0;
    uint64_t sum_x = 0, sum_y = 0, sum_xx = 0, sum_yy = 0, sum_xy = 0;
    uint64_t last = 0;  // raster index of the last pixel; not part of the comparison

    void add(uint64_t x, uint64_t y, uint64_t index) {
        area++;
        min_x = std::min(min_x, x);
        min_y = std::min(min_y, y);
        max_x = std::max(max_x, x);
        max_y = std::max(max_y, y);
        sum_x += x;
        sum_y += y;
        sum_xx += x * x;
        sum_yy += y * y;
        sum_xy += x * y;
        last = std::max(last, index);
    }
    bool operator==(const Object &o) const {
        return area == o.area && min_x == o.min_x && min_y == o.min_y && max_x == o.max_x && max_y == o.max_y &&
               sum_x == o.sum_x && sum_y == o.sum_y && sum_xx == o.sum_xx && sum_yy == o.sum_yy && sum_xy == o.sum_xy;
    }
};

// The 8-connected components of at least min_area pixels, in raster order of their last pixels.
inline std::vector<Object> flood(const Image &image, uint64_t min_area) {
    std::vector<uint8_t> todo = image.pixels;
    std::vector<Object> objects;
    std::vector<int> stack;
    for (int start = 0; start < image.width * image.height; start++) {
        if (!todo[start]) continue;
        Object object;
        stack.assign(1, start);
        todo[start] = 0;
        while (!stack.empty()) {
            const int index = stack.back();
            stack.pop_back();
            const int x = index % image.width, y = index / image.width;
            object.add(x, y, index);
            for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, image.height - 1); ny++)
                for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, image.width - 1); nx++) {
                    const int neighbour = ny * image.width + nx;
                    if (!todo[neighbour]) continue;
                    todo[neighbour] = 0;
                    stack.push_back(neighbour);
                }
        }
        if (object.area >= min_area) objects.push_back(object);
    }
    std::sort(objects.begin(), objects.end(), [](const Object &a, const Object &b) { return a.last < b.last; });
    return objects;
}
