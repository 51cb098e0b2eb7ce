/* SPDX-License-Identifier: MIT */
/* edits.h - recordings that somebody changed by hand, for tests. The test fails where there is nothing to change. */
#ifndef EDITS_H
#define EDITS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* In a file of a folder, put `to` in the place of the first `from`. */
void edit_file(const char *folder, const char *name, const char *from, const char *to);

/* The same within one line of ticks.jsonl, the first being 0. */
void edit_line(const char *folder, size_t line, const char *from, const char *to);

/* Put other lines in the place of one of ticks.jsonl: "", or text with its newlines. */
void replace_line(const char *folder, size_t line, const char *text);

/* A line of ticks.jsonl with its newline; the caller frees it. */
char *copy_line(const char *folder, size_t line);

/* Keep the first `size` bytes of a file; a file that is shorter is made longer by zeros. */
void cut_file(const char *folder, const char *name, size_t size);

/* A copy of a file, in the same folder. */
void file_copy(const char *folder, const char *from, const char *to);

/* Write the frame of a tick anew with a pixel changed. With `as_drawn` its texts say that it was drawn so. */
void spoil_frame(const char *folder, uint64_t tick, size_t pixel, bool as_drawn);

/* Write it as other programs save it: the picture alone, with `spoilt` a pixel of it changed. */
void lose_texts(const char *folder, uint64_t tick, bool spoilt);

#endif
