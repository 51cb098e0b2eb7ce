/* SPDX-License-Identifier: MIT */
/* options.h - the options of commands: how their values are read, and the tables of options that commands share. */
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

/* Fills in the n-th option of a table. False: n is beyond the last. */
typedef bool option_table_row(size_t n, command_option *option);

/* Exit statuses. */
enum { EXIT_DONE = 0, EXIT_FINDING = 1, EXIT_TROUBLE = 2 };

/* Print "octreel: " and a sentence on standard error. Returns EXIT_TROUBLE. */
int print_error(const char *format, ...);

/* The same for functions that return bool. Returns false. */
bool refuse(const char *format, ...);

/* Print that an option takes another value than `text`: `takes` is "a colour such as ff8000". Returns false. */
bool refuse_value(const command_option *option, const char *takes, const char *text);

/* True if --quiet was given: only results and errors are printed. */
bool is_quiet(void);

/* Print "octreel: " and a note, which is not an error, on standard error, unless --quiet was given. */
void note(const char *format, ...);

/* Read the value of an option into `into`. False, with an error printed, if `text` does not fit. */
typedef bool command_option_reader(const command_option *option, const char *text, void *into);

/* A row of an option table: the name and help of an option, how its value is read, and where the value goes. */
struct command_option {
    const char *name;  /* without dashes. Null: `help` is a heading for the options below it, or `more` is set. A zeroed
                        * row ends a table */
    const char *value; /* placeholder of the value in --help; null: the option takes no value. Completion offers files
                        * for FILE, folders for DIR, and names separated by commas for LIST */
    const char *help;
    command_option_reader *read;
    size_t offset, size;    /* of the value in the structure of the command's arguments */
    uint64_t min, max;      /* limits of a whole number */
    json_name *names;       /* the possible values; null: `read` decides */
    json_name *words;       /* the meaning of each value; null: `help` says it */
    option_table_row *more; /* inserts a shared table here; its offsets start at `offset` */
};

#define OPTION_VALUE(type, member) .offset = offsetof(type, member), .size = sizeof(((type *)NULL)->member)

/* The short form of an option, such as 'o' for "output"; 0: it has none. */
char option_letter(const char *name);

/* An option as the user types it: "--every" or "-o". */
typedef struct typed_option {
    char text[32];
} typed_option;

typed_option option_as_typed(const command_option *option);

bool is_folder(const char *path);

command_option_reader read_flag;    /* bool: the option takes no value */
command_option_reader read_text;    /* const char *: any text */
command_option_reader read_name;    /* const char *: a file or folder; refuses "" */
command_option_reader read_folder;  /* const char *: a folder to write; refuses names of files */
command_option_reader read_picture; /* const char *: a PNG to write; refuses folders and names of other files. "-" is
                                     * standard output, unless that is a terminal */
command_option_reader read_file;    /* const char *: a text file to write; refuses folders and names of pictures. "-" is
                                     * standard output */
command_option_reader read_whole;   /* an integer type */
command_option_reader read_color;   /* image_color, as RRGGBB or #RRGGBB */
command_option_reader read_choice;  /* an enumeration, by its name in `names` */
command_option_reader read_quiet;   /* sets is_quiet() */

/* Inserts a shared table, whose options set parts of this member. */
#define SHARED_OPTIONS(table, type, member)                                                                            \
    {                                                                                                                  \
        .more = table, OPTION_VALUE(type, member)                                                                      \
    }

#define JSON_OPTION(type, member, text)                                                                                \
    {                                                                                                                  \
        "json", NULL, text, .read = read_flag, OPTION_VALUE(type, member)                                              \
    }

#define FILL_OPTION(type, member)                                                                                      \
    {                                                                                                                  \
        "fill", "WITH", "the rasterizer; the pixels are the same (--any-renderer implies gl): one of",                 \
            .read = read_choice, OPTION_VALUE(type, member), .names = draw_fill_name, .words = draw_fill_words_at      \
    }

/* True if -o, whose value `reader` reads, would take this path: the user may have forgotten to type -o. */
bool fits_output_option(command_option_reader *reader, const char *path);

/* The keys of a game, which --keys takes. */
#define KEYS_HELP "w s +-y, d a +-x, e f +-z, n nearest, . wait, q end"

/* False, with an error printed, if one of the names is empty. */
bool check_names_not_empty(const char *command, char *const *names, int count);

/* False, with an error printed, if more than one output goes to standard output. `json`: a JSON report goes there. */
bool check_standard_output(const output_file *outputs, size_t count, bool json);

/* True if one of the outputs goes to standard output: reports then go to standard error or are left out. */
bool is_standard_output_taken(const output_file *outputs, size_t count);

/* Read a whole number that is an argument and not an option. False, with an error printed, if it does not fit. */
bool read_count(const char *name, const char *text, uint64_t min, uint64_t max, uint64_t *value);

/* View options are the same for every command that draws. Their texts are collected while the command line is read, and
 * parsed afterwards by read_view(), which needs the command's default view. */
#define MOST_VIEW_OPTIONS 32
typedef struct view_options {
    const char *values[MOST_VIEW_OPTIONS]; /* the text of option view_option_at(i), or null */
} view_options;

option_table_row view_option_row;

/* True if this option was given. */
bool has_view_option(const view_options *given, const char *name);

/* The name of the first view option that was given, or null. */
const char *find_first_view_option(const view_options *given);

/* Apply the given options to a command's default view. False, with an error printed, if a value does not fit. */
bool read_view(const view_options *given, view *v);

/* The options --context and --any-renderer. */
option_table_row renderer_option_row;

/* Call after all options are read. False, with an error printed, if --any-renderer and --context contradict. */
bool check_renderer(const renderer_choice *choice);

json_name draw_fill_words_at;

#endif
