/* SPDX-License-Identifier: MIT */
/* edits.h - changes files of a recording, as by hand. The test fails if there is nothing to change. */
#ifndef EDITS_H
#define EDITS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Replace the first occurrence of `from` in a file by `to`. */
void edit_file(const char *folder, const char *name, const char *from, const char *to);

/* Replace the first `from` in one line of ticks.jsonl, counted from 0, by `to`. */
void edit_line(const char *folder, size_t line, const char *from, const char *to);

/* Replace a line of ticks.jsonl by a text: "", or lines with their newlines. */
void replace_line(const char *folder, size_t line, const char *text);

/* A line of ticks.jsonl with its newline; the caller frees it. */
char *copy_line(const char *folder, size_t line);

/* Set the size of a file: truncate it, or fill it up with zeros. */
void set_file_size(const char *folder, const char *name, size_t size);

/* Copy a file within a folder. */
void file_copy(const char *folder, const char *from, const char *to);

/* Rewrite the frame of a tick with one pixel changed. With `as_drawn`, its PNG texts match the changed pixels. */
void change_pixel_of_frame(const char *folder, uint64_t tick, size_t pixel, bool as_drawn);

/* Rewrite the frame without its PNG texts, as other programs save it; with `spoilt`, with one pixel changed. */
void remove_texts_of_frame(const char *folder, uint64_t tick, bool spoilt);

#endif
