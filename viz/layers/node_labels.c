/* node_labels.c - see node_labels.h. */
#include "node_labels.h"
#include "layer.h"
#include "text_space.h"

#include <stdio.h>
#include <string.h>

static const scene_style label_style = {.layer = LAYER_NODES, .role = ROLE_TEXT, .width = 1};

/* A label wider than the picture of its box would be taken for another's. */
static bool fits_box(const scene *s, const scene_box *box, const char *text)
{
    return camera_box_pixels(&s->camera, &box->box) >= (double)(strlen(text) + 1) * TEXT_LETTER * s->unit;
}

static bool add_label(scene *s, text_space *words, const scene_box *box)
{
    scene_label label = {.id = box->id, .style = label_style};
    char text[OCTREE_ADDRESS_TEXT];
    double middle[3], pixel[2];
    for (int i = 0; i < 3; i++)
        middle[i] = box->box.min[i] / 2 + box->box.max[i] / 2;
    snprintf(label.text, sizeof label.text, "%s", octree_address_format(box->id, text));
    if (!text_place(s, middle, pixel) || !fits_box(s, box, label.text) ||
        !text_space_take(words, s, label.text, pixel, label.at))
        return false;
    text_add_ground(s, &label, ROLE_PANEL);
    scene_add_label(s, label);
    return true;
}

void add_node_labels(scene *s)
{
    if (!s->view.labels || !view_shows(&s->view, LAYER_NODES))
        return;
    text_space words = {.count = 0};
    for (unsigned depth = 0; depth <= OCTREE_MAX_DEPTH; depth++)
        for (size_t i = 0; i < s->boxes.count; i++)
            if (s->boxes.items[i].style.layer == LAYER_NODES && s->boxes.items[i].depth == depth)
                s->tally.labels += add_label(s, &words, &s->boxes.items[i]);
}
