/* cause_looks.c - in what the looks of two recordings differ; see cause_compare.h. */
#include "cause_compare.h"
#include "layer.h"
#include "number.h"

#include <stdio.h>
#include <string.h>

#define OPTIONS 14

static cause_value size_value(const view *v)
{
    char text[40];
    snprintf(text, sizeof text, "%dx%d", v->width, v->height);
    return cause_word(text);
}

static cause_value slice_value(const view_filter *f)
{
    char text[NUMBER_TEXT + 3] = "none";
    if (f->slice) {
        snprintf(text, sizeof text, "%c=", f->slice);
        number_print(f->slice_at, text + 2);
    }
    return cause_word(text);
}

static cause_value depths_value(const view_filter *f)
{
    char text[40] = "all";
    if (f->by_depth)
        snprintf(text, sizeof text, "%u-%u", f->min_depth, f->max_depth);
    return cause_word(text);
}

static cause_value truth(bool value)
{
    return cause_word(value ? "on" : "off");
}

static void list_options(const cause_look *look, cause_option options[OPTIONS])
{
    const view *v = &look->view;
    const cause_option list[OPTIONS] = {
        {"size", size_value(v)},
        {"camera", cause_word(view_camera_name(v->camera))},
        {"fit", v->fit == FIT_BOX ? cause_box(&v->focus) : cause_word("the world")},
        {"colouring", cause_word(view_coloring_name(v->coloring))},
        {"diagram", cause_word(view_diagram_name(v->diagram))},
        {"slice", slice_value(&v->filter)},
        {"range of depths", depths_value(&v->filter)},
        {"rule for leaves alone", truth(v->filter.leaves)},
        {"region", v->filter.by_region ? cause_box(&v->filter.region) : cause_word("none")},
        {"rule for labels", truth(v->labels)},
        {"level of detail", cause_number(v->lod)},
        {"budget", cause_whole(v->budget)},
        {"anti-aliasing", cause_whole((uint64_t)view_samples(v))},
        {"interval of frames", cause_whole(look->every)},
    };
    memcpy(options, list, sizeof list);
}

void cause_compare_looks(const cause_look *a, const cause_look *b, cause_facts *facts)
{
    cause_option options[2][OPTIONS];
    list_options(a, options[0]);
    list_options(b, options[1]);
    cause_add_options(facts, CAUSE_VIEW, options[0], options[1], OPTIONS);
    for (int i = 0; i < LAYER_COUNT; i++) {
        const bool shown[2] = {view_shows(&a->view, (view_layer)i), view_shows(&b->view, (view_layer)i)};
        if (shown[0] != shown[1])
            cause_add(facts, (cause_fact){.kind = shown[1] ? CAUSE_LAYER_MORE : CAUSE_LAYER_LESS,
                                          .tick = CAUSE_NO_TICK,
                                          .name = view_layer_name((view_layer)i)});
    }
}
