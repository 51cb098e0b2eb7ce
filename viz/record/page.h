/* SPDX-License-Identifier: MIT */
/* page.h - writes the page of a recording or session: one HTML file that shows the ticks in a browser and can continue
 * the game. */
#ifndef RECORD_PAGE_H
#define RECORD_PAGE_H

#include "error.h"
#include "octree/game.h"
#include "packer.h"
#include "point_values.h"
#include "text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* The maximum number of entries that the page keeps of each list in a tick. If N entries were left out, the entry
 * {"more": N} follows. */
#define PAGE_LIST 32

/* The maximum size in bytes of a session.json that is embedded in a page. For a larger session, the page asks its
 * reader to choose the file. */
#define PAGE_MOST_SESSION ((size_t)128 << 20)

/* Returns whether pages can play a session, because they contain the program as WebAssembly. Otherwise pages only show
 * frames. */
bool page_can_play(void);

/* A page that is being made, in memory. It must keep its address. */
typedef struct page_writer {
    packer facts;      /* the text of recording.json and of the ticks, in a page that can play */
    text_stream plain; /* the same, in a page that cannot play */
    uint64_t ticks;    /* number of ticks added so far */
    char *rest; /* the part of the last completely written line that a repetition shares; null: no tick can repeat
                 * this line; owned */
    size_t rest_size;
    uint64_t repeated; /* number of ticks without a frame that repeat this line and are not yet written */
} page_writer;

/* Make a page. Call page_begin() with the text of recording.json, then page_add_tick() for each line of ticks.jsonl,
 * then page_end() with the text of session.json, which writes the page; and page_release(), after a failure too. In
 * error messages `path` is the source of the text. Returns false with an error if the text is not JSON, or if memory
 * runs out. Write errors are left to the caller, who checks the stream. A tick that repeats the tick before it takes 20
 * bytes of the page before they are packed, or no bytes if the tick has no frame. */
bool page_begin(page_writer *w, const char *path, const char *recording, size_t size, octreel_error *error);
bool page_add_tick(page_writer *w, const char *path, const char *line, size_t size, octreel_error *error);
bool page_end(page_writer *w, FILE *page, const char *session, size_t size, octreel_error *error);

/* End a page whose points are not in its session.json, but in a block that pack_points() made. `cloud`: the page shows
 * a cloud and not a game. */
bool page_end_with_points(page_writer *w, FILE *page, const char *session, size_t size, const unsigned char *points,
                          size_t points_size, bool cloud, octreel_error *error);

/* End a page with the points of a session in a block. are_points_packed() must be true. */
bool page_end_with_packed_session(page_writer *w, FILE *page, const octree_session *session, const point_values *values,
                                  octreel_error *error);
void page_release(page_writer *w);

/* Call page_begin() with the file recording.json of a folder. */
bool page_begin_folder(page_writer *w, const char *folder, octreel_error *error);

/* Write the file index.html of a recording. `made` is the page that page_begin_folder() began and that has all ticks;
 * null: the page is made from the other files in the folder, without an incomplete last line of ticks.jsonl. `session`
 * is the session of session.json, or null if it is not in memory. If `session` is null, the page holds the text of
 * session.json, even if the points could be stored as a compressed block. An existing index.html is replaced, or stays
 * unchanged if writing fails. */
bool page_write(page_writer *made, const char *folder, const octree_session *session, const point_values *values,
                octreel_error *error);

#endif
