// SPDX-License-Identifier: Apache-2.0
// Gives each input of a packed corpus to a fuzz target, without a fuzzer: "replay FILE...". An
// input is its length, four bytes, little endian, and its bytes.
#include <stdio.h>
#include <stdlib.h>

#include "target.h"

#define LENGTH_BYTES 4U
#define INPUT_BYTES_MAX 65536U

// Returns how many inputs the file held, or -1.
static long replay(const char *path)
{
    FILE *file = fopen(path, "rb");
    uint8_t length[LENGTH_BYTES];
    long count = 0;

    if (file == NULL) {
        return -1;
    }
    size_t got;
    while ((got = fread(length, 1U, sizeof length, file)) == sizeof length) {
        const size_t size = length[0] | (size_t)length[1] << 8U | (size_t)length[2] << 16U | (size_t)length[3] << 24U;

        // In memory of its own, so that a read beyond the end is found.
        uint8_t *input = size <= INPUT_BYTES_MAX ? malloc(size != 0U ? size : 1U) : NULL;
        if (input == NULL || fread(input, 1U, size, file) != size) {
            free(input);
            (void)fclose(file);
            return -1;
        }
        (void)LLVMFuzzerTestOneInput(input, size);
        free(input);
        count++;
    }
    (void)fclose(file);
    return got == 0U ? count : -1;
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        const long count = replay(argv[i]);

        if (count < 0) {
            (void)fprintf(stderr, "%s is no packed corpus\n", argv[i]);
            return 1;
        }
        (void)printf("%ld inputs of %s\n", count, argv[i]);
    }
    return 0;
}
