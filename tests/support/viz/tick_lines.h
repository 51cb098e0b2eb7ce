/* SPDX-License-Identifier: MIT */
/* tick_lines.h - compares lines of ticks.jsonl with the ticks of a game. */
#ifndef TICK_LINES_H
#define TICK_LINES_H

#include <jansson.h>

#include "octree/game.h"

/* Parse one JSON object; the test fails when it is none, or is followed by anything but blanks. Numbers are reals. */
json_t *json_read(const char *text);

/* The member of an object; the test fails when there is none. */
json_t *json_member(const json_t *object, const char *name);

/* The members of an object are those named, no less and no more. `names` has blanks between them. */
void assert_members(const json_t *object, const char *names);

/* A whole number. */
void assert_whole_number(const json_t *value, uint64_t expected);

/* A digest, as files have it. */
void assert_digest(const json_t *value, uint64_t expected);

/* The line tells all of the tick, and what a count of the tree's nodes gives. Whether it names a frame is not asked. */
void assert_line_tells(const json_t *line, const octree_tick *tick, const octree *tree);

#endif
