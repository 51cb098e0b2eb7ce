/* SPDX-License-Identifier: MIT */
/* cmd_film.c - octreel film: makes one film of a folder's frames. */
#include "animate.h"
#include "command.h"
#include "number.h"
#include "outputs.h"
#include "progress.h"
#include "text.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct arguments {
    const char *folder;
    output_file output;
    frame_choice choice;
    uint64_t rate;
    animation_options film;
    bool force;
} arguments;

static bool read_ticks(const command_option *option, const char *text, void *into)
{
    frame_choice *choice = into;
    return read_tick_range(option, text, &choice->first, &choice->last);
}

static bool read_crop(const command_option *option, const char *text, void *into)
{
    animation_options *film = into;
    uint64_t numbers[4] = {0};
    const char *at = text;
    bool ok = true;
    for (int i = 0; ok && i < 4; i++)
        ok = whole_number_parse(&at, IMAGE_MAX_SIDE, &numbers[i]) && *at++ == (i < 3 ? ',' : 0);
    if (!ok || numbers[2] == 0 || numbers[3] == 0)
        return refuse_value(option,
                            "the left, the top, the width and the height of a rectangle in pixels, such as "
                            "0,0,640,360",
                            text);
    film->left = (int)numbers[0];
    film->top = (int)numbers[1];
    film->width = (int)numbers[2];
    film->height = (int)numbers[3];
    return true;
}

static const command_option options[] = {
    {"output", "FILE",
     "the film: an animated PNG (.png, .apng, or - for standard output), or a video by ffmpeg (.mp4, .webm)",
     .read = read_film, OPTION_VALUE(arguments, output.path)},
    {"ticks", "A:B",
     "show only the ticks from A to B - 1. The range A: ends with the last tick, and the range :B begins with the "
     "first. In a folder that "
     "is not a recording, the pictures are numbered from 0",
     .read = read_ticks, OPTION_VALUE(arguments, choice)},
    {"every", "N", "show only every N-th of the chosen frames", .read = read_whole,
     OPTION_VALUE(arguments, choice.every), .min = 1, .max = 1000000000},
    {"speed", "N", "frames per second, 1 to " NUMBER_AS_TEXT(ANIMATION_MOST_RATE) " (default 15)", .read = read_whole,
     OPTION_VALUE(arguments, rate), .min = 1, .max = ANIMATION_MOST_RATE},
    {"crop", "X,Y,W,H", "show only the W x H pixels whose top left corner is (X, Y)", .read = read_crop,
     OPTION_VALUE(arguments, film)},
    FORCE_OPTION(arguments, force, FORCE_FILES),
    {0},
};

static void report_missing_frames(const animation_frames *list)
{
    if (list->missing > 0)
        print_note("%" PRIu64 " frame%s missing, the first after %s %" PRIu64 "; the film leaves %s out", list->missing,
                   list->missing == 1 ? " is" : "s are", list->are_ticks ? "tick" : "picture", list->missing_after,
                   list->missing == 1 ? "it" : "them");
}

static void report_film(const arguments *a, const animation_summary *s)
{
    FILE *out = is_standard_output_taken(&a->output, 1) ? stderr : stdout;
    if (is_quiet())
        return;
    write_escaped(out, file_output_display_name(a->output.path), escape_nothing);
    fprintf(out, ": %zu frame%s, %d x %d pixels, %.1f s", s->frames, plural_ending(s->frames), s->width, s->height,
            (double)s->frames / a->film.rate);
    if (s->stored < s->frames)
        fprintf(out, "; %zu equal%s the previous frame", s->frames - s->stored, verb_ending(s->frames - s->stored));
    if (s->colors == 0 && !animation_is_video(a->output.path))
        fputs("; more than 256 colours, so the film has no palette", out);
    putc('\n', out);
}

static int make_film(const arguments *a, const animation_frames *list)
{
    progress p = progress_start("frames");
    animation_options film = a->film;
    animation_summary summary;
    octreel_error error;
    film.watch = (watcher){progress_show, has_no_stop_signal, &p};
    defer_stop_signals();
    const bool ok = animate(list, &film, a->output.path, &summary, &error), whole = ok && summary.frames > 0;
    progress_end(&p);
    if (!ok)
        print_error("%s", error.text);
    else if (!whole)
        print_error("stopped; %s was not written", file_output_display_name(a->output.path));
    else
        report_film(a, &summary);
    deliver_stop_signal();
    return whole ? EXIT_DONE : EXIT_TROUBLE;
}

/* Checks that the output overwrites none of the frames that are read. Other files in the folder are not inputs, because
 * a film may lie beside the frames. */
static bool check_output(const arguments *a, const animation_frames *list)
{
    char **inputs = malloc(list->count * sizeof *inputs);
    if (!inputs)
        return print_refusal("out of memory");
    for (size_t i = 0; i < list->count; i++)
        inputs[i] = list->frames[i].path;
    const bool ok = check_outputs(&a->output, 1, inputs, (int)list->count, false, a->force);
    free(inputs);
    return ok;
}

static int run(int argc, char **argv)
{
    arguments a = {.output.option = "-o", .rate = 15};
    animation_frames list;
    octreel_error error;
    const int status = command_read_arguments(&command_film, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    if (!a.output.path)
        return print_error("film needs a file for the film: add -o film.png");
    if (!animation_frames_read(argv[optind], &a.choice, &list, &error))
        return print_error("%s", error.text);
    a.film.rate = (uint16_t)a.rate;
    report_missing_frames(&list);
    const int result = check_output(&a, &list) ? make_film(&a, &list) : EXIT_TROUBLE;
    animation_frames_release(&list);
    return result;
}

const command command_film = {
    .name = "film",
    .run = run,
    .options = options,
    .line = "make one file of a recording's frames: an animated PNG or a video",
    .usage = "DIR -o FILE [OPTION ...]",
    .about = "Show the frames of a recording, or the PNG files of any folder in the order of their names, as one film. "
             "An animated PNG plays in browsers, also on a page of GitHub; other programs show its first frame. It has "
             "the pixels of the frames, repeats for ever, and has the same bytes on every machine. Transparent pixels "
             "become white. Videos need the program ffmpeg, and their pixels are not exact.\n",
    .more = "The frames must have one size. Ticks without a frame are left out. A frame equal to the previous one "
            "takes no space: the previous one is shown longer. Other frames store only the rectangle that changed. If "
            "all frames together have more than "
            "256 colours, an animated PNG has no palette and is larger. Ctrl-C stops without writing a file.\n",
    .statuses = {"the film is written", NULL, "error or stopped; no film is written"},
    .examples = "# make an animated PNG of the example\n"
                "octreel record -o flight\n"
                "octreel film flight -o film.png\n"
                "# show ticks 72 to 135 of a recording, slower than usual, and only the left half\n"
                "octreel film flight --ticks 72:136 --speed 10 --crop 0,0,640,720 -o part.png\n"
                "# make a video with ffmpeg\n"
                "octreel film flight -o film.mp4\n",
    .min_arguments = 1,
    .max_arguments = 1,
    .takes = "the folder of one recording, or a folder of PNG files",
    .inputs = {FILE_KIND(RECORDING) | FILE_KIND(FOLDER)},
};
