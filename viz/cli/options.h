/* SPDX-License-Identifier: MIT */
/* options.h - the values of options, and the options that all commands that draw share. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "file.h"
#include "renderer.h"
#include "image_compare.h"

#include <getopt.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Exit statuses. */
enum { EXIT_DONE = 0, EXIT_FINDING = 1, EXIT_TROUBLE = 2 };

/* Print "octreel: " and a sentence on stderr; returns EXIT_TROUBLE. */
int trouble(const char *format, ...);

/* The same for readers of values: returns false. */
bool refuse(const char *format, ...);

/* An option of one command: how its value is read, and where it goes. */
typedef struct command_option command_option;

/* Read a value. False, with the sentence printed, where `text` does not fit. */
typedef bool command_option_reader(const command_option *option, const char *text, void *into);

struct command_option {
    const char *name; /* without dashes; "output" has the short form -o. Null ends a table */
    command_option_reader *read;
    size_t offset, size; /* of the value in the command's arguments */
    uint64_t min, max;   /* of a whole number */
};

#define OPTION_VALUE(type, member) offsetof(type, member), sizeof(((type *)NULL)->member)

/* As it is typed: "--every", "-o". */
#define OPTION_TYPED 32
const char *option_typed(const command_option *option, char text[OPTION_TYPED]);

command_option_reader read_flag;    /* bool: the option takes no value */
command_option_reader read_text;    /* const char * */
command_option_reader read_name;    /* the same, of a file or folder: not empty */
command_option_reader read_folder;  /* the same, of a folder that is written: not named as a file */
command_option_reader read_picture; /* the same, of a PNG that is written: not a folder, nor named as another file; "-"
                                     * is standard output, unless that is a terminal */
command_option_reader read_file;    /* the same, of another file: not a folder, nor named as a picture; "-" is standard
                                     * output */
command_option_reader read_whole;   /* an integer type */
command_option_reader read_color;   /* image_color, as RRGGBB or #RRGGBB */
command_option_reader read_fill;    /* draw_fill, by its name; FILL_HELP is its help */

/* Whether a path without an option can be meant for -o, by the option's reader. */
bool is_meant_for(command_option_reader *reader, const char *path);

#define FILL_HELP                                                                                                      \
    "      --fill WITH       integers (default) fill the picture, or gl does, which is slower; the pixels are the "    \
    "same.\n"                                                                                                          \
    "                        With --any-renderer it is gl in any case\n"

/* Names of files and folders, of an option or of a command, must not be empty. False, with the sentence printed. */
bool check_names(const char *command, char *const *names, int count);

/* False, with the sentence printed, where more than one of what is written goes to standard output; `json` does. */
bool check_standard_output(const output_file *outputs, size_t count, bool json);

/* Whether one of them does, so that what is said goes elsewhere. */
bool is_standard_output_taken(const output_file *outputs, size_t count);

/* A whole number that is no option's. */
bool read_count(const char *name, const char *text, uint64_t min, uint64_t max, uint64_t *value);

/* The options of a view are the same for every command that draws. They are collected while the command line is read,
 * and then become a view. */
#define VIEW_OPTION 256 /* the first of getopt's numbers for them */
#define VIEW_OPTIONS 32 /* at most */
typedef struct view_options {
    const char *values[VIEW_OPTIONS]; /* as they were typed, at the numbers of view_option_at(); null: not given */
} view_options;

/* Whether one was given. */
bool gives_view_option(const view_options *given, const char *name);

/* Write them where getopt_long will read them, VIEW_OPTIONS at most; returns their number. */
size_t list_view_options(struct option *options);

/* Take an option that getopt_long found; false when it is not an option of a view. */
bool take_view_option(view_options *given, int option);

/* The name of the first of them that was given; null: none was. */
const char *first_view_option(const view_options *given);

/* Apply them to a command's default view; false, with the sentence printed, when a value does not fit. */
bool read_view(const view_options *given, view *v);

/* The part of a --help text that those options share. */
void print_view_options(FILE *out);

/* The renderer: --context and --any-renderer. */
enum { OPTION_CONTEXT = VIEW_OPTION - 2, OPTION_ANY_RENDERER };
bool read_context(const char *text, renderer_choice *choice);
bool check_renderer(const renderer_choice *choice); /* once all options are read */
void print_renderer_options(FILE *out);

#endif
