/* SPDX-License-Identifier: MIT */
/* cmd_verify.c - octreel verify: play a recording again, and say what is not the same. */
#include "command.h"
#include "progress.h"
#include "verify.h"

#include <stdio.h>

static void on_progress(uint64_t done, uint64_t total, void *context)
{
    progress_show(context, done, total);
}

typedef struct arguments {
    renderer_choice renderer;
    bool json;
} arguments;

static const command_option options[] = {
    RENDERER_OPTIONS(arguments, renderer),
    JSON_OPTION(arguments, json, "print JSON"),
    {0},
};

static int verify(const char *folder, const arguments *a)
{
    progress p = progress_start("ticks");
    const verify_options options = {.renderer = a->renderer, .progress = on_progress, .context = &p};
    verify_report report;
    octreel_error error;
    const bool ok = verify_recording(folder, &options, &report, &error);
    progress_end(&p);
    if (!ok)
        return print_error("%s", error.text);
    if (*report.no_gl.text)
        note("the integer rasterizer drew the frames again, because OpenGL cannot be loaded: %s", report.no_gl.text);
    verify_print(stdout, folder, &report, a->json);
    return report.count ? EXIT_FINDING : EXIT_DONE;
}

static int run(int argc, char **argv)
{
    arguments a = {.renderer.fill = DRAW_FILL_GL};
    const int status = command_read_arguments(&command_verify, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    return check_renderer(&a.renderer) ? verify(argv[optind], &a) : EXIT_TROUBLE;
}

const command command_verify = {
    .name = "verify",
    .run = run,
    .options = options,
    .line = "play a recording again: is it still what its session makes?",
    .usage = "RECORDING [OPTION ...]",
    .about = "Play the session of a recording again, let GL alone draw it, and compare tick by tick. It says that all "
             "is identical, or which tick is the first that differs, and in what: the session, what happened (a fact "
             "of ticks.jsonl), what is drawn (the scene), or only its pixels, and then who drew both; and which frames "
             "or lines are missing, torn or too many. Of gaps, ticks that a program which recorded itself could not "
             "hand over, it says how many there are and why; they are no finding. Of a recording without frames the "
             "facts alone are compared. Files are not changed.\n",
    .more =
        "What --json prints:\n"
        "\n"
        "  \"folder\"      the recording\n"
        "  \"identical\"   whether there is no finding\n"
        "  \"ticks\", \"frames\"  how many are the same, before the first tick that differs\n"
        "  \"gaps\"        how many of these ticks are one\n"
        "  \"findings\"    one each at most of the session, the first tick that differs, and files that are too "
        "many. Each says what it is \"in\": \"session\" (session.json is not the one that was filmed), \"view\" "
        "(recording.json has another size than the frames), \"lines\" (ticks.jsonl lacks one, or has one that is "
        "torn or too many), \"facts\" (what happened), \"scene\" (what is drawn), \"frame\" (it is missing, torn, "
        "another one or too many) or \"pixels\"; the \"tick\", where it is of one; the \"fact\", the member of the "
        "tick's line; how many \"pixels\" differ; and the sentence as \"text\"\n"
        "  \"drawn_by\", \"drawn_now\"  the renderer of the recording, and that of now; null where nothing was drawn\n"
        "  \"fill\"        the rasterizer of now: \"gl\", or \"integers\" where OpenGL cannot be loaded; null "
        "likewise\n",
    .statuses = {"identical", "differs", "trouble"},
    .examples = "octreel verify frames\n"
                "octreel verify frames --context egl --json\n",
    .least = 1,
    .most = 1,
    .takes = "the folder of one recording",
    .inputs = {FILE_KIND(RECORDING)},
};
