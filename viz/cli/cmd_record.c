/* cmd_record.c - octreel record: film a session into a folder. */
#include "command.h"
#include "film.h"
#include "film_report.h"
#include "session_file.h"

#include <getopt.h>
#include <stdio.h>

static const char help[] =
    "usage: octreel record [SESSION] -o DIR [OPTION ...]\n\n"
    "Play a session and film it: DIR/frame_000000.png ..., with ticks.jsonl, session.json, recording.json and\n"
    "renderer.json beside them, and index.html, a page that shows all of it. Without SESSION, the paper's own is\n"
    "played.\n\n"
    "  -o, --output DIR      where the recording goes; a new folder, or one without a recording\n"
    "      --keys KEYS       play these keys instead of the session's: w s +-y, d a +-x, e f +-z, n nearest, . wait\n"
    "      --every N         film each N-th tick (ticks.jsonl still has all of them)\n";

static const char more_help[] =
    "      --json            print a summary as JSON on stdout\n"
    "  -h, --help\n\n"
    "Examples: octreel record -o frames\n"
    "          octreel record session.json --keys wwdn --camera orbit --size 640x360 -o frames\n";

typedef struct arguments {
    const char *session, *keys;
    film_options film;
    view_options view;
    bool json;
} arguments;

static const struct option own_options[] = {
    {"output", required_argument, NULL, 'o'},
    {"keys", required_argument, NULL, 'k'},
    {"every", required_argument, NULL, 'e'},
    {"json", no_argument, NULL, 'j'},
    {"help", no_argument, NULL, 'h'},
    {"context", required_argument, NULL, OPTION_CONTEXT},
    {"any-renderer", no_argument, NULL, OPTION_ANY_RENDERER},
    {NULL, 0, NULL, 0},
};

/* False when a value does not fit; the sentence is printed. */
static bool take_option(arguments *a, int option)
{
    if (take_view_option(&a->view, option))
        return true;
    switch (option) {
    case 'o':
        a->film.folder = optarg;
        return true;
    case 'k':
        a->keys = optarg;
        return true;
    case 'e':
        return read_count("--every", optarg, 1, 1000000000, &a->film.every);
    case OPTION_CONTEXT:
        return read_context(optarg, &a->film.renderer);
    case OPTION_ANY_RENDERER:
        return a->film.renderer.any_renderer = true;
    case 'j':
        a->json = true;
        return true;
    default:
        fputs("octreel record --help tells what it takes\n", stderr);
        return false;
    }
}

static void on_progress(uint64_t done, uint64_t total, void *context)
{
    progress_show(context, done, total);
}

static int film_it(arguments *a, const octree_session *session)
{
    progress p = progress_start("ticks");
    film_summary summary;
    record_error error;
    a->film.progress = on_progress;
    a->film.context = &p;
    const bool ok = film_session(session, &a->film, &summary, &error);
    progress_end(&p);
    if (!ok)
        return trouble("%s", error.text);
    film_report(stdout, &summary, &a->film, progress_seconds(&p), a->json);
    return EXIT_DONE;
}

static int play(arguments *a)
{
    session_file file = {0};
    session_error error;
    bool ok;
    if (a->session) {
        ok = session_read(a->session, &file, &error);
    } else {
        const octree_session paper = octree_session_default();
        ok = session_copy(&paper, &file, &error);
    }
    ok = ok && (!a->keys || session_set_keys(&file, a->keys, &error));
    const int status = ok ? film_it(a, &file.session) : trouble("%s", error.text);
    session_release(&file);
    return status;
}

int cmd_record(int argc, char **argv)
{
    arguments a = {.film = {.view = view_default(), .every = 1}};
    struct option options[COMMAND_OPTIONS];
    join_options(own_options, options);
    optind = 1;
    for (int option; (option = getopt_long(argc, argv, "o:h", options, NULL)) != -1;) {
        if (option == 'h') {
            fputs(help, stdout);
            print_view_options(stdout);
            print_renderer_options(stdout);
            fputs(more_help, stdout);
            return EXIT_DONE;
        }
        if (!take_option(&a, option))
            return EXIT_TROUBLE;
    }
    if (argc - optind > 1)
        return trouble("record takes one session, not also \"%s\"", argv[optind + 1]);
    if (!a.film.folder)
        return trouble("record needs a folder for its frames: -o DIR");
    a.session = argv[optind];
    return check_renderer(&a.film.renderer) && read_view(&a.view, &a.film.view) ? play(&a) : EXIT_TROUBLE;
}
