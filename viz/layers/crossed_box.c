/* crossed_box.c - see crossed_box.h. */
#include "crossed_box.h"

void add_crossed_faces(scene *s, const octree_box *box, scene_style style)
{
    for (unsigned face = 0; face < 6; face++) {
        for (unsigned diagonal = 0; diagonal < 2; diagonal++) {
            scene_segment line = {.id = face * 2 + diagonal, .style = style};
            const unsigned fixed = face / 2, across = (fixed + 1) % 3, along = (fixed + 2) % 3;
            for (unsigned end = 0; end < 2; end++) {
                line.ends[end][fixed] = face % 2 ? box->max[fixed] : box->min[fixed];
                line.ends[end][across] = end ? box->max[across] : box->min[across];
                line.ends[end][along] = end != diagonal ? box->max[along] : box->min[along];
            }
            scene_add_segment(s, line);
        }
    }
}
