/* SPDX-License-Identifier: MIT */
/* apart.h - asks an index in a process of its own, so that an index that hangs or crashes does no harm. */
#ifndef APART_H
#define APART_H

#include "octree/query.h"

/* The programs octree-answer, octree-answer-fast and octree-answer-contracted have the same indexes. They differ in the
 * options of the compiler: none, -ffast-math, -ffp-contract=fast with fused multiply-add. */
typedef enum apart_program { APART_PLAIN, APART_FAST, APART_CONTRACTED, APART_PROGRAMS } apart_program;

typedef enum apart_result {
    APART_ANSWERED,
    APART_REFUSED, /* the index refuses the points, or a query */
    APART_HUNG,    /* it needs more than two seconds, or 1 GiB of memory */
    APART_CRASHED  /* a signal or an exit ended the process */
} apart_result;

enum { APART_IDS = 512 }; /* the ids of an answer that are kept */

/* What the process reads from its standard input: this, the points, the queries. */
typedef struct apart_question {
    octree_box world;
    uint64_t point_count, query_count;
    uint64_t flush; /* 1: subnormal numbers are flushed to zero */
} apart_question;

/* What the process writes for each query. */
typedef struct apart_answer {
    uint64_t count; /* of ids, which may be more than APART_IDS; APART_REFUSAL: the query was refused */
    uint64_t ids[APART_IDS];
} apart_answer;

#define APART_REFUSAL UINT64_MAX

/* Ask the index with this name all queries. answers[i] belongs to query i; they are complete if the result is
 * APART_ANSWERED. The queries have no arrays. Ends the program if no process can be started. */
apart_result ask_apart(apart_program program, const char *index, const apart_question *question,
                       const octree_point *points, const octree_query *queries, apart_answer *answers);

#endif
