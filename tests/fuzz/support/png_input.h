/* SPDX-License-Identifier: MIT */
/* png_input.h - makes PNG files of any bytes, for fuzzers. The first byte says what the rest is: a file; a file whose
 * checksums are corrected, so that the code behind the checks is reached; or a recipe for a valid file. */
#ifndef PNG_INPUT_H
#define PNG_INPUT_H

#include <stddef.h>
#include <stdint.h>

enum { PNG_INPUT_AS_IT_IS, PNG_INPUT_WITH_CHECKSUMS, PNG_INPUT_RECIPE, PNG_INPUT_MODES, PNG_INPUT_MOST = 1 << 16 };

typedef struct png_input {
    uint8_t bytes[2 * PNG_INPUT_MOST];
    size_t size;
} png_input;

/* Make a file from 1 to PNG_INPUT_MOST / 2 bytes. It may be empty. */
void png_input_make(png_input *file, const uint8_t *data, size_t size);

/* Write the file into memory. Returns the path by which it is read until the next call. Aborts on failure. */
const char *png_input_save(const png_input *file);

#endif
