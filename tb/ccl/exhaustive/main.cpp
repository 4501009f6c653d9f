// SPDX-License-Identifier: Apache-2.0
// Exhaustive and random comparison of a verilated ccl with flood fill. tb/ccl/test_exhaustive.py builds and runs it.
//
//   ccl_exhaustive all WIDTH HEIGHT [FIRST LAST]     every image (or those coded FIRST to LAST - 1), back to back
//   ccl_exhaustive random COUNT LEAST GREATEST       random sizes LEAST to GREATEST, all densities, some frames cut off
//   ccl_exhaustive structured WIDTH HEIGHT           hard images, then random ones of 1 to 99 %
// Options, first: --seed N, --idle PERCENT, --stall PERCENT.

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bench.h"

static void send_all(Bench &bench, int width, int height, uint64_t first, uint64_t last) {
    for (uint64_t code = first; code < last; code++) {
        Frame frame;
        frame.image = coded_image(width, height, code);
        frame.sent_pixels = frame.image.pixels.size();
        frame.name = "image " + std::to_string(code);
        bench.send(frame);
    }
}

static void send_random(Bench &bench, uint64_t count, int least, int greatest) {
    Rng &rng = bench.random();
    uint64_t min_area = 0, sent = 0;
    const int span = greatest - least + 1;
    for (uint64_t i = 0; i < count; i++) {
        const int width = least + static_cast<int>(rng() % span), height = least + static_cast<int>(rng() % span);
        Frame frame;
        const auto &names = structured_names();
        if (rng() % 8 == 0)
            frame.image = structured(names[rng() % names.size()], width, height);
        else
            frame.image = random_image(rng, width, height, 1 + static_cast<int>(rng() % 99));
        frame.zeros = rng() % 8 == 0;
        // A frame cut off within its first pixels is filtered like the next one (docs/cores/ccl.md).
        if (i == 0 || sent >= 8) min_area = rng() % 4 == 0 ? rng() % 8 : 0;
        frame.min_area = min_area;
        frame.sent_pixels = frame.image.pixels.size();
        if (rng() % 16 == 0 && i + 1 < count) frame.sent_pixels = 1 + rng() % frame.sent_pixels;
        sent = frame.sent_pixels;
        frame.name = "random " + std::to_string(i);
        bench.send(frame);
    }
}

static void send_structured(Bench &bench, int width, int height) {
    std::vector<Frame> frames;
    for (const auto &name : structured_names()) {
        Frame frame;
        frame.image = structured(name, width, height);
        frame.name = name;
        frames.push_back(frame);
        frame.zeros = true;
        frame.name += ", zeros";
        frames.push_back(frame);
    }
    for (int percent : {1, 2, 5, 10, 20, 35, 41, 50, 65, 80, 90, 95, 98, 99}) {
        Frame frame;
        frame.image = random_image(bench.random(), width, height, percent);
        frame.name = std::to_string(percent) + " %";
        frames.push_back(frame);
    }
    for (Frame &frame : frames) {
        frame.sent_pixels = frame.image.pixels.size();
        bench.send(frame);
    }
}

[[noreturn]] static void refuse(const char *what) {
    std::fprintf(stderr, "touchdown: %s.\n", what);
    std::exit(2);
}

static uint64_t number(const char *text) {
    char *end;
    const uint64_t value = std::strtoull(text, &end, 10);
    if (*text < '0' || *text > '9' || *end != '\0') refuse("give whole numbers");
    return value;
}

static unsigned percentage(uint64_t value) {
    if (value > 99) refuse("give 0 to 99 per cent");
    return static_cast<unsigned>(value);
}

int main(int argc, char **argv) {
    uint64_t seed = 1;
    unsigned idle = 0, stall = 0;
    int next = 1;
    for (; next + 1 < argc && std::strncmp(argv[next], "--", 2) == 0; next += 2) {
        const uint64_t value = number(argv[next + 1]);
        const std::string option = argv[next];
        if (option == "--seed")
            seed = value;
        else if (option == "--idle")
            idle = percentage(value);
        else if (option == "--stall")
            stall = percentage(value);
        else
            refuse("the options are --seed, --idle and --stall");
    }
    std::vector<uint64_t> numbers;
    const std::string mode = next < argc ? argv[next++] : "";
    for (; next < argc; next++) numbers.push_back(number(argv[next]));

    Bench bench(seed);
    bench.idle_percent = idle;
    bench.stall_percent = stall;
    if (mode == "all" && (numbers.size() == 2 || numbers.size() == 4)) {
        const uint64_t total = 1ull << (numbers[0] * numbers[1]);
        const bool part = numbers.size() == 4;
        send_all(bench, static_cast<int>(numbers[0]), static_cast<int>(numbers[1]), part ? numbers[2] : 0,
                 part ? numbers[3] : total);
    } else if (mode == "random" && numbers.size() == 3) {
        send_random(bench, numbers[0], static_cast<int>(numbers[1]), static_cast<int>(numbers[2]));
    } else if (mode == "structured" && numbers.size() == 2) {
        send_structured(bench, static_cast<int>(numbers[0]), static_cast<int>(numbers[1]));
    } else {
        refuse("give all WIDTH HEIGHT [FIRST LAST], random COUNT LEAST GREATEST or structured WIDTH HEIGHT");
    }
    bench.drain();
    std::printf("ok: %llu frames, %llu objects, %llu clocks, longest stall %llu\n",
                (unsigned long long)bench.frames_checked, (unsigned long long)bench.objects_checked,
                (unsigned long long)bench.clocks, (unsigned long long)bench.greatest_close);
    return 0;
}
