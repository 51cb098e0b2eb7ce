/* SPDX-License-Identifier: MIT */
/* cmd_record.c - octreel record: films a session into a folder of frames. */
#include "command.h"
#include "film.h"
#include "file.h"
#include "film_report.h"
#include "number.h"
#include "outputs.h"
#include "progress.h"
#include "recording_file.h"
#include "folder_files.h"
#include "text.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

typedef struct arguments {
    const char *session, *keys;
    film_options film;
    view_options view;
    uint64_t every; /* the value of --every; 0 if the option was not given */
    bool no_frames, json, force;
} arguments;

static bool read_ticks(const command_option *option, const char *text, void *into)
{
    film_options *film = into;
    return read_tick_range(option, text, &film->first, &film->last);
}

static const command_option options[] = {
    {.help = "What is filmed, and into which folder:"},
    {"output", "DIR", "folder for the recording: a new folder, or one that holds no recording yet", .read = read_folder,
     OPTION_VALUE(arguments, film.folder)},
    {"keys", "KEYS", "play these keys instead of the session's: " KEYS_HELP, .read = read_text,
     OPTION_VALUE(arguments, keys)},
    {"every", "N", "draw only every N-th tick; ticks.jsonl still lists all ticks", .read = read_whole,
     OPTION_VALUE(arguments, every), .min = 1, .max = 1000000000},
    {"no-frames", NULL, "draw no frames: write the session, its ticks, and a page that draws them itself",
     .read = read_flag, OPTION_VALUE(arguments, no_frames)},
    {"ticks", "A:B",
     "film one chunk, the ticks from A to B - 1. The range A: ends with the last tick, the range :B begins with the "
     "first, and B may lie "
     "beyond the last tick. Several processes or machines can film chunks into one folder; octreel join then completes "
     "the recording",
     .read = read_ticks, OPTION_VALUE(arguments, film)},
    MAX_TICKS_OPTION(arguments, film.max_ticks),
    {"jobs", "N",
     "number of processes that film at the same time; the frames are the same for any number (default: one per core, "
     "fewer for a short session)",
     .read = read_whole, OPTION_VALUE(arguments, film.jobs), .min = 1, .max = FILM_MOST_JOBS},
    {"resume", NULL,
     "complete the recording in DIR and keep its correct frames. Without SESSION and view options, those stored in DIR "
     "are used. Refuses a folder that holds files of another recording",
     .read = read_flag, OPTION_VALUE(arguments, film.resume)},
    {"replace", NULL,
     "overwrite the recording in DIR. The old recording stays until the first tick is filmed. Other files in DIR are "
     "kept. A folder without a recording is refused",
     .read = read_flag, OPTION_VALUE(arguments, film.replace)},
    FORCE_OPTION(arguments, force, "film into DIR even if it is or contains the current folder"),
    JSON_OPTION(arguments, json, "print a summary as JSON to standard output"),
    {.help = "How the frames look:"},
    SHARED_OPTIONS(view_option_row, arguments, view),
    {.help = "How the frames are drawn:"},
    FILL_OPTION(arguments, film.renderer.fill),
    SHARED_OPTIONS(renderer_option_row, arguments, film.renderer),
    {0},
};

static void print_summary(const arguments *a, const film_summary *summary, const progress *p)
{
    if (a->json || !is_quiet())
        film_report(stdout, summary, &a->film, progress_seconds(p), a->json);
}

static int film_to_folder(arguments *a, const octree_session *session)
{
    progress p = progress_start("ticks");
    film_summary summary;
    octreel_error error;
    if (a->film.jobs == 0)
        a->film.jobs = film_default_jobs(session, &a->film);
    a->film.watch.context = &p;
    defer_stop_signals();
    const bool ok = film_session(session, &a->film, &summary, &error), whole = ok && summary.ticks == summary.total;
    progress_end(&p);
    if (ok && !is_quiet())
        film_report_notes(stderr, &summary, &a->film, session);
    if (!ok)
        print_error("%s", error.text);
    else if (!whole)
        film_report_stopped(stderr, &summary, &a->film);
    else
        print_summary(a, &summary, &p);
    deliver_stop_signal();
    return whole ? EXIT_DONE : EXIT_TROUBLE;
}

/* ---- A session from standard input ------------------------------------------------------------------ */

/* Returns the reason why the given options do not work with a session from standard input, or null if they work. */
static const char *explain_stream_conflict(const arguments *a)
{
    if (a->film.resume)
        return "--resume uses the session stored in DIR: leave out the \"-\"";
    if (a->film.last != 0)
        return "--ticks needs a whole session and cannot film standard input: save the session to a file first";
    if (a->film.jobs > 1)
        return "--jobs needs a whole session, and cannot film standard input with more than one process: leave out "
               "--jobs, or save the session to a file first";
    return NULL;
}

static int report_stream_end(const arguments *a, film_stream_end how, const film_summary *summary, const progress *p,
                             const octreel_error *error)
{
    const uint64_t ticks = summary->ticks;
    if (how == FILM_STREAM_WHOLE)
        print_summary(a, summary, p);
    else if (how == FILM_STREAM_STOPPED && ticks == 0)
        print_error("stopped before the first tick was filmed; nothing was written");
    else if (how == FILM_STREAM_STOPPED)
        print_error("stopped after %" PRIu64 " tick%s; %s is a complete recording of these ticks", ticks,
                    plural_ending(ticks), a->film.folder);
    else if (ticks == 0)
        print_error("%s", error->text);
    else
        print_error("%s; %s holds the part before the error: %" PRIu64 " tick%s", error->text, a->film.folder, ticks,
                    plural_ending(ticks));
    return how == FILM_STREAM_WHOLE ? EXIT_DONE : EXIT_TROUBLE;
}

static int film_standard_input(arguments *a)
{
    progress p = progress_start("ticks");
    film_summary summary;
    octreel_error error;
    a->film.watch.context = &p;
    session_stream *stream = session_stream_open(STDIN_FILENO, FILE_STANDARD_INPUT, has_no_stop_signal, NULL);
    if (!stream)
        return print_error("out of memory while reading standard input");
    defer_stop_signals();
    const film_stream_end how = film_stream(stream, a->keys, &a->film, &summary, &error);
    progress_end(&p);
    if (*session_stream_note(stream))
        print_note("%s", session_stream_note(stream));
    a->film.values = session_stream_point_values(stream);
    if (how == FILM_STREAM_WHOLE && !is_quiet())
        film_report_notes(stderr, &summary, &a->film, session_stream_first_session(stream));
    const int status = report_stream_end(a, how, &summary, &p, &error);
    session_stream_close(stream);
    deliver_stop_signal();
    return status;
}

/* ---- The command line --------------------------------------------------------------------------------------- */

/* Returns the name of the session file in the folder, or null if the folder has none. */
static const char *find_stored_session(const char *folder)
{
    return folder_contains(folder, "session.json")        ? "session.json"
           : folder_contains(folder, "session.json.live") ? "session.json.live"
                                                          : NULL;
}

/* Completes the film options that the command line leaves out. With --resume, they are taken from the recording; if the
 * command line gives neither a session nor any of these options, the folder must contain a session file and
 * recording.json. */
static bool complete_film_options(arguments *a)
{
    octreel_error error;
    uint64_t every = 1;
    const char *folder = a->film.folder;
    const bool has_view = folder_contains(folder, "recording.json");
    const bool has_options = a->session || a->keys || a->every || a->no_frames || find_first_view_option(&a->view);
    if (a->film.resume && !has_options && (!has_view || !find_stored_session(folder)))
        return print_refusal(
            "%s: holds no recording that can be resumed: %s is missing; leave out --resume to start a new one", folder,
            has_view ? "session.json" : "recording.json");
    if (a->film.resume && has_view && !recording_read(folder, &a->film.view, &every, &error))
        return print_refusal("%s", error.text);
    if (!a->session && !(a->film.resume && has_view))
        a->film.view.diagram = DIAGRAM_BESIDE;
    a->film.every = a->no_frames ? 0 : a->every ? a->every : every;
    return read_view(&a->view, &a->film.view);
}

static bool read_session(const arguments *a, session_file *file, octreel_error *error)
{
    uint64_t digest;
    const octree_session paper = octree_session_default();
    const char *folder = a->film.folder, *stored = a->film.resume ? find_stored_session(folder) : NULL;
    if (a->session)
        return session_read(a->session, file, error);
    if (!stored)
        return session_copy(&paper, file, error);
    return strcmp(stored, "session.json") == 0 ? read_session_file(folder, file, &digest, error)
                                               : read_live_session(folder, file, error);
}

static int film_session_file(arguments *a)
{
    session_file file = {0};
    octreel_error error;
    const bool ok = read_session(a, &file, &error) && (!a->keys || session_set_keys(&file, a->keys, &error));
    a->film.values = &file.values;
    if (ok && *file.note)
        print_note("%s", file.note);
    const int status = ok ? film_to_folder(a, &file.session) : print_error("%s", error.text);
    session_release(&file);
    return status;
}

static int run(int argc, char **argv)
{
    arguments a = {.film = {.view = view_make_default(),
                            .renderer.fill = DRAW_FILL_CHECKED,
                            .watch = {progress_show, has_no_stop_signal, NULL}}};
    const int status = command_read_arguments(&command_record, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    if (!a.film.folder)
        return print_error("record needs a folder for the frames: add -o DIR");
    if (!check_outputs(&(output_file){"-o", NULL, a.film.folder}, 1, NULL, 0, false, a.force))
        return EXIT_TROUBLE;
    if (a.film.replace && (a.film.resume || a.film.last != 0))
        return print_error("--replace starts a new recording and does not work with %s: leave out one of them",
                           a.film.resume ? "--resume" : "--ticks");
    if (a.no_frames && a.every)
        return print_error("--no-frames and --every contradict each other: leave out one of them");
    a.session = argv[optind];
    const bool stream = a.session && file_is_standard_stream(a.session);
    if (stream && explain_stream_conflict(&a))
        return print_error("%s", explain_stream_conflict(&a));
    if (!check_renderer(&a.film.renderer) || !complete_film_options(&a))
        return EXIT_TROUBLE;
    return stream ? film_standard_input(&a) : film_session_file(&a);
}

const command command_record = {
    .name = "record",
    .run = run,
    .options = options,
    .line = "film a session: every tick of the game becomes one PNG frame",
    .usage = "[SESSION] -o DIR [OPTION ...]",
    .about =
        "Play a session and draw every tick into DIR/frame_000000.png and so on. DIR/index.html shows the frames in a "
        "browser and plays on from any tick; octreel help recording describes the other files.\n"
        "\n"
        "SESSION is a JSON file with a world, points and keys; octreel help session describes it. Without SESSION, the "
        "example of the paper \"3D Spatial Partitioning and Collision Detection using Octrees\" is filmed. SESSION may "
        "be -: the session is read from standard input and filmed while another program writes it.\n",
    .more =
        "Ctrl-C finishes the current frame and prints how to continue; after five seconds it ends the program in any "
        "case. When a session from standard input breaks off, is malformed or is stopped, the ticks before that point "
        "are a complete recording. If the program is killed, every file is whole, and --resume completes the "
        "recording. After a "
        "power cut a file may be damaged, because files are not synced to the disk (that would cost about 3 ms a "
        "frame); octreel verify finds such files.\n"
        "\n"
        "Members of the summary that --json prints:\n"
        "\n"
        "  \"folder\"      the folder of the recording\n"
        "  \"ticks\"       number of ticks filmed; for a chunk, its own\n"
        "  \"frames\"      number of frames of these ticks, including frames that existed before\n"
        "  \"gaps\"        number of gaps, which are ticks without data\n"
        "  \"checked\"     number of frames that OpenGL also drew, with the same pixels\n"
        "  \"checked_by\"  \"osmesa\" or \"egl\"; null if no frame was checked\n"
        "  \"left_out\"    number of elements in all frames that are too far away to be drawn\n"
        "  \"over_budget\", \"below_lod\"  numbers of frames that leave out elements because of --budget and of --lod\n"
        "  \"refusals\"    number of refused points, edits and steps, without steps that leave the world\n"
        "  \"seconds\"     time taken\n"
        "  \"frames_per_second\"  speed, without frames that existed before\n"
        "  \"events\"      number of ticks with each event; octreel help recording names the events\n",
    .statuses = {"all ticks are filmed", NULL, "error or stopped; the message says what to do"},
    .examples = "# film the example; then open frames/index.html in a browser\n"
                "octreel record -o frames\n"
                "# film a session with other keys, an orbiting camera and small frames\n"
                "octreel record session.json --keys wwdn --camera orbit --size 640x360 -o frames\n"
                "# film a game while it runs and prints its session\n"
                "mygame | octreel record - -o frames\n"
                "# continue a recording that was interrupted\n"
                "octreel record --resume -o frames\n"
                "# film ticks 1000 to 1999; octreel join puts such chunks together\n"
                "octreel record session.json --ticks 1000:2000 -o frames\n"
                "# make an animated PNG of all frames\n"
                "octreel film frames -o film.png\n"
                "# make one picture with every tenth frame\n"
                "(cd frames && ffmpeg -pattern_type glob -i 'frame_*.png' -vf \"select='not(mod(n,10))',"
                "scale=320:-1,tile=5x5\" -frames:v 1 -update 1 sheet.png)\n",
    .files = "  DIR  the recording; octreel-recording(5) describes its files\n",
    .max_arguments = 1,
    .takes = "one session",
    .inputs = {FILE_KIND(SESSION)},
};
