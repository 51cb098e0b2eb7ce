/* SPDX-License-Identifier: MIT */
/* search.c - checks of arguments that all queries share. */
#include "search.h"

octree_search search_or_default(const octree_search *how)
{
    return how ? *how : (octree_search){0};
}

octree_status check_box(const octree_box *box)
{
    if (!box)
        return OCTREE_NULL_ARGUMENT;
    for (int i = 0; i < 3; i++) {
        if (isnan(box->min[i]) || isnan(box->max[i]))
            return OCTREE_NOT_FINITE;
        if (box->min[i] > box->max[i])
            return OCTREE_BAD_RANGE;
    }
    return OCTREE_OK;
}

bool is_printable_text(const char *text, size_t size)
{
    size_t length = 0;
    while (length < size && text[length] >= ' ' && text[length] <= '~')
        length++;
    return length < size && text[length] == 0;
}

bool visit_unless_self(const octree_point *point, void *context)
{
    const collision *c = context;
    const bool is_self = c->self && c->self->id == point->id && is_same_position(c->self->position, point->position);
    return is_self || c->visit(point, c->context);
}
