/* merged_boxes.h - the boxes whose edges were merged last, each with the lines that its edges lie on; and what of them
 * is not as it was. Private to the edges.
 */
#ifndef DRAW_MERGED_BOXES_H
#define DRAW_MERGED_BOXES_H

#include "lines.h"

#define BOX_EDGES 12

/* The lines of a box's edges, four along each axis; LINE_NONE where the box has no extent. */
typedef struct box_lines {
    uint32_t of[BOX_EDGES];
} box_lines;

/* Side by side. */
typedef struct box_arrays {
    scene_box *boxes;
    box_lines *lines;
    size_t count, room;
} box_arrays;

/* A zeroed one is empty. */
typedef struct merged_boxes {
    box_arrays now;
    box_arrays next; /* memory for those of the next time */
} merged_boxes;

void merged_boxes_release(merged_boxes *kept);

/* Whether these are the boxes of a scene in the layers [first, behind), in this order. */
bool merged_boxes_are(const merged_boxes *kept, const scene *s, unsigned first, unsigned behind);

/* Become these. Lines of boxes that come or go are marked as changed; boxes that stay are found where few others came
 * or went before them. False when there is no memory: then lines and boxes are to be cleared. Cost: O(n), and a search
 * for a line for each edge of a box that comes. */
bool merged_boxes_become(merged_boxes *kept, line_set *lines, const scene *s, unsigned first, unsigned behind);

#endif
