/* SPDX-License-Identifier: MIT */
/* cmd_play.c - octreel play: writes a web page that plays a session. */
#include "command.h"
#include "file.h"
#include "film_report.h"
#include "outputs.h"
#include "played_page.h"
#include "progress.h"
#include "session_file.h"
#include "text.h"
#include "recording_file.h"

#include <ctype.h>
#include <inttypes.h>
#include <limits.h>
#include <string.h>
#include <unistd.h>

typedef struct arguments {
    char *session;           /* the argument SESSION; null: not given */
    const char *keys, *page; /* the value of --keys, and the path of the page; null: not given */
    bool force;
    film_options film;
    view_options view;
} arguments;

static const command_option options[] = {
    {"output", "FILE",
     "the page to write; - is standard output (default: the name of SESSION with .html, in the current folder, or "
     "octreel.html). Without --force, an existing file is overwritten only if octreel made it",
     .read = read_file, OPTION_VALUE(arguments, page)},
    FORCE_OPTION(arguments, force, FORCE_FILES),
    {"keys", "KEYS", "play these keys instead of the session's: " KEYS_HELP, .read = read_text,
     OPTION_VALUE(arguments, keys)},
    MAX_TICKS_OPTION(arguments, film.max_ticks),
    {.help = "How the page looks when it opens:"},
    SHARED_OPTIONS(view_option_row, arguments, view),
    {0},
};

/* ---- Where the page goes ------------------------------------------------------------------------------------- */

/* Makes the default name of the page: "walk.html" for "sessions/walk.json". */
static void make_page_name(const char *session, char name[NAME_MAX + 1])
{
    const char *base = session && !file_is_standard_stream(session) ? path_base_name(session) : "octreel",
               *dot = strrchr(base, '.');
    const size_t length = dot && dot > base ? (size_t)(dot - base) : strlen(base);
    snprintf(name, NAME_MAX + 1, "%.*s.html", (int)length, base);
}

/* Checks that the page overwrites no file, except a page that this command wrote earlier. */
static bool check_page(const arguments *a)
{
    const output_file output = {.option = "-o", .path = a->page};
    return check_outputs(&output, 1, &a->session, a->session != NULL, false, a->force) &&
           check_page_output(&output, a->force);
}

/* Prints a path as a part of a URL (RFC 3986). A byte that a URL cannot contain becomes %XX. */
static void print_url_path(FILE *out, const char *path)
{
    for (const unsigned char *at = (const unsigned char *)path; *at; at++)
        fprintf(out, (isalnum(*at) && *at < 128) || strchr("/-_.~", *at) ? "%c" : "%%%02X", *at);
}

static void print_page_address(const char *page, uint64_t ticks)
{
    char current[PATH_MAX];
    write_escaped(stdout, page, escape_nothing);
    printf(": %" PRIu64 " tick%s; open it in a browser: ", ticks, plural_ending(ticks));
    fputs("file://", stdout);
    if (*page != '/' && getcwd(current, sizeof current)) {
        print_url_path(stdout, current);
        putchar('/');
    }
    print_url_path(stdout, page);
    putchar('\n');
}

/* ---- The page ------------------------------------------------------------------------------------------------ */

/* Writes the page. Returns false with an error if writing fails, or if a signal stops the program. */
static bool write_page(const arguments *a, const octree_session *session, FILE *page, film_summary *summary,
                       octreel_error *error)
{
    return write_played_page(session, &a->film, page, summary, error) &&
           (summary->ticks == summary->total ||
            error_set(error, "stopped after %" PRIu64 " of %" PRIu64 " ticks; no page was written", summary->ticks,
                      summary->total));
}

static bool write_file(const arguments *a, const octree_session *session, film_summary *summary, octreel_error *error)
{
    file_writer file;
    if (!file_writer_open(&file, a->page, error))
        return false;
    return write_page(a, session, file.stream, summary, error) ? file_writer_close(&file, error)
                                                               : file_writer_discard(&file);
}

static int write_page_and_report(arguments *a, const octree_session *session)
{
    progress p = progress_start("ticks");
    film_summary summary;
    octreel_error error;
    a->film.watch.context = &p;
    defer_stop_signals();
    const bool ok = write_file(a, session, &summary, &error);
    progress_end(&p);
    if (ok && !is_quiet())
        film_report_refused_points(stderr, &summary.start, session);
    if (!ok)
        print_error("%s", error.text);
    else if (!file_is_standard_stream(a->page) && !is_quiet())
        print_page_address(a->page, summary.ticks);
    deliver_stop_signal();
    return ok ? EXIT_DONE : EXIT_TROUBLE;
}

static int play_session(arguments *a)
{
    const octree_session paper = octree_session_default();
    session_file file = {0};
    octreel_error error;
    const bool ok = (a->session ? session_read(a->session, &file, &error) : session_copy(&paper, &file, &error)) &&
                    (!a->keys || session_set_keys(&file, a->keys, &error));
    a->film.values = &file.values;
    if (ok && *file.note)
        print_note("%s", file.note);
    const int status = ok ? write_page_and_report(a, &file.session) : print_error("%s", error.text);
    session_release(&file);
    return status;
}

static int run(int argc, char **argv)
{
    arguments a = {.film = {.view = view_make_default(), .watch = {progress_show, has_no_stop_signal, NULL}}};
    char name[NAME_MAX + 1];
    const int status = command_read_arguments(&command_play, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    a.session = argv[optind];
    make_page_name(a.session, name);
    if (!a.page)
        a.page = name;
    if (!a.session)
        a.film.view.diagram = DIAGRAM_BESIDE;
    return read_view(&a.view, &a.film.view) && check_page(&a) ? play_session(&a) : EXIT_TROUBLE;
}

const command command_play = {
    .name = "play",
    .run = run,
    .options = options,
    .line = "make a web page that plays a session, without recording frames",
    .usage = "[SESSION] [-o FILE.html] [OPTION ...]",
    .about = "Write one HTML file that plays a session in a browser and needs no other file. The page draws any tick, "
             "turns and zooms the scene, and names the element under the mouse. With the keys of the game, you play on "
             "from any tick. "
             "Without SESSION, the "
             "example that octreel record films is used. SESSION may be -, standard input; octreel help session "
             "describes the file.\n",
    .statuses = {"the page is written", NULL, "error or stopped; no page is written"},
    .examples = "# write octreel.html, which plays the example\n"
                "octreel play\n"
                "# write walk.html, which starts with an orbiting camera\n"
                "octreel play session.json --camera orbit -o walk.html\n",
    .max_arguments = 1,
    .takes = "one session",
    .inputs = {FILE_KIND(SESSION)},
};
