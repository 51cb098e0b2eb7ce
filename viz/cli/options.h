/* SPDX-License-Identifier: MIT */
/* options.h - the options of commands: how their values are read, and the tables of options that commands share. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "file.h"
#include "json_table.h"
#include "renderer.h"
#include "image_compare.h"
#include "session_file.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct command_option command_option;

/* Fills in the n-th option of a table. Returns false if n is beyond the last. */
typedef bool option_table_row(size_t n, command_option *option);

/* The exit statuses of the program. */
enum { EXIT_DONE = 0, EXIT_FINDING = 1, EXIT_TROUBLE = 2 };

/* Prints "octreel: " and a sentence on standard error. Returns EXIT_TROUBLE. */
int print_error(const char *format, ...);

/* Prints "octreel: " and a sentence on standard error. Returns false, for functions that return bool. */
bool print_refusal(const char *format, ...);

/* Prints an error: the option does not take the value `text`. `takes` describes valid values: "a colour such as
 * ff8000". Returns false. */
bool refuse_value(const command_option *option, const char *takes, const char *text);

/* Returns whether --quiet was given. With --quiet, only results and errors are printed. */
bool is_quiet(void);

/* Prints "octreel: " and a note on standard error. A note is not an error: with --quiet it is not printed. */
void print_note(const char *format, ...);

/* Reads the value of an option from `text` into `into`. If the value is invalid, prints an error and returns false. */
typedef bool command_option_reader(const command_option *option, const char *text, void *into);

/* A row of an option table: the name and help of an option, how its value is read, and where the value is stored. */
struct command_option {
    /* The name of the option without dashes. If the name is null, `more` is set, or `help` is a heading for the options
     * below it. A zeroed row ends the table. */
    const char *name;
    /* The placeholder of the option's value in --help. Null: the option takes no value. The placeholder also says how
     * shells complete the value: FILE by a file, DIR by a folder, LIST by names separated by commas. */
    const char *value;
    const char *help;
    command_option_reader *read;
    /* Where the value is stored: offset and size of a member in the structure of the command's arguments. */
    size_t offset, size;
    uint64_t min, max;      /* the smallest and the largest value, if the value is a whole number */
    json_name *names;       /* the possible values of the option; null: any value that `read` accepts */
    json_name *words;       /* the meaning of each value in `names`; null: `help` explains the values */
    option_table_row *more; /* a shared table that is inserted here; `offset` is added to the offsets in that table */
};

#define OPTION_VALUE(type, member) .offset = offsetof(type, member), .size = sizeof(((type *)NULL)->member)

/* Returns the letter of an option, such as 'o' for "output"; 0 if the option has no letter. */
char option_letter(const char *name);

bool is_folder(const char *path);

command_option_reader read_flag;   /* for a bool: sets it to true; the option takes no value */
command_option_reader read_text;   /* for a const char *: takes any text */
command_option_reader read_name;   /* for a const char *: takes the path of a file or folder; refuses "" */
command_option_reader read_folder; /* for a const char *: takes the path of a folder to write; refuses names of files */
/* For a const char *: takes the path of a PNG file to write. Refuses folders and names of other files. "-" is standard
 * output and is refused if standard output is a terminal. */
command_option_reader read_picture;
/* As read_picture, and also takes the path of a page, which ends with .html. */
command_option_reader read_picture_or_page;
/* For a const char *: takes the path of an animated PNG or a video to write, under the rules of read_picture. */
command_option_reader read_film;
/* For a const char *: takes the path of a text file to write. Refuses folders and names of pictures. "-" is standard
 * output. */
command_option_reader read_file;
command_option_reader read_whole;  /* for an unsigned integer of option->size bytes */
command_option_reader read_color;  /* for an image_color: takes RRGGBB or #RRGGBB */
command_option_reader read_choice; /* for an enumeration: takes one of the names in `names` */
command_option_reader read_quiet;  /* for --quiet: is_quiet() then returns true */

/* A table row that inserts the shared table `table`. The values of its options are stored in the structure `member`. */
#define SHARED_OPTIONS(table, type, member)                                                                            \
    {                                                                                                                  \
        .more = table, OPTION_VALUE(type, member)                                                                      \
    }

#define JSON_OPTION(type, member, text)                                                                                \
    {                                                                                                                  \
        "json", NULL, text, .read = read_flag, OPTION_VALUE(type, member)                                              \
    }

#define FLAT_OPTION(type, member)                                                                                      \
    {                                                                                                                  \
        "no-recursive", NULL, "use only the PNGs directly in a folder, not those in its subfolders",                   \
            .read = read_flag, OPTION_VALUE(type, member)                                                              \
    }

#define FILL_OPTION(type, member)                                                                                      \
    {                                                                                                                  \
        "fill", "WITH", "the rasterizer, which does not change the pixels (--any-renderer implies gl): one of",        \
            .read = read_choice, OPTION_VALUE(type, member), .names = draw_fill_name, .words = draw_fill_words_at      \
    }

/* Turns the number that a macro defines into text. */
#define NUMBER_AS_TEXT(number) LITERAL_AS_TEXT(number)
#define LITERAL_AS_TEXT(number) #number

#define MAX_TICKS_OPTION(type, member)                                                                                 \
    {                                                                                                                  \
        "max-ticks", "N", "play sessions of up to N ticks (default " NUMBER_AS_TEXT(SESSION_MOST_PLAYED) ")",          \
            .read = read_whole, OPTION_VALUE(type, member), .min = 1, .max = SESSION_LAST_TICK                         \
    }

/* Reads a range of ticks: "100:200", "100:" or ":200". *last is exclusive. If the range is invalid, prints an error and
 * returns false. */
bool read_tick_range(const command_option *option, const char *text, uint64_t *first, uint64_t *last);

/* Returns whether -o would accept this path; `reader` is the function that reads the value of -o. If a surplus argument
 * is such a path, the user may have forgotten to type -o. */
bool fits_output_option(command_option_reader *reader, const char *path);

/* The player's keys and their effects, for the help text of --keys. */
#define KEYS_HELP "w s +-y, d a +-x, e f +-z, n nearest, . wait, q end"

/* Checks that no file name is empty. If a name is empty, prints an error and returns false. */
bool check_names_not_empty(const char *command, char *const *names, int count);

/* Reads a whole number from an argument that is not the value of an option. If the number is invalid, prints an error
 * and returns false. */
bool read_count(const char *name, const char *text, uint64_t min, uint64_t max, uint64_t *value);

/* The view options on the command line. Every command that draws has the same view options. While the command line is
 * read, only the texts of their values are collected. read_view() parses these texts later, because the values change
 * the command's default view. */
#define MOST_VIEW_OPTIONS 32
typedef struct view_options {
    const char *values[MOST_VIEW_OPTIONS]; /* the text of the option view_option_at(i); null: not given */
} view_options;

option_table_row view_option_row;

/* Returns whether the view option with this name was given. */
bool has_view_option(const view_options *given, const char *name);

/* Returns the name of the first view option that was given, or null. */
const char *find_first_view_option(const view_options *given);

/* Changes *v, the command's default view, by the given options. If a value is invalid, prints an error and returns
 * false. */
bool read_view(const view_options *given, view *v);

/* The table of the options --context and --any-renderer. */
option_table_row renderer_option_row;

/* Checks that --fill, --context and --any-renderer do not contradict each other. If they do, prints an error and
 * returns false. Call this after all options were read. */
bool check_renderer(const renderer_choice *choice);

json_name draw_fill_words_at;

#endif
