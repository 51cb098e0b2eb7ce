/* cause_json.h - why two recordings differ, as JSON.
 *
 *   {"session": [fact ...], "look": [fact ...], "compared": 253, "differing": 212, "first": 41, "last": 252,
 *    "ticks": [{"tick": 41, "facts": [fact ...], "more": {"point_moved": 7},
 *               "pixels": 312, "elements": [{"what": "node 0/3/7", "pixels": 180}, ...]}, ...],
 *    "doubts": ["b/session.json is not ...", ...], "drawn_by": ["OSMesa, llvmpipe ...", "..."]}
 *
 * A fact has its kind (cause_facts.h) and what that names: {"kind": "option", "name": "leaf capacity", "reference": 4,
 * "frames": 8}, {"kind": "point_moved", "id": 12, "reference": [0, 0, 0], "frames": [1, 2, 3]}, {"kind": "node_split",
 * "node": "0/3/7"}. "more" counts those of a kind that are not listed; "ticks" has those that are told in detail.
 * "elements" are drawn under the pixels that differ, the largest first, no more than CAUSE_ELEMENTS.
 */
#ifndef DIFF_CAUSE_JSON_H
#define DIFF_CAUSE_JSON_H

#include "explain.h"
#include "json_write.h"

#define CAUSE_ELEMENTS 32

void cause_write_json(json_writer *w, const explanation *e);

#endif
