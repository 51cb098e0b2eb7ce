/* cmd_verify.c - octreel verify: play a recording again, and say what is not the same. */
#include "command.h"
#include "options.h"
#include "progress.h"
#include "verify.h"

#include <stdio.h>

static const char help[] =
    "usage: octreel verify RECORDING [OPTION ...]\n\n"
    "Play the session of a recording again, draw it as it was drawn, and compare tick by tick. It says that all is\n"
    "identical, or which tick is the first that differs, and in what: the session, what happened (a fact of\n"
    "ticks.jsonl), what is drawn (the scene), or only its pixels, and then who drew both; and which frames or lines "
    "are\n"
    "missing, torn or too many. Files are not changed.\n\n";

static const char more_help[] = "      --json            print JSON\n"
                                "  -h, --help\n\n"
                                "Exit status: 0 identical, 1 differs, 2 trouble.\n"
                                "Examples: octreel verify frames\n"
                                "          octreel verify frames --context egl --json\n";

typedef struct arguments {
    const char *folder;
    verify_options verify;
    bool json;
} arguments;

static const struct option options[] = {
    {"context", required_argument, NULL, OPTION_CONTEXT},
    {"any-renderer", no_argument, NULL, OPTION_ANY_RENDERER},
    {"json", no_argument, NULL, 'j'},
    {"help", no_argument, NULL, 'h'},
    {NULL, 0, NULL, 0},
};

static bool take_option(arguments *a, int option)
{
    switch (option) {
    case OPTION_CONTEXT:
        return read_context(optarg, &a->verify.renderer);
    case OPTION_ANY_RENDERER:
        return a->verify.renderer.any_renderer = true;
    case 'j':
        return a->json = true;
    default:
        fputs("octreel verify --help tells what it takes\n", stderr);
        return false;
    }
}

static void on_progress(uint64_t done, uint64_t total, void *context)
{
    progress_show(context, done, total);
}

static int verify_it(arguments *a)
{
    progress p = progress_start("ticks");
    verify_report report;
    octreel_error error;
    a->verify.progress = on_progress;
    a->verify.context = &p;
    const bool ok = verify_recording(a->folder, &a->verify, &report, &error);
    progress_end(&p);
    if (!ok)
        return trouble("%s", error.text);
    verify_print(stdout, a->folder, &report, a->json);
    return report.count ? EXIT_FINDING : EXIT_DONE;
}

int cmd_verify(int argc, char **argv)
{
    arguments a = {0};
    optind = 1;
    for (int option; (option = getopt_long(argc, argv, "h", options, NULL)) != -1;) {
        if (option == 'h') {
            fputs(help, stdout);
            print_renderer_options(stdout);
            fputs(more_help, stdout);
            return EXIT_DONE;
        }
        if (!take_option(&a, option))
            return EXIT_TROUBLE;
    }
    if (argc - optind != 1)
        return trouble("verify takes the folder of one recording; octreel verify --help tells more");
    a.folder = argv[optind];
    return check_names("verify", argv + optind, 1) && check_renderer(&a.verify.renderer) ? verify_it(&a) : EXIT_TROUBLE;
}
