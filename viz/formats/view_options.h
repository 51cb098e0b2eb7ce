/* SPDX-License-Identifier: MIT */
/* view_options.h - the table of view options, one row for each option. The command line, recording.json, the recorder
 * of embedding programs and `octreel diff` all use these rows.
 *
 * To add an option, add a member of `view` and a row in view_options.c. To show it in the page, also add a row in
 * viz/page/viewer/view.js.
 */
#ifndef FORMATS_VIEW_OPTIONS_H
#define FORMATS_VIEW_OPTIONS_H

#include "json_table.h"
#include "view.h"

typedef struct view_option view_option;

struct view_option {
    const char *name;  /* the option on the command line, without dashes */
    const char *value; /* placeholder of the value in the help; null: the option takes no value */
    /* the accepted values, for errors: "pixels as in 1280x720"; for an option with named choices, a noun: "camera" */
    const char *takes;
    const char *help; /* the text for the help; the help prints the names of an option's choices after it */

    /* Sets the option in a view from a text. Returns false with an error if the text is not a valid value. */
    bool (*parse)(const view_option *option, const char *text, view *v, octreel_error *error);
    json_member member;   /* the option's member in recording.json; its name is null if the option is not recorded */
    const char *standard; /* the default, as a text that parse() accepts; null: the option is unset by default */
    /* the option's noun in sentences about a difference: "level of detail"; null: the name of the member is used */
    const char *noun;
    json_name *words; /* descriptions of the choices in member.names, for the help */
    /* true: `octreel diff` reports each added or removed element of the list; false: the list as a whole */
    bool by_element;
};

/* Returns the n-th option, in the order of recording.json. Returns null if there are only n options or fewer. */
const view_option *view_option_at(size_t n);

/* Returns the option with this name on the command line, or null. */
const view_option *view_find_option(const char *name);

/* The members of "derived" in recording.json. Derived values are computed from the options and the points of tick 0.
 * They are recorded so that --camera-from can draw another session with the same camera and colours. */
extern const json_member view_derived_members[];

/* Returns the name of the n-th layer. Returns null if there are only n layers or fewer. */
const char *view_layer_name(int n);

#endif
