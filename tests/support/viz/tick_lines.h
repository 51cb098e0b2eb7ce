/* SPDX-License-Identifier: MIT */
/* tick_lines.h - compares lines of ticks.jsonl with the ticks of a game. */
#ifndef TICK_LINES_H
#define TICK_LINES_H

#include <jansson.h>

#include "octree/game.h"

/* Parse one JSON object; the test fails if the text is anything else. Numbers become reals. */
json_t *json_read(const char *text);

/* The member of an object; the test fails if it is missing. */
json_t *json_member(const json_t *object, const char *name);

/* The test fails unless the object has exactly the members in `names`, which are separated by blanks. */
void assert_members(const json_t *object, const char *names);

/* The test fails unless the value is this whole number. */
void assert_whole_number(const json_t *value, uint64_t expected);

/* The test fails unless the value is the text of this digest, as in files. */
void assert_digest(const json_t *value, uint64_t expected);

/* The test fails unless the line has all facts of the tick, and the counts of the tree's nodes. The member "frame" is
 * not checked. */
void assert_line_has_facts(const json_t *line, const octree_tick *tick, const octree *tree);

#endif
