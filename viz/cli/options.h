/* SPDX-License-Identifier: MIT */
/* options.h - the values of options, and the options that all commands that draw share. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "file.h"
#include "json_table.h"
#include "renderer.h"
#include "image_compare.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct command_option command_option;

/* The n-th option of a table; false beyond the last. */
typedef bool option_table_row(size_t n, command_option *option);

/* Exit statuses. */
enum { EXIT_DONE = 0, EXIT_FINDING = 1, EXIT_TROUBLE = 2 };

/* Print "octreel: " and a sentence on stderr; returns EXIT_TROUBLE. */
int print_error(const char *format, ...);

/* The same for readers of values: returns false. */
bool refuse(const char *format, ...);

/* Whether --quiet was given: nothing is said but what was asked for and errors. */
bool is_quiet(void);

/* Print "octreel: " and a sentence on stderr that is no error, unless all is to be quiet. */
void note(const char *format, ...);

/* Read a value of an option. False, with the sentence printed, where `text` does not fit. */
typedef bool command_option_reader(const command_option *option, const char *text, void *into);

/* What is said about an option, how its value is read, and where it goes. */
struct command_option {
    const char *name;  /* without dashes. Null: `help` is a paragraph between options, or `more` is set; a zeroed row
                        * ends  a table */
    const char *value; /* what stands for its value; null: it takes none. FILE and DIR are files and folders, LIST
                        * several of `names` with commas between */
    const char *help;
    command_option_reader *read;
    size_t offset, size;    /* of the value in the command's arguments */
    uint64_t min, max;      /* of a whole number */
    json_name *names;       /* what the value may be; null: anything that `read` takes */
    json_name *words;       /* what each of these is; null: it is told elsewhere */
    option_table_row *more; /* the options of a table that commands share stand here; what they read goes to `offset` */
};

#define OPTION_VALUE(type, member) .offset = offsetof(type, member), .size = sizeof(((type *)NULL)->member)

/* The letter that may stand for the option, 0: none. */
char option_letter(const char *name);

/* As it is typed: "--every", "-o". */
#define OPTION_TYPED 32
const char *option_as_typed(const command_option *option, char text[OPTION_TYPED]);

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
command_option_reader read_fill;    /* draw_fill, by its name */
command_option_reader read_quiet;   /* nothing: --quiet */

#define JSON_OPTION(type, member, text)                                                                                \
    {                                                                                                                  \
        "json", NULL, text, .read = read_flag, OPTION_VALUE(type, member)                                              \
    }

#define FILL_OPTION(type, member)                                                                                      \
    {                                                                                                                  \
        "fill", "WITH", "the rasterizer; the pixels are the same (--any-renderer implies gl): one of",                 \
            .read = read_fill, OPTION_VALUE(type, member), .names = draw_fill_at, .words = draw_fill_words_at          \
    }

/* Whether a path without an option can be meant for -o, by the option's reader. */
bool fits_output_option(command_option_reader *reader, const char *path);

/* The keys of a game, which --keys takes. */
#define KEYS_HELP "w s +-y, d a +-x, e f +-z, n nearest, . wait, q end"

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
#define MOST_VIEW_OPTIONS 32
typedef struct view_options {
    const char *values[MOST_VIEW_OPTIONS]; /* as they were typed, at the numbers of view_option_at(); null: not given */
} view_options;

option_table_row view_option_row;
#define VIEW_OPTIONS(type, member)                                                                                     \
    {                                                                                                                  \
        .more = view_option_row, OPTION_VALUE(type, member)                                                            \
    }

/* Whether one was given. */
bool has_view_option(const view_options *given, const char *name);

/* The name of the first of them that was given; null: none was. */
const char *first_view_option(const view_options *given);

/* Apply them to a command's default view; false, with the sentence printed, when a value does not fit. */
bool read_view(const view_options *given, view *v);

/* The renderer: --context and --any-renderer. */
option_table_row renderer_option_row;
#define RENDERER_OPTIONS(type, member)                                                                                 \
    {                                                                                                                  \
        .more = renderer_option_row, OPTION_VALUE(type, member)                                                        \
    }

/* Once all options are read: false, with the sentence printed, where they do not go together. */
bool check_renderer(const renderer_choice *choice);

json_name draw_fill_at, draw_fill_words_at;

#endif
