/* SPDX-License-Identifier: MIT */
/* view_options.h - the table of view options, one row each. The command line, recording.json, the recorder of embedding
 * programs and `octreel diff` all use these rows.
 *
 * To add an option: a member of `view`, a row in view_options.c, and, to show it in the page, a row in
 * viz/page/viewer/view.js. */
#ifndef FORMATS_VIEW_OPTIONS_H
#define FORMATS_VIEW_OPTIONS_H

#include "json_table.h"
#include "view.h"

typedef struct view_option view_option;

struct view_option {
    const char *name;  /* on the command line, without dashes */
    const char *value; /* placeholder for its value in the help; null: it takes no value */
    const char *takes; /* the accepted values, for errors: "pixels as in 1280x720"; for a choice its noun: "camera" */
    const char *help;  /* the help text, followed by the names of the choices if there are any */

    /* Set the option in a view from a text. Returns false, with an error, if the text is not a value of the option. */
    bool (*parse)(const view_option *option, const char *text, view *v, octreel_error *error);
    json_member member;   /* the member of recording.json; without a name if the option is not recorded */
    const char *standard; /* the default, as parse() reads it; null: the option is not set by default */
    const char *noun;     /* name in sentences about a difference: "level of detail"; null: the member's name */
    json_name *words;     /* descriptions of member.names, for the help */
    bool by_element;      /* `octreel diff` reports which elements of the list were added and removed */
};

/* Returns the n-th option, in the order of recording.json; null after the last. */
const view_option *view_option_at(size_t n);

/* Returns the option of this name on the command line; null if there is none. */
const view_option *view_find_option(const char *name);

/* The members of "derived" in recording.json: values that follow from the options and from the points of tick 0. They
 * are recorded so that a later session can be filmed with the same camera and colours (--camera-from). */
extern const json_member view_derived_members[];

/* Returns the name of the n-th layer; null after the last. */
const char *view_layer_name(int n);

#endif
