/* SPDX-License-Identifier: MIT */
/* edited_json.h - what becomes of JSON texts that change as a whole, where changes of bytes would mostly end in a text
 * that is none. */
#ifndef EDITED_JSON_H
#define EDITED_JSON_H

#include <stddef.h>
#include <stdint.h>

/* Change one value of a text of objects, as libFuzzer's LLVMFuzzerCustomMutator(): it becomes another one of the text
 * or one that is extreme, or goes, or something of another place comes. Returns the new size; 0 where the text begins
 * with no object, or what comes out does not fit. */
size_t edited_json(uint8_t *data, size_t size, size_t most, unsigned seed);

#endif
