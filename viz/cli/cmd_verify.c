/* SPDX-License-Identifier: MIT */
/* cmd_verify.c - octreel verify: replays a recording and reports the first difference. */
#include "command.h"
#include "progress.h"
#include "verify.h"

#include <stdio.h>

typedef struct arguments {
    renderer_choice renderer;
    uint64_t max_ticks;
    bool json;
} arguments;

static const command_option options[] = {
    SHARED_OPTIONS(renderer_option_row, arguments, renderer),
    MAX_TICKS_OPTION(arguments, max_ticks),
    JSON_OPTION(arguments, json, "print JSON"),
    {0},
};

static int verify_and_report(const char *folder, const arguments *a)
{
    progress p = progress_start("ticks");
    const verify_options options = {
        .renderer = a->renderer, .max_ticks = a->max_ticks, .watch = {progress_show, NULL, &p}};
    verify_report report;
    octreel_error error;
    const bool ok = verify_recording(folder, &options, &report, &error);
    progress_end(&p);
    if (!ok)
        return print_error("%s", error.text);
    if (*report.no_gl.text)
        print_note("the integer rasterizer drew the frames again, because OpenGL cannot be loaded: %s",
                   report.no_gl.text);
    verify_print(stdout, folder, &report, a->json);
    return report.count ? EXIT_FINDING : EXIT_DONE;
}

static int run(int argc, char **argv)
{
    arguments a = {.renderer.fill = DRAW_FILL_GL};
    const int status = command_read_arguments(&command_verify, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    return check_renderer(&a.renderer) ? verify_and_report(argv[optind], &a) : EXIT_TROUBLE;
}

const command command_verify = {
    .name = "verify",
    .run = run,
    .options = options,
    .line = "replay a recording and check that every tick and frame is identical",
    .usage = "RECORDING [OPTION ...]",
    .about =
        "Replay the session of a recording, redraw every frame with OpenGL, and compare tick by tick. The result is "
        "that everything is identical, or it names the first tick that differs and the difference: the session, the "
        "facts of the tick in ticks.jsonl, the scene (the drawn elements), or only the pixels. If only pixels differ, "
        "it names the renderers of the recording and of this run. It also names missing, incomplete and surplus frames "
        "and lines. A gap is a tick that a program which records itself could not supply. Gaps are counted with their "
        "reason and are not findings. A recording without frames is checked by "
        "its ticks. No file is changed.\n",
    .more = "Members of the JSON of --json:\n"
            "\n"
            "  \"folder\"      the recording\n"
            "  \"identical\"   true if there are no findings\n"
            "  \"ticks\", \"frames\"  number of identical ticks and frames before the first difference\n"
            "  \"gaps\"        number of these ticks that are gaps\n"
            "  \"findings\"    at most one for the session, one for the first tick that differs, and one for surplus "
            "files. \"in\" is the place: \"session\" (session.json is not the one that was filmed), \"view\" "
            "(recording.json and the frames have different sizes), \"lines\" (ticks.jsonl has a missing, incomplete or "
            "surplus line), \"facts\" (what happened), \"scene\" (what is drawn), \"frame\" (missing, incomplete, "
            "surplus, or a picture of another tick) or \"pixels\". \"tick\" is the tick, \"fact\" the member of the "
            "tick's line, \"pixels\" the number of different pixels, and \"text\" a sentence; each is present where "
            "it applies\n"
            "  \"drawn_by\", \"drawn_now\"  the renderer of the recording and of this run; null if nothing was drawn\n"
            "  \"fill\"        the rasterizer of this run: \"gl\", or \"integers\" if OpenGL cannot be loaded; null if "
            "nothing was drawn\n",
    .statuses = {"identical", "different", "error"},
    .examples = "# check a recording\n"
                "octreel verify frames\n"
                "# check it with EGL, and print JSON\n"
                "octreel verify frames --context egl --json\n",
    .min_arguments = 1,
    .max_arguments = 1,
    .takes = "the folder of one recording",
    .inputs = {FILE_KIND(RECORDING)},
};
