/* SPDX-License-Identifier: MIT */
/* edited_words.h - what becomes of texts of lines and words, such as the headers of point clouds, that change by whole
 * lines and words, where changes of bytes would mostly end in words that are none. */
#ifndef EDITED_WORDS_H
#define EDITED_WORDS_H

#include <stddef.h>
#include <stdint.h>

/* Change a text in place, for libFuzzer's LLVMFuzzerCustomMutator(). Up to four times, a line or a word is removed,
 * copied to another place, exchanged with another one, or replaced by one of `words` or by an extreme number. Returns
 * the new size; 0 if there is nothing to change. */
size_t edited_words(uint8_t *data, size_t size, size_t most, unsigned seed, const char *const *words,
                    size_t word_count);

#endif
