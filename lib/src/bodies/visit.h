/* SPDX-License-Identifier: MIT */
/* visit.h - calls of the caller's functions with a body. Private. */
#ifndef OCTREE_VISIT_H
#define OCTREE_VISIT_H

#include "../exact/float_mode.h"
#include "../exact/point.h"
#include "set.h"

/* A function of the caller that receives bodies. */
typedef struct body_call {
    octree_body_visitor visit; /* null: the result is true */
    void *context;
} body_call;

/* Call the caller's function in the caller's floating-point mode. */
static inline bool call_with_body(const body_call *call, const octree_body *body)
{
    if (!call->visit)
        return true;
    const bool paused = float_mode_pause();
    const bool result = call->visit(body, call->context);
    float_mode_resume(paused);
    return result;
}

/* Returns whether the options of a search skip a body. `target` is null for a search without a target. */
static inline bool is_skipped(const octree_search *how, const octree_body *body, const double target[3])
{
    return (how->skip == OCTREE_SKIP_ID && body->id == how->skip_id) ||
           (how->skip == OCTREE_SKIP_COINCIDENT && target && is_same_position(body->position, target));
}

#endif
