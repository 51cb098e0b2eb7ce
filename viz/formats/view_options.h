/* SPDX-License-Identifier: MIT */
/* view_options.h - the options of a view, one row each, by which the command line, recording.json and programs that
 * record themselves go; comparisons go by recording.json. A new option is a member of `view` and a row in
 * view_options.c.
 */
#ifndef FORMATS_VIEW_OPTIONS_H
#define FORMATS_VIEW_OPTIONS_H

#include "json_table.h"
#include "view.h"

typedef struct view_option view_option;

struct view_option {
    const char *name;  /* on the command line, without dashes; null: it is in recording.json alone */
    const char *value; /* what stands for its value in the help; null: it takes none */
    const char *takes; /* what fits, in words: "pixels as in 1280x720"; of a choice what it is one of: "camera" */
    const char *help;  /* followed by the names, where member.names has some */

    /* Change a view by the text of a value. False, with a sentence, where it does not fit. */
    bool (*parse)(const view_option *option, const char *text, view *v, octreel_error *error);
    json_member member; /* of recording.json; its name is null where it has none */
    const char *noun;   /* in sentences about a difference: "level of detail"; null: the member's name */
    json_name *words;   /* what each of member.names is, in the help */
};

/* The n-th option; null beyond the last. Those of recording.json come in its order. */
const view_option *view_option_at(size_t n);

/* The option of this name on the command line; null when there is none. */
const view_option *view_option_named(const char *name);

/* The n-th name of a layer; null beyond the last. */
const char *view_layer_at(int n);

#endif
