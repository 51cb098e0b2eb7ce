/* SPDX-License-Identifier: MIT */
/* cause_json.h - writes, in JSON, why two recordings differ.
 *
 *     {"session": [group ...], "view": [group ...], "compared": 253, "differing": 212, "first": 41, "last": 252,
 *      "ticks": [{"tick": 41, "causes": [group ...], "pixels": 312,
 *                 "elements": [{"what": "node 0/3/7", "pixels": 180}, ...]}, ...],
 *      "warnings": ["b/session.json is not ...", ...], "drawn_by": ["OSMesa, llvmpipe ...", "..."]}
 *
 * A group holds the facts (cause_facts.h) with the same place and change. A change is "other", "more", "less" or
 * "order". "count" is the number of facts; "facts" lists at most the first CAUSE_LISTED:
 *
 *     {"where": "tree.capacity", "change": "other", "count": 1, "facts": [{"reference": 4, "frames": 8}]}
 *     {"where": "nodes.split", "change": "more", "count": 1, "facts": [{"frames": "0/3/7"}]}
 *     {"where": "edits", "change": "less", "count": 1,
 *      "facts": [{"tick": 3, "id": 17, "reference": {"remove": 17}}]}
 *     {"where": "answers.ids", "change": "more", "query": "the range query", "count": 1,
 *      "facts": [{"id": 7, "frames": 7}]}
 *
 * "ticks" holds the ticks that are reported in detail. "elements" lists the elements drawn at the differing pixels: at
 * most CAUSE_ELEMENTS, in descending order of pixels. */
#ifndef EXPLAIN_CAUSE_JSON_H
#define EXPLAIN_CAUSE_JSON_H

#include "explain.h"
#include "json_write.h"

#define CAUSE_ELEMENTS 32

void cause_write_json(json_writer *w, const explanation *e);

#endif
