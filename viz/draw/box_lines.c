/* merged_boxes.c - see merged_boxes.h. Boxes of a tree come in one order, so that from frame to frame a few come
 * between others and a few are missing. */
#include "box_lines.h"

#include <stdlib.h>
#include <string.h>

/* So many in a row may be missing at once; what comes behind more of them is taken for new. */
#define MISSING_AT_MOST 64

static void release(const box_arrays *arrays)
{
    free(arrays->boxes);
    free(arrays->lines);
}

void merged_boxes_release(merged_boxes *kept)
{
    release(&kept->now);
    release(&kept->next);
    memset(kept, 0, sizeof *kept);
}

static bool is_among(const scene_box *box, unsigned first, unsigned behind)
{
    return box->style.layer >= first && box->style.layer < behind;
}

static bool same_box(const scene_box *a, const scene_box *b)
{
    return a->id == b->id && a->depth == b->depth && memcmp(&a->style, &b->style, sizeof a->style) == 0 &&
           memcmp(&a->box, &b->box, sizeof a->box) == 0;
}

bool merged_boxes_are(const merged_boxes *kept, const scene *s, unsigned first, unsigned behind)
{
    size_t count = 0;
    for (size_t i = 0; i < s->boxes.count; i++) {
        const scene_box *box = &s->boxes.items[i];
        if (!is_among(box, first, behind))
            continue;
        if (count == kept->now.count || !same_box(&kept->now.boxes[count], box))
            return false;
        count++;
    }
    return count == kept->now.count;
}

/* Room for these, and for some more in the frames to come. */
static bool make_room(box_arrays *next, const scene *s, unsigned first, unsigned behind)
{
    size_t count = 0;
    for (size_t i = 0; i < s->boxes.count; i++)
        count += is_among(&s->boxes.items[i], first, behind);
    next->count = 0;
    if (count <= next->room)
        return true;
    release(next);
    *next = (box_arrays){.room = count + count / 8};
    next->boxes = malloc(next->room * sizeof *next->boxes);
    next->lines = malloc(next->room * sizeof *next->lines);
    next->room = next->boxes && next->lines ? next->room : 0;
    return next->room > 0;
}

static bool use_line(line_set *lines, const scene_box *box, unsigned axis, unsigned corner, uint32_t *place)
{
    const line_key key = line_key_of(box, axis, corner);
    *place = lines_use(lines, &key);
    return *place != LINE_NONE;
}

/* Edges along axes of no extent are dots on others, but for a box that is a dot itself. */
static bool use_lines(line_set *lines, const scene_box *box, box_lines *places)
{
    bool ok = true, dot = true;
    for (unsigned edge = 0; ok && edge < BOX_EDGES; edge++) {
        const unsigned axis = edge / 4;
        const bool extends = box->box.min[axis] < box->box.max[axis];
        places->of[edge] = LINE_NONE;
        ok = !extends || use_line(lines, box, axis, edge % 4, &places->of[edge]);
        dot = dot && !extends;
    }
    return ok && (!dot || use_line(lines, box, 0, 0, &places->of[0]));
}

static void leave_lines(line_set *lines, const box_lines *places, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (unsigned edge = 0; edge < BOX_EDGES; edge++)
            if (places[i].of[edge] != LINE_NONE)
                lines_leave(lines, places[i].of[edge]);
}

/* Where a box is among the next few from `from` on, or the number of all. */
static size_t find_box(const box_arrays *now, size_t from, const scene_box *box)
{
    const size_t left = now->count - from, end = from + (left < MISSING_AT_MOST ? left : MISSING_AT_MOST);
    for (size_t i = from; i < end; i++)
        if (same_box(&now->boxes[i], box))
            return i;
    return now->count;
}

/* The next box, which is kept from `old` on or comes from nowhere. */
static bool take_box(merged_boxes *kept, line_set *lines, const scene_box *box, size_t *old)
{
    const box_arrays *now = &kept->now;
    const size_t found = find_box(now, *old, box), at = kept->next.count++;
    kept->next.boxes[at] = *box;
    if (found == now->count)
        return use_lines(lines, box, &kept->next.lines[at]);
    kept->next.lines[at] = now->lines[found];
    leave_lines(lines, &now->lines[*old], found - *old);
    *old = found + 1;
    return true;
}

bool merged_boxes_become(merged_boxes *kept, line_set *lines, const scene *s, unsigned first, unsigned behind)
{
    size_t old = 0;
    bool ok = make_room(&kept->next, s, first, behind);
    for (size_t i = 0; ok && i < s->boxes.count; i++) {
        const scene_box *box = &s->boxes.items[i];
        if (is_among(box, first, behind))
            ok = take_box(kept, lines, box, &old);
    }
    if (ok && old < kept->now.count)
        leave_lines(lines, &kept->now.lines[old], kept->now.count - old);
    const box_arrays before = kept->now;
    kept->now = kept->next;
    kept->next = before;
    return ok;
}
