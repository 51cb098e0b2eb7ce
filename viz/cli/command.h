/* command.h - the commands of octreel, and what their command lines share. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include "draw.h"
#include "image.h"
#include "octree/game.h"

#include <getopt.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Exit statuses. */
enum { EXIT_DONE = 0, EXIT_FINDING = 1, EXIT_TROUBLE = 2 };

typedef struct command {
    const char *name;
    int (*run)(int argc, char **argv); /* argv[0] is the command's name */
    const char *line;                  /* what it does, in one line */
} command;

int cmd_record(int argc, char **argv);
int cmd_join(int argc, char **argv);
int cmd_inspect(int argc, char **argv);
int cmd_verify(int argc, char **argv);
int cmd_pick(int argc, char **argv);
int cmd_diff(int argc, char **argv);
int cmd_digest(int argc, char **argv);
int cmd_accept(int argc, char **argv);

/* "octreel: " and a sentence on stderr; EXIT_TROUBLE. */
int trouble(const char *format, ...);

/* Values of options: each says what is wrong with `text` on stderr and returns false when it does not fit. */
bool read_count(const char *option, const char *text, uint64_t min, uint64_t max, uint64_t *value);
bool read_box(const char *option, const char *text, octree_box *box);                  /* six numbers, min <= max */
bool read_rectangle(const char *option, const char *text, image_rectangle *rectangle); /* left, top, width, height */
bool read_color(const char *option, const char *text, image_color *color);             /* RRGGBB or #RRGGBB */
bool read_part(const char *option, const char *text, double *value);                   /* 0 to 1 */
bool read_ticks(const char *text, uint64_t *first, uint64_t *last);                    /* A:B, A: or :B; first < last */

/* A query as in --nearest X,Y,Z[,K], --radius X,Y,Z,R and --range x0,y0,z0,x1,y1,z1. */
bool read_nearest(const char *text, octree_query *query);
bool read_radius(const char *text, octree_query *query);
bool read_range(const char *text, octree_query *query);

/* The options of a view are the same for every command that draws. They are collected while the command line is read,
 * and then become a view. */
#define VIEW_OPTION 256 /* the first of getopt's numbers for them */
#define VIEW_OPTIONS 16 /* at most */
typedef struct view_options {
    const char *values[VIEW_OPTIONS]; /* as they were typed; null: not given */
} view_options;

/* A command's own options, which end with a zeroed one, and behind them those of a view, for getopt_long. */
#define COMMAND_OPTIONS 48
void join_options(const struct option *own, struct option all[COMMAND_OPTIONS]);

/* Take an option that getopt_long found; false when it is none of a view's. */
bool take_view_option(view_options *given, int option);

/* Whether any of them was given. */
bool has_view_option(const view_options *given);

/* Change a command's own default view to the one that was asked for; false, with the sentence said, when a value does
 * not fit. */
bool read_view(const view_options *given, view *v);

/* The part of a --help text that those options share. */
void print_view_options(FILE *out);

/* Who draws: --context and --any-renderer, which every command that draws has among its own options. */
enum { OPTION_CONTEXT = VIEW_OPTION - 2, OPTION_ANY_RENDERER };
bool read_context(const char *text, renderer_choice *choice);
bool check_renderer(const renderer_choice *choice); /* once all options are read */
void print_renderer_options(FILE *out);

/* A bar on stderr when that is a terminal, nothing otherwise. `done` of `total` items of this name. */
typedef struct progress {
    const char *unit;
    double started, shown; /* seconds of the monotonic clock; 0: not yet */
    double part;           /* that was shown last, 0 to 1 */
    bool visible;
} progress;

progress progress_start(const char *unit);
void progress_show(progress *p, uint64_t done, uint64_t total);
void progress_end(progress *p);

/* Beside the bar, which stays where it is: what is done now, for a work that cannot be counted. */
void progress_say(progress *p, const char *format, ...);

/* Seconds since it was started. */
double progress_seconds(const progress *p);

/* A long work that is watched: its progress is shown, and the signals that ask to end it (SIGHUP, SIGINT, SIGTERM,
 * where they are not ignored) are held back. No handler and no global: whoever works asks whether one is waiting. */
typedef struct watch {
    progress progress;
    sigset_t held, before;
} watch;

watch watch_begin(const char *unit);

/* For who works: progress, and whether to keep going; the context is the watch. */
void watch_progress(uint64_t done, uint64_t total, void *context);
bool watch_keep_going(void *context);

/* Hold signals back no longer. One that waits ends the program by that signal, as its sender expects. */
void watch_end(const watch *w);

#endif
