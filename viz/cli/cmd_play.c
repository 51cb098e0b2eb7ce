/* SPDX-License-Identifier: MIT */
/* cmd_play.c - octreel play: a session becomes a page that plays it. */
#include "command.h"
#include "file.h"
#include "film_report.h"
#include "folder.h"
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
    const char *session, *keys, *page; /* null: not given */
    film_options film;
    view_options view;
} arguments;

static const command_option options[] = {
    {"output", "FILE",
     "where the page goes; - is standard output (default: SESSION's name with .html in the current folder, or "
     "octreel.html). A page of octreel play is replaced, and nothing else",
     .read = read_file, OPTION_VALUE(arguments, page)},
    {"keys", "KEYS", "play these keys instead of the session's: " KEYS_HELP, .read = read_text,
     OPTION_VALUE(arguments, keys)},
    VIEW_OPTIONS(arguments, view),
    {0},
};

/* ---- Where the page goes ------------------------------------------------------------------------------------- */

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* "walk.html" of "sessions/walk.json". */
static void name_page(const char *session, char name[NAME_MAX + 1])
{
    const char *base = session && !file_is_standard(session) ? base_name(session) : "octreel",
               *dot = strrchr(base, '.');
    const size_t length = dot && dot > base ? (size_t)(dot - base) : strlen(base);
    snprintf(name, NAME_MAX + 1, "%.*s.html", (int)length, base);
}

static bool is_of_recording(const char *path)
{
    char beside[PATH_MAX];
    const char *base = base_name(path);
    snprintf(beside, sizeof beside, "%.*srecording.json", (int)(base - path), path);
    return folder_is_name(base) && access(beside, F_OK) == 0;
}

/* Only a page of this command is written over. */
static bool check_page(const arguments *a)
{
    const output_file output = {"-o", a->page};
    octreel_error error;
    if (file_is_standard(a->page))
        return true;
    if (a->session && !check_output_is_not_input(&output, a->session, &error))
        return refuse("%s", error.text);
    if (is_of_recording(a->page))
        return refuse("%s: is the page of a recording: choose another name (-o)", a->page);
    struct stat status;
    const bool there = stat(a->page, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0;
    return !there || file_kind_of(a->page) == KIND_PAGE ||
           refuse("%s: is there already, and no page of octreel's: choose another name (-o)", a->page);
}

/* As an address has it. */
static void put_encoded(FILE *out, const char *path)
{
    for (const unsigned char *at = (const unsigned char *)path; *at; at++)
        fprintf(out, (isalnum(*at) && *at < 128) || strchr("/-_.~", *at) ? "%c" : "%%%02X", *at);
}

static void tell(const char *page, uint64_t ticks)
{
    char current[PATH_MAX];
    write_escaped(stdout, page, escape_nothing);
    printf(": %" PRIu64 " tick%s; open it in a browser: ", ticks, plural(ticks));
    fputs("file://", stdout);
    if (*page != '/' && getcwd(current, sizeof current)) {
        put_encoded(stdout, current);
        putchar('/');
    }
    put_encoded(stdout, page);
    putchar('\n');
}

/* ---- The page ------------------------------------------------------------------------------------------------ */

/* False, with an error, also where it was stopped. */
static bool write_page(const arguments *a, const octree_session *session, FILE *page, film_summary *summary,
                       octreel_error *error)
{
    return write_played_page(session, &a->film, page, summary, error) &&
           (summary->ticks == summary->total ||
            error_set(error, "stopped after %" PRIu64 " of %" PRIu64 " ticks: there is no page", summary->ticks,
                      summary->total));
}

static bool write_file(const arguments *a, const octree_session *session, film_summary *summary, octreel_error *error)
{
    file_writer file;
    if (!file_writer_open(&file, a->page, error))
        return false;
    return write_page(a, session, file.stream, summary, error) ? file_writer_close(&file, error)
                                                               : file_writer_abandon(&file);
}

static int make_page(arguments *a, const octree_session *session)
{
    watch w = watch_begin("ticks");
    film_summary summary;
    octreel_error error;
    a->film.progress = watch_progress;
    a->film.keep_going = watch_keep_going;
    a->film.context = &w;
    const bool ok = write_file(a, session, &summary, &error);
    progress_end(&w.progress);
    if (ok && !is_quiet())
        film_report_start(stderr, &summary.start, session);
    if (!ok)
        print_error("%s", error.text);
    else if (!file_is_standard(a->page) && !is_quiet())
        tell(a->page, summary.ticks);
    watch_end(&w);
    return ok ? EXIT_DONE : EXIT_TROUBLE;
}

static int play(arguments *a)
{
    const octree_session paper = octree_session_default();
    session_file file = {0};
    octreel_error error;
    const bool ok = (a->session ? session_read(a->session, &file, &error) : session_copy(&paper, &file, &error)) &&
                    (!a->keys || session_set_keys(&file, a->keys, &error));
    a->film.values = &file.values;
    if (ok && *file.note)
        note("%s", file.note);
    const int status = ok ? make_page(a, &file.session) : print_error("%s", error.text);
    session_release(&file);
    return status;
}

static int run(int argc, char **argv)
{
    arguments a = {.film = {.view = view_default()}};
    char name[NAME_MAX + 1];
    const int status = command_read_arguments(&command_play, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    a.session = argv[optind];
    name_page(a.session, name);
    if (!a.page)
        a.page = name;
    return read_view(&a.view, &a.film.view) && check_page(&a) ? play(&a) : EXIT_TROUBLE;
}

const command command_play = {
    .name = "play",
    .run = run,
    .options = options,
    .line = "make a page of a session that plays it in a browser, and films nothing",
    .usage = "[SESSION] [-o FILE.html] [OPTION ...]",
    .about =
        "Make a page that plays a session, in one file that needs nothing beside it: in a browser it draws any "
        "tick, turns and zooms, asks what is at a place, and the keys of the game play on. Nothing is filmed. "
        "Without SESSION, that of octreel record is played; octreel help session tells what one holds. - is one from "
        "standard input. The options of the view say how the page begins.\n",
    .examples = "octreel play\n"
                "octreel play session.json --camera orbit -o walk.html\n",
    .most = 1,
    .takes = "one session",
    .inputs = {FILE_KIND(SESSION)},
};
