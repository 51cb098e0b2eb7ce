/* SPDX-License-Identifier: MIT */
/* cmd_record.c - octreel record: film a session into a folder. */
#include "command.h"
#include "film.h"
#include "file.h"
#include "film_report.h"
#include "number.h"
#include "progress.h"
#include "recording_file.h"
#include "folder_files.h"
#include "text.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <unistd.h>

typedef struct arguments {
    const char *session, *keys;
    film_options film;
    view_options view;
    uint64_t every; /* 0: not given */
    bool no_frames, json;
} arguments;

static bool read_ticks(const command_option *option, const char *text, void *into)
{
    film_options *film = into;
    const char *at = text;
    film->first = 0;
    film->last = UINT64_MAX;
    const bool begins = whole_parse(&at, UINT64_MAX - 1, &film->first), open = *at == ':';
    at += open;
    const bool ends = open && whole_parse(&at, UINT64_MAX, &film->last);
    if (open && (begins || ends) && *at == 0 && film->first < film->last)
        return true;
    return refuse("--%s takes ticks as in 100:200 (from 100 to 199), 100: or :200, not \"%s\"", option->name, text);
}

static const command_option options[] = {
    {"output", "DIR", "where the recording goes; a new folder, or one without a recording", .read = read_folder,
     OPTION_VALUE(arguments, film.folder)},
    {"keys", "KEYS", "play these keys instead of the session's: " KEYS_HELP, .read = read_text,
     OPTION_VALUE(arguments, keys)},
    {"every", "N", "film each N-th tick (ticks.jsonl still has all of them)", .read = read_whole,
     OPTION_VALUE(arguments, every), .min = 1, .max = 1000000000},
    {"no-frames", NULL, "draw nothing: the session, its ticks, and a page that draws them by itself", .read = read_flag,
     OPTION_VALUE(arguments, no_frames)},
    {"ticks", "A:B",
     "film the ticks from A to B - 1 alone, as a chunk; chunks go into one folder, from any number of machines, and "
     "octreel join makes it whole; A: and :B will do, B may be beyond the end",
     .read = read_ticks, OPTION_VALUE(arguments, film)},
    {"jobs", "N",
     "processes that film at the same time (default: one a core, fewer for a few frames); the bytes are the same",
     .read = read_whole, OPTION_VALUE(arguments, film.jobs), .min = 1, .max = FILM_MOST_JOBS},
    {"resume", NULL,
     "complete what is in DIR; frames that are there and right are kept. Without SESSION and without options, those of "
     "DIR are taken. What is not of this recording is refused",
     .read = read_flag, OPTION_VALUE(arguments, film.resume)},
    {"replace", NULL,
     "film in place of the recording in DIR, which stays until a tick is filmed; other files of DIR stay, and what is "
     "no recording is refused",
     .read = read_flag, OPTION_VALUE(arguments, film.replace)},
    FILL_OPTION(arguments, film.renderer.fill),
    VIEW_OPTIONS(arguments, view),
    RENDERER_OPTIONS(arguments, film.renderer),
    JSON_OPTION(arguments, json, "print a summary as JSON on stdout"),
    {0},
};

static void tell(const arguments *a, const film_summary *summary, const watch *w)
{
    if (a->json || !is_quiet())
        film_report(stdout, summary, &a->film, progress_seconds(&w->progress), a->json);
}

static int film(arguments *a, const octree_session *session)
{
    watch w = watch_begin("ticks");
    film_summary summary;
    octreel_error error;
    if (a->film.jobs == 0)
        a->film.jobs = film_default_jobs(session, &a->film);
    a->film.progress = watch_progress;
    a->film.keep_going = watch_keep_going;
    a->film.context = &w;
    const bool ok = film_session(session, &a->film, &summary, &error), whole = ok && summary.ticks == summary.total;
    progress_end(&w.progress);
    if (ok && !is_quiet())
        film_report_notes(stderr, &summary, &a->film, session);
    if (!ok)
        print_error("%s", error.text);
    else if (!whole)
        film_report_stopped(stderr, &summary, &a->film);
    else
        tell(a, &summary, &w);
    watch_end(&w);
    return whole ? EXIT_DONE : EXIT_TROUBLE;
}

/* ---- A session that is still being written ------------------------------------------------------------------ */

/* Why a stream cannot be filmed as asked for; null where it can. */
static const char *refuse_stream(const arguments *a)
{
    if (a->film.resume)
        return "--resume completes what is in DIR without the stream: leave out the -";
    if (a->film.last != 0)
        return "--ticks films a part of a session that is there, and not one that is still being written: save it "
               "first";
    if (a->film.jobs > 1)
        return "--jobs divides a session that is there, and one that is still being written is filmed as it comes: by "
               "one";
    return NULL;
}

static int end_stream(const arguments *a, film_stream_end how, const film_summary *summary, const watch *w,
                      const octreel_error *error)
{
    const uint64_t ticks = summary->ticks;
    if (how == FILM_STREAM_WHOLE)
        tell(a, summary, w);
    else if (how == FILM_STREAM_STOPPED && ticks == 0)
        print_error("stopped before a tick was filmed");
    else if (how == FILM_STREAM_STOPPED)
        print_error("stopped after %" PRIu64 " tick%s, of which %s is a recording", ticks, plural(ticks),
                    a->film.folder);
    else if (ticks == 0)
        print_error("%s", error->text);
    else
        print_error("%s; %s has what came before: %" PRIu64 " tick%s", error->text, a->film.folder, ticks,
                    plural(ticks));
    return how == FILM_STREAM_WHOLE ? EXIT_DONE : EXIT_TROUBLE;
}

static int film_standard_input(arguments *a)
{
    watch w = watch_begin("ticks");
    film_summary summary;
    octreel_error error;
    a->film.progress = watch_progress;
    a->film.keep_going = watch_keep_going;
    a->film.context = &w;
    session_stream *stream = session_stream_open(STDIN_FILENO, FILE_STANDARD_INPUT, watch_keep_going, &w);
    if (!stream)
        return print_error("there is no memory to read standard input");
    const film_stream_end how = film_stream(stream, a->keys, &a->film, &summary, &error);
    progress_end(&w.progress);
    if (*session_stream_note(stream))
        note("%s", session_stream_note(stream));
    a->film.values = session_stream_values(stream);
    if (how == FILM_STREAM_WHOLE && !is_quiet())
        film_report_notes(stderr, &summary, &a->film, session_stream_start(stream));
    const int status = end_stream(a, how, &summary, &w, &error);
    session_stream_close(stream);
    watch_end(&w);
    return status;
}

/* ---- The command line --------------------------------------------------------------------------------------- */

/* The file of the folder without which nothing says what a recording is that is resumed without a word about that on
 * the command line; null where nothing is missing. */
static const char *find_missing(const arguments *a)
{
    const char *folder = a->film.folder;
    if (!a->film.resume || a->session || a->keys || a->every || a->no_frames || first_view_option(&a->view))
        return NULL;
    if (!folder_has(folder, "recording.json"))
        return "recording.json";
    const bool played = folder_has(folder, "session.json") || folder_has(folder, "session.json.live");
    return played ? NULL : "session.json";
}

/* A recording that is resumed stands for what the command line leaves out. */
static bool read_film(arguments *a)
{
    octreel_error error;
    uint64_t every = 1;
    const char *missing = find_missing(a);
    if (missing) {
        return refuse("%s: holds no recording that could be resumed (%s is missing)", a->film.folder, missing);
    }
    if (a->film.resume && folder_has(a->film.folder, "recording.json") &&
        !recording_read(a->film.folder, &a->film.view, &every, &error)) {
        return refuse("%s", error.text);
    }
    a->film.every = a->no_frames ? 0 : a->every ? a->every : every;
    return read_view(&a->view, &a->film.view);
}

static bool read_session(const arguments *a, session_file *file, octreel_error *error)
{
    uint64_t digest;
    const octree_session paper = octree_session_default();
    if (!a->session && a->film.resume && folder_has(a->film.folder, "session.json"))
        return read_session_file(a->film.folder, file, &digest, error);
    if (!a->session && a->film.resume && folder_has(a->film.folder, "session.json.live"))
        return read_live_session(a->film.folder, file, error);
    return a->session ? session_read(a->session, file, error) : session_copy(&paper, file, error);
}

static int play(arguments *a)
{
    session_file file = {0};
    octreel_error error;
    const bool ok = read_session(a, &file, &error) && (!a->keys || session_set_keys(&file, a->keys, &error));
    a->film.values = &file.values;
    if (ok && *file.note)
        note("%s", file.note);
    const int status = ok ? film(a, &file.session) : print_error("%s", error.text);
    session_release(&file);
    return status;
}

/* Whether it is the current folder, or one that this is in: frames there would lie among all that is below. */
static bool holds_current(const char *folder)
{
    struct stat named, here, before = {0};
    char up[PATH_MAX] = ".";
    bool is = false, more = stat(folder, &named) == 0;
    for (size_t length = 1; more && !is && length + sizeof "/.." < sizeof up; before = here) {
        more = stat(up, &here) == 0 && (length == 1 || !is_same_file(&here, &before)); /* the root is above itself */
        is = more && is_same_file(&named, &here);
        length += (size_t)snprintf(up + length, sizeof up - length, "/..");
    }
    return is;
}

static bool is_own_folder(const char *folder)
{
    return !holds_current(folder) || file_kind_of(folder) == KIND_RECORDING;
}

static int run(int argc, char **argv)
{
    arguments a = {.film = {.view = view_default(), .renderer.fill = DRAW_FILL_CHECKED}};
    const int status = command_read_arguments(&command_record, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    if (!a.film.folder)
        return print_error("record needs a folder for its frames: -o DIR");
    if (!is_own_folder(a.film.folder))
        return print_error(
            "-o takes a folder of its own for the frames, and \"%s\" is the current one or holds it: -o frames, say",
            a.film.folder);
    if (a.film.replace && (a.film.resume || a.film.last != 0))
        return print_error("--replace does not go with %s: it begins a whole recording anew",
                           a.film.resume ? "--resume" : "--ticks");
    if (a.no_frames && a.every)
        return print_error("--no-frames films no tick, and --every some: give one of them");
    a.session = argv[optind];
    const bool stream = a.session && file_is_standard(a.session);
    if (stream && refuse_stream(&a))
        return print_error("%s", refuse_stream(&a));
    if (!check_renderer(&a.film.renderer) || !read_film(&a))
        return EXIT_TROUBLE;
    return stream ? film_standard_input(&a) : play(&a);
}

const command command_record = {
    .name = "record",
    .run = run,
    .options = options,
    .line = "film a session: every tick of the game becomes one PNG frame",
    .usage = "[SESSION] -o DIR [OPTION ...]",
    .about = "Play a session and film it: DIR/frame_000000.png ..., with ticks.jsonl, session.json, recording.json and "
             "renderer.json beside them, and index.html, a page that shows all of it. Without SESSION, that of the "
             "paper is played, \"3D Spatial Partitioning and Collision Detection using Octrees\", whose rules the game "
             "has; octreel help session tells what one holds. Where SESSION is -, it is read from standard input "
             "and filmed while it is written, tick by tick: mygame | octreel record - -o DIR\n",
    .more =
        "Ctrl-C finishes the frame in hand, and says how to go on. Of a session from standard input that breaks off, "
        "is malformed from some line on, or is stopped, what came before is a whole recording. After a kill every file "
        "is whole, and --resume completes the recording; after a power cut a file may be damaged, which octreel verify "
        "finds, since files are left to the system to write to the disk: syncing each would cost some 3 ms a frame.\n"
        "\n"
        "What --json prints:\n"
        "\n"
        "  \"folder\"      where the recording is\n"
        "  \"ticks\"       that were filmed; of a chunk its own\n"
        "  \"frames\"      that they have, with those that were there\n"
        "  \"gaps\"        ticks of which nothing is known\n"
        "  \"checked\"     frames that OSMesa drew too, with the same pixels\n"
        "  \"checked_by\"  \"osmesa\" or \"egl\"; null: no frame was checked\n"
        "  \"left_out\"    elements of all frames that are too far off to be drawn\n"
        "  \"over_budget\", \"below_lod\"  frames that leave out what is beyond --budget, and smaller than --lod\n"
        "  \"refusals\"    of points, edits and steps, but for steps out of the world\n"
        "  \"seconds\"     that it took\n"
        "  \"frames_per_second\"  without the frames that were there\n"
        "  \"events\"      how many ticks had each event, by the names that octreel help recording tells\n",
    .examples = "octreel record -o frames\n"
                "octreel record session.json --keys wwdn --camera orbit --size 640x360 -o frames\n"
                "octreel record --resume -o frames\n"
                "octreel record session.json --ticks 1000:2000 -o frames\n"
                "mygame | octreel record - -o frames\n"
                "(cd frames && ffmpeg -framerate 15 -pattern_type glob -i 'frame_*.png' -plays 0 film.apng)\n"
                "(cd frames && ffmpeg -pattern_type glob -i 'frame_*.png' -vf \"select='not(mod(n,10))',"
                "scale=320:-1,tile=5x5\" -frames:v 1 -update 1 sheet.png)\n",
    .files = "  DIR  the recording; octreel-recording(5) says what is in it\n",
    .most = 1,
    .takes = "one session",
    .inputs = {FILE_KIND(SESSION)},
};
