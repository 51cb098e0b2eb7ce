/* SPDX-License-Identifier: MIT */
/* edited_json.h - what becomes of JSON texts that change as a whole, where changes of bytes would mostly end in a text
 * that is none. */
#ifndef EDITED_JSON_H
#define EDITED_JSON_H

#include <stddef.h>
#include <stdint.h>

/* Change one value of a text of JSON objects, for libFuzzer's LLVMFuzzerCustomMutator(): replace it by another value of
 * the text or an extreme one, remove it, or add a value from elsewhere in the text. Returns the new size; 0 if the text
 * does not begin with an object, or the result does not fit. */
size_t edited_json(uint8_t *data, size_t size, size_t most, unsigned seed);

#endif
