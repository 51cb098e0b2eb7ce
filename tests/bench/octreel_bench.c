/* SPDX-License-Identifier: MIT */
/* octreel_bench.c - octreel-bench: its command line, and its table of frames per second beside those of the naive
 * renderer. */
#include "filming.h"
#include "measuring.h"
#include "program.h"

#include <getopt.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char program_name[] = "octreel-bench";

enum { ROUNDS_AT_MOST = 99, FRAMES_AT_LEAST = 6, FRAMES_AT_MOST = 100000, JOBS = 2, FOLDER_ROOM = 512 };

typedef struct options {
    bool scenes[FILMED_SCENES];
    int rounds;
    uint64_t frames;
    const char *folder;
    const char *browser; /* null if pages cannot be measured */
    bool json, only_page;
} options;

static void print_help(void)
{
    printf(
        "octreel-bench - how fast Octreel films, by %d processes, beside the naive way of doing it: the same scenes "
        "by\n"
        "OSMesa with GL_LINES for every box and libpng's defaults, in one thread. In turn, each time in processes of\n"
        "their own, 1280 x 720, text on\n\n"
        "usage: octreel-bench [OPTION ...]\n\n"
        "      --scene LIST   scenes, separated by commas (default all):\n",
        JOBS);
    for (int i = 0; i < FILMED_SCENES; i++)
        printf("                       %-8s %s\n", filmed_scenes[i].name, filmed_scenes[i].about);
    printf(
        "      --frames N     frames of S and M; the other scenes and the naive way get fewer (default 600;\n"
        "                     %d to %d)\n"
        "      --rounds N     film each N times and take the medians (default 3; at most %d)\n"
        "      --folder DIR   write frames here and remove them again (default /dev/shm if it exists, else the\n"
        "                     current folder; then the times include the disk)\n"
        "      --browser NAME play the pages in this browser (default chromium)\n"
        "      --page         only measure the pages\n"
        "      --json         print one JSON object per scene and recorder\n"
        "  -h, --help\n\n"
        "naive, octreel: what films. asked, answered: octreel, with 100 queries a tick, and with a program's answers "
        "to\n"
        "them, which are judged; one process, by its processor's time. page: index.html draws by itself, on ticks of "
        "its\n"
        "own, one after the other; turning: its view turns, at two sizes of the picture\n"
        "frames/s   by the clock on the wall, without the first frame of each process\n"
        "times      so many times the naive way's; and, where others use the machine too, what their processor times "
        "say\n"
        "draw       processor milliseconds of a frame up to its pixels: tick, scene, digest, quads, filling\n"
        "encode     the same of its file: pixel digest, PNG, rename\n"
        "floor      the part of draw and encode that the encoder would take alone, for pixels that are known\n"
        "Exit status: 0 done, whether or not goals were reached, 2 trouble.\n",
        FRAMES_AT_LEAST, FRAMES_AT_MOST, ROUNDS_AT_MOST);
}

/* ---- Options ------------------------------------------------------------------------------------------------ */

static void take_scene(void *to, const char *entry)
{
    options *o = to;
    int i = 0;
    while (i < FILMED_SCENES && strcmp(filmed_scenes[i].name, entry) != 0)
        i++;
    if (i == FILMED_SCENES)
        stop_with_error("unknown scene \"%s\"; --help lists all scenes", entry);
    o->scenes[i] = true;
}

static void take_folder(options *o, const char *folder)
{
    if (strlen(folder) >= FOLDER_ROOM - 64 || access(folder, W_OK) != 0)
        stop_with_error("--folder takes a writable folder, not \"%.100s\"", folder);
    o->folder = folder;
}

static void take_option(options *o, int name, char *value)
{
    switch (name) {
    case 's':
        parse_list(o, value, take_scene);
        break;
    case 'n':
        o->frames = (uint64_t)parse_whole_number("--frames", value, FRAMES_AT_LEAST, FRAMES_AT_MOST);
        break;
    case 'r':
        o->rounds = (int)parse_whole_number("--rounds", value, 1, ROUNDS_AT_MOST);
        break;
    case 'f':
        take_folder(o, value);
        break;
    case 'b':
        o->browser = value;
        break;
    case 'j':
        o->json = true;
        break;
    case 'p':
        o->only_page = true;
        break;
    case 'h':
        print_help();
        exit_with_status(EXIT_DONE);
    default:
        exit(EXIT_TROUBLE); /* getopt has said why */
    }
}

static options read_options(int argc, char **argv)
{
    static const struct option names[] = {
        {"scene", required_argument, NULL, 's'},
        {"frames", required_argument, NULL, 'n'},
        {"rounds", required_argument, NULL, 'r'},
        {"folder", required_argument, NULL, 'f'},
        {"browser", required_argument, NULL, 'b'},
        {"json", no_argument, NULL, 'j'},
        {"page", no_argument, NULL, 'p'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    options o = {
        .rounds = 3, .frames = 600, .browser = "chromium", .folder = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "."};
    for (int name; (name = getopt_long(argc, argv, "h", names, NULL)) != -1;)
        take_option(&o, name, optarg);
    if (optind < argc)
        stop_with_error("unknown argument \"%s\"; see --help", argv[optind]);
    const bool none[FILMED_SCENES] = {false};
    if (memcmp(o.scenes, none, sizeof none) == 0)
        memset(o.scenes, true, sizeof o.scenes);
    return o;
}

/* ---- Measuring ---------------------------------------------------------------------------------------------- */

static double median_of(const filming *rounds, int count, size_t member)
{
    double values[ROUNDS_AT_MOST];
    for (int i = 0; i < count; i++)
        memcpy(&values[i], (const char *)&rounds[i] + member, sizeof values[i]);
    return median(values, (size_t)count);
}

static filming medians(const filming *rounds, int count)
{
    filming result = {
        .first_ms = median_of(rounds, count, offsetof(filming, first_ms)),
        .frame_ms = median_of(rounds, count, offsetof(filming, frame_ms)),
        .draw_ms = median_of(rounds, count, offsetof(filming, draw_ms)),
        .encode_ms = median_of(rounds, count, offsetof(filming, encode_ms)),
        .floor_ms = median_of(rounds, count, offsetof(filming, floor_ms)),
        .mib = median_of(rounds, count, offsetof(filming, mib)),
        .scrub_ms = median_of(rounds, count, offsetof(filming, scrub_ms)),
        .page_kb = median_of(rounds, count, offsetof(filming, page_kb)),
    };
    for (size_t i = 0; i < PAGE_SIZES; i++) {
        page_turning *turning = &result.turning[i];
        turning->full_ms = median_of(rounds, count, offsetof(filming, turning[i].full_ms));
        turning->ms = median_of(rounds, count, offsetof(filming, turning[i].ms));
        turning->scale = median_of(rounds, count, offsetof(filming, turning[i].scale));
    }
    return result;
}

static uint64_t count_frames(const options *o, const filmed_scene *scene, filming_who who)
{
    uint64_t frames = o->frames / (uint64_t)scene->shorter;
    if (who == FILM_NAIVE)
        frames /= (uint64_t)scene->naive_shorter;
    if (who == FILM_CHECKED) /* as many frames as a short recording, so that frame 100 and the last are checked */
        frames = frames < 253 ? frames : 253;
    else if (who == FILM_PARTS || who == FILM_ASKED || who == FILM_ANSWERED)
        frames /= 5;
    return frames < FRAMES_AT_LEAST - 2 ? FRAMES_AT_LEAST - 2 : frames;
}

static bool has_page(const options *o, const filmed_scene *scene)
{
    return o->browser && scene->page_fps > 0;
}

static bool is_filmed(const options *o, const filmed_scene *scene, filming_who who)
{
    const bool asks = who == FILM_ASKED || who == FILM_ANSWERED;
    if ((o->only_page || scene->cloud) && who != FILM_PAGE)
        return false;
    return (who != FILM_PAGE || has_page(o, scene)) && (!asks || scene->asked > 0);
}

static void leave_pages_out(options *o, const char *why)
{
    fprintf(stderr, "octreel-bench: pages are left out: %s\n", why);
    o->browser = NULL;
}

/* Measure all kinds in turn, round by round. */
static void measure(options *o, const filmed_scene *scene, filming result[FILM_KINDS])
{
    static filming rounds[FILM_KINDS][ROUNDS_AT_MOST];
    char folder[FOLDER_ROOM];
    for (int round = 0; round < o->rounds; round++)
        for (int who = 0; who < FILM_KINDS; who++) {
            filming *f = &rounds[who][round];
            snprintf(folder, sizeof folder, "%s/octreel-bench-%ld", o->folder, (long)getpid());
            const filming_order order = {scene, (filming_who)who, count_frames(o, scene, (filming_who)who),
                                         JOBS,  folder,           o->browser};
            if (!is_filmed(o, scene, (filming_who)who))
                continue;
            if (!film_scene(&order, f) && who != FILM_PAGE)
                stop_with_error("%s", f->trouble);
            if (f->trouble[0])
                leave_pages_out(o, f->trouble);
        }
    for (int who = 0; who < FILM_KINDS; who++)
        result[who] = medians(rounds[who], o->rounds);
}

/* ---- Telling ------------------------------------------------------------------------------------------------ */

static void print_heading(int rounds)
{
    printf("1280 x 720, %d processes beside one thread of the naive way, the median of %d round%s\n", JOBS, rounds,
           rounds == 1 ? "" : "s");
    printf("%-8s %-8s %9s %7s %6s %-14s %-21s %-19s %8s %9s %6s\n", "scene", "who", "frames/s", "times", "by CPU",
           "goal", "first frame, goal", "memory, goal", "draw ms", "encode ms", "floor");
}

static const char *verdict(bool holds)
{
    return holds ? "holds" : "missed";
}

static void print_row(const filmed_scene *scene, const char *who, const filming *f)
{
    printf("%-8s %-8s %9.1f", scene->name, who, 1e3 / f->frame_ms);
}

static void print_naive(const filmed_scene *scene, const filming *f)
{
    print_row(scene, "naive", f);
    printf(" %7.1f %6.1f %-14s %6.0f ms %11s %6.0f MiB %8s %8.1f %9.1f\n", 1.0, 1.0, "", f->first_ms, "", f->mib, "",
           f->draw_ms, f->encode_ms);
}

static double floor_of(const filming *parts)
{
    return parts->floor_ms / (parts->draw_ms + parts->encode_ms);
}

/* The speed with each process on a core of its own, as a multiple of the naive renderer's. */
static double times_by_cpu(const filming result[FILM_KINDS])
{
    const filming *naive = &result[FILM_NAIVE], *parts = &result[FILM_PARTS];
    return JOBS * (naive->draw_ms + naive->encode_ms) / (parts->draw_ms + parts->encode_ms);
}

static void print_octreel(const filmed_scene *scene, const filming result[FILM_KINDS])
{
    const filming *f = &result[FILM_OCTREEL], *parts = &result[FILM_PARTS];
    const double times = result[FILM_NAIVE].frame_ms / f->frame_ms, fps = 1e3 / f->frame_ms;
    char goal[32], first[32] = "", memory[32] = "";
    if (scene->least_fps > 0)
        snprintf(goal, sizeof goal, ">= %g/s %s", scene->least_fps, verdict(fps >= scene->least_fps));
    else
        snprintf(goal, sizeof goal, ">= %gx %s", scene->least_times, verdict(times >= scene->least_times));
    if (scene->first_ms > 0)
        snprintf(first, sizeof first, "<%g %s", scene->first_ms, verdict(f->first_ms < scene->first_ms));
    if (scene->mib > 0)
        snprintf(memory, sizeof memory, "<%g %s", scene->mib, verdict(f->mib < scene->mib));
    print_row(scene, "octreel", f);
    printf(" %7.1f %6.1f %-14s %6.0f ms %-11s %5.0f MiB %-9s %8.1f %9.1f %5.0f%%\n", times, times_by_cpu(result), goal,
           f->first_ms, first, f->mib, memory, parts->draw_ms, parts->encode_ms, 100 * floor_of(parts));
}

/* Print the cost of the checks, in processor time of one process. Loading Mesa is in first_ms, not in the time of a
 * frame. */
static void print_checked(const filmed_scene *scene, const filming result[FILM_KINDS])
{
    const filming *f = &result[FILM_CHECKED], *parts = &result[FILM_PARTS];
    const double times = f->frame_ms / parts->frame_ms;
    print_row(scene, "checked", f);
    printf(" %41s %6.0f MiB %8s %8.1f %9.1f, %.3f times a frame without checks, <=%g %s; Mesa loads in %.0f ms\n", "",
           f->mib, "", f->draw_ms, f->encode_ms, times, GOAL_CHECKED, verdict(times <= GOAL_CHECKED),
           f->first_ms - parts->first_ms);
}

static void print_checked_json(const filmed_scene *scene, const filming result[FILM_KINDS])
{
    const filming *f = &result[FILM_CHECKED], *parts = &result[FILM_PARTS];
    printf(
        "{\"scene\":\"%s\",\"who\":\"checked\",\"fps\":%.2f,\"draw_ms\":%.3f,\"encode_ms\":%.3f,\"times_plain\":%.3f,"
        "\"load_ms\":%.1f,\"mib\":%.1f}\n",
        scene->name, 1e3 / f->frame_ms, f->draw_ms, f->encode_ms, f->frame_ms / parts->frame_ms,
        f->first_ms - parts->first_ms, f->mib);
}

/* The additional time of comparing answers, as a share of a frame without queries. */
static double judging_of(const filming result[FILM_KINDS])
{
    return (result[FILM_ANSWERED].frame_ms - result[FILM_ASKED].frame_ms) / result[FILM_PARTS].frame_ms;
}

/* Print the cost of queries, in processor time of one process. */
static void print_asked(const filmed_scene *scene, const filming result[FILM_KINDS])
{
    for (int who = FILM_ASKED; who <= FILM_ANSWERED; who++) {
        const filming *f = &result[who];
        print_row(scene, who == FILM_ASKED ? "asked" : "answered", f);
        printf(" %41s %6.0f MiB %8s %8.1f %9.1f, %.2f times a frame without queries", "", f->mib, "", f->draw_ms,
               f->encode_ms, f->frame_ms / result[FILM_PARTS].frame_ms);
        if (who == FILM_ANSWERED)
            printf("; judging is %.2f of one, <=%g %s", judging_of(result), GOAL_JUDGING,
                   verdict(judging_of(result) <= GOAL_JUDGING));
        putchar('\n');
    }
}

static void print_asked_json(const filmed_scene *scene, const filming result[FILM_KINDS])
{
    for (int who = FILM_ASKED; who <= FILM_ANSWERED; who++) {
        const filming *f = &result[who];
        printf("{\"scene\":\"%s\",\"who\":\"%s\",\"fps\":%.2f,\"draw_ms\":%.3f,\"encode_ms\":%.3f,\"times_plain\":%.3f",
               scene->name, who == FILM_ASKED ? "asked" : "answered", 1e3 / f->frame_ms, f->draw_ms, f->encode_ms,
               f->frame_ms / result[FILM_PARTS].frame_ms);
        if (who == FILM_ANSWERED)
            printf(",\"judging\":%.3f", judging_of(result));
        printf(",\"mib\":%.1f}\n", f->mib);
    }
}

/* Print " <LIMIT holds" or " <LIMIT missed", unless there is no limit. */
static void print_limit(double value, double limit)
{
    if (limit > 0)
        printf(" <%g %s", limit, verdict(value < limit));
}

static void print_page(const filmed_scene *scene, const filming result[FILM_KINDS])
{
    const filming *f = &result[FILM_PAGE];
    const double fps = 1e3 / f->frame_ms;
    print_row(scene, "page", f);
    printf(" %14s >= %g/s %s; first picture %.0f ms", "", scene->page_fps, verdict(fps >= scene->page_fps),
           f->first_ms);
    print_limit(f->first_ms, scene->page_first_ms);
    printf("; %.0f MiB", f->mib);
    print_limit(f->mib, scene->page_mib);
    printf("; draw %.1f ms; %.0f kB", f->draw_ms, f->page_kb);
    print_limit(f->page_kb, scene->page_kb);
    printf("; to any tick %.0f ms", f->scrub_ms);
    print_limit(f->scrub_ms, scene->scrub_ms);
    putchar('\n');
    for (int i = 0; i < PAGE_SIZES; i++) {
        const page_turning *turning = &f->turning[i];
        const int *size = page_sizes[i];
        printf("%-8s %-8s %9.1f %14s >= %g/s %s, at %d x %d drawn with %.0f x %.0f pixels; %.1f/s with all pixels\n",
               scene->name, "turning", 1e3 / turning->ms, "", scene->turn_fps,
               verdict(1e3 / turning->ms >= scene->turn_fps), size[0], size[1], size[0] * turning->scale,
               size[1] * turning->scale, 1e3 / turning->full_ms);
    }
}

static void print_page_json(const filmed_scene *scene, const filming result[FILM_KINDS])
{
    const filming *f = &result[FILM_PAGE];
    printf("{\"scene\":\"%s\",\"who\":\"page\",\"fps\":%.2f,\"draw_ms\":%.3f,\"times_naive\":%.3f,"
           "\"first_frame_ms\":%.1f,\"mib\":%.1f,\"page_kb\":%.1f,\"scrub_ms\":%.1f,\"turning\":[",
           scene->name, 1e3 / f->frame_ms, f->draw_ms, result[FILM_NAIVE].frame_ms / f->frame_ms, f->first_ms, f->mib,
           f->page_kb, f->scrub_ms);
    for (int i = 0; i < PAGE_SIZES; i++)
        printf("%s{\"size\":[%d,%d],\"fps\":%.2f,\"scale\":%g,\"full_fps\":%.2f}", i ? "," : "", page_sizes[i][0],
               page_sizes[i][1], 1e3 / f->turning[i].ms, f->turning[i].scale, 1e3 / f->turning[i].full_ms);
    puts("]}");
}

static void print_json(const filmed_scene *scene, const filming result[FILM_KINDS])
{
    static const char *const names[] = {[FILM_NAIVE] = "naive", [FILM_OCTREEL] = "octreel"};
    for (int who = FILM_NAIVE; who <= FILM_OCTREEL; who++) {
        const filming *f = &result[who], *parts = &result[who == FILM_NAIVE ? FILM_NAIVE : FILM_PARTS];
        printf("{\"scene\":\"%s\",\"who\":\"%s\",\"fps\":%.2f,\"draw_ms\":%.3f,\"encode_ms\":%.3f,"
               "\"times_naive\":%.3f,\"first_frame_ms\":%.1f,\"mib\":%.1f",
               scene->name, names[who], 1e3 / f->frame_ms, parts->draw_ms, parts->encode_ms,
               result[FILM_NAIVE].frame_ms / f->frame_ms, f->first_ms, f->mib);
        if (who == FILM_OCTREEL)
            printf(",\"times_naive_cpu\":%.3f,\"encoder_floor\":%.3f", times_by_cpu(result), floor_of(parts));
        puts("}");
    }
}

static void print_scene(const options *o, const filmed_scene *scene, const filming result[FILM_KINDS])
{
    if (!o->only_page && !scene->cloud) {
        if (!o->json)
            print_naive(scene, &result[FILM_NAIVE]);
        (o->json ? print_json : print_octreel)(scene, result);
        (o->json ? print_checked_json : print_checked)(scene, result);
        if (scene->asked > 0)
            (o->json ? print_asked_json : print_asked)(scene, result);
    }
    if (has_page(o, scene))
        (o->json ? print_page_json : print_page)(scene, result);
}

int main(int argc, char **argv)
{
    options o = read_options(argc, argv);
    if (!o.json)
        print_heading(o.rounds);
    for (int i = 0; i < FILMED_SCENES; i++) {
        filming result[FILM_KINDS];
        if (!o.scenes[i])
            continue;
        fflush(stdout); /* a child would write a copy of the buffer */
        measure(&o, &filmed_scenes[i], result);
        print_scene(&o, &filmed_scenes[i], result);
    }
    exit_with_status(EXIT_DONE);
}
