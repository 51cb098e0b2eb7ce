/* SPDX-License-Identifier: MIT */
/* visit.h - calls of the caller's functions with a body. Private. */
#ifndef OCTREE_VISIT_H
#define OCTREE_VISIT_H

#include "../exact/float_mode.h"
#include "../exact/point.h"
#include "set.h"

/* The context of visit_body_in_caller_mode(): a visitor of the caller. */
typedef struct caller_body_visitor {
    octree_body_visitor visit;
    void *context;
} caller_body_visitor;

static inline bool visit_body_in_caller_mode(const octree_body *body, void *context)
{
    const caller_body_visitor *caller = context;
    const bool paused = float_mode_pause();
    const bool result = caller->visit(body, caller->context);
    float_mode_resume(paused);
    return result;
}

/* As CALLER_VISITOR() in float_mode.h, for a visitor of bodies. */
#define CALLER_BODY_VISITOR(visit, context)                                                                            \
    (visit) ? visit_body_in_caller_mode : NULL, &(caller_body_visitor)                                                 \
    {                                                                                                                  \
        visit, context                                                                                                 \
    }

/* Returns whether the options of a search skip a body. `target` is null for a search without a target. */
static inline bool is_skipped(const octree_search *how, const octree_body *body, const double target[3])
{
    return (how->skip == OCTREE_SKIP_ID && body->id == how->skip_id) ||
           (how->skip == OCTREE_SKIP_COINCIDENT && target && is_same_position(body->position, target));
}

#endif
