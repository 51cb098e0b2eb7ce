/* SPDX-License-Identifier: MIT */
/* tradeoff.c - octree-tradeoff: its command line, and the knobs one after the other. */
#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "page.h"
#include "plots.h"
#include "session_file.h"
#include "program.h"

const char program_name[] = "octree-tradeoff";

static const knob *const all_knobs[] = {
    &knob_mode, &knob_nearest_epsilon, &knob_range_epsilon, &knob_leaf, &knob_float, &knob_sweep,
    &knob_tick, &knob_picture,         &knob_png,           &knob_shade};
enum { KNOBS = sizeof all_knobs / sizeof all_knobs[0] };

typedef struct options {
    bool quick, json, chosen[KNOBS];
    const char *folder, *cloud, *session;
    double tighten;
} options;

static void print_help(void)
{
    fputs(
        "octree-tradeoff - what speed costs in accuracy, and accuracy in speed: every knob of Octreel that trades the "
        "two,\nmeasured against a truth that is exact, on scenes from ordinary to extreme\n\n"
        "usage: octree-tradeoff [OPTION ...]\n\n"
        "  -o, --output FOLDER   write tradeoff.html and, for each knob, a CSV file and a plot here (default\n"
        "                        tradeoff); a missing folder is created, existing files are replaced\n"
        "      --knob LIST       measure only these knobs, separated by commas:",
        stdout);
    for (int i = 0; i < KNOBS; i++)
        printf("%s %s", i % 5 == 0 ? "\n                       " : "", all_knobs[i]->name);
    fputs("\n      --cloud FILE      add a point cloud as a scene (x y z text, PLY, PCD or LAS)\n"
          "      --session FILE    use this session instead of a generated one\n"
          "      --quick           few points, one round: bounds are checked, times are rough\n"
          "      --json            print one JSON object per row instead of a summary\n"
          "      --tighten F       multiply every bound by F, to show that exceeded bounds are detected\n"
          "  -h, --help\n\n"
          "gnuplot draws the plots; if it is missing, the page has none and says so.\n"
          "Exit status: 0 all worst cases are within their bounds, 1 one is not, 2 trouble.\n",
          stdout);
}

static void choose(void *to, const char *name)
{
    options *o = to;
    int i = 0;
    while (i < KNOBS && strcmp(all_knobs[i]->name, name) != 0)
        i++;
    if (i == KNOBS)
        stop_with_error("there is no knob \"%s\"; --help lists them", name);
    o->chosen[i] = true;
}

static double read_factor(const char *text)
{
    char *end;
    const double factor = strtod(text, &end);
    if (end == text || *end || !(factor >= 0 && factor <= 1))
        stop_with_error("--tighten takes a number from 0 to 1, not \"%s\"", text);
    return factor;
}

static options read_options(int argc, char **argv)
{
    static const struct option names[] = {
        {"output", required_argument, NULL, 'o'},
        {"knob", required_argument, NULL, 'k'},
        {"cloud", required_argument, NULL, 'c'},
        {"session", required_argument, NULL, 's'},
        {"quick", no_argument, NULL, 'q'},
        {"json", no_argument, NULL, 'j'},
        {"tighten", required_argument, NULL, 't'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    options o = {.folder = "tradeoff", .tighten = 1};
    bool any = false;
    for (int letter; (letter = getopt_long(argc, argv, "o:h", names, NULL)) != -1;) {
        switch (letter) {
        case 'o':
            o.folder = optarg;
            break;
        case 'k':
            parse_list(&o, optarg, choose);
            any = true;
            break;
        case 'c':
            o.cloud = optarg;
            break;
        case 's':
            o.session = optarg;
            break;
        case 'q':
            o.quick = true;
            break;
        case 'j':
            o.json = true;
            break;
        case 't':
            o.tighten = read_factor(optarg);
            break;
        case 'h':
            print_help();
            exit(EXIT_DONE);
        default:
            stop_with_error("try --help");
        }
    }
    if (optind < argc)
        stop_with_error("there is nothing to do with \"%s\"; try --help", argv[optind]);
    for (int i = 0; !any && i < KNOBS; i++)
        o.chosen[i] = true;
    return o;
}

static void make_loads(const options *o, workloads *loads)
{
    cloud read = {0};
    octreel_error cloud_why;
    session_file session = {0};
    octreel_error session_why;
    if (o->cloud && !cloud_read(o->cloud, NULL, &read, &cloud_why))
        stop_with_error("%s", cloud_why.text);
    if (o->session && !session_read(o->session, &session, &session_why))
        stop_with_error("%s", session_why.text);
    workloads_make(loads, o->quick ? 2000 : 50000, o->quick ? 200 : 3000, o->session ? &session.session : NULL,
                   o->cloud ? &read : NULL);
    cloud_release(&read);
    session_release(&session);
}

static FILE *open_in(const char *folder, const char *name, const char *ending)
{
    char path[4200];
    snprintf(path, sizeof path, "%s/%s.%s", folder, name, ending);
    FILE *file = fopen(path, "w");
    if (!file)
        stop_with_error("%s: %s", path, strerror(errno));
    return file;
}

static char *text_of(void (*write)(const table *t, FILE *out), const table *t)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        stop_with_error("out of memory");
    write(t, out);
    fclose(out);
    return text;
}

static chapter measure(const knob *k, const run *r, const options *o, bool plotted)
{
    chapter c = {.knob = k, .table = {.columns = k->columns, .column_count = k->column_count}};
    k->measure(r, &c.table);
    c.headline = text_of(k->tell, &c.table);
    c.defence = text_of(k->defend, &c.table);
    c.beyond = table_judge(&c.table, k->name, o->tighten, stderr);
    FILE *csv = open_in(o->folder, k->name, "csv");
    table_write_csv(&c.table, csv);
    if (fclose(csv) != 0)
        stop_with_error("%s/%s.csv cannot be written", o->folder, k->name);
    if (plotted)
        plot(k, &c.table, o->folder);
    if (o->json)
        table_write_json(&c.table, k->name, stdout);
    else
        printf("%s\n  %s\n  %s\n", k->title, c.headline, c.defence);
    fflush(stdout);
    return c;
}

int main(int argc, char **argv)
{
    const options o = read_options(argc, argv);
    workloads loads;
    chapter chapters[KNOBS];
    size_t count = 0, beyond = 0;
    if (mkdir(o.folder, 0777) != 0 && errno != EEXIST)
        stop_with_error("%s: %s", o.folder, strerror(errno));
    const bool plotted = plots_can();
    if (!plotted)
        fputs("octree-tradeoff: gnuplot is not found: the page is without plots\n", stderr);
    make_loads(&o, &loads);
    const run r = {.quick = o.quick, .rounds = o.quick ? 1 : 5, .folder = o.folder, .loads = &loads};
    for (int i = 0; i < KNOBS; i++)
        if (o.chosen[i])
            chapters[count++] = measure(all_knobs[i], &r, &o, plotted);
    page_write(chapters, count, &r, plotted);
    for (size_t i = 0; i < count; i++) {
        beyond += chapters[i].beyond;
        free(chapters[i].headline);
        free(chapters[i].defence);
        table_free(&chapters[i].table);
    }
    workloads_free(&loads);
    if (!o.json)
        printf("%s/tradeoff.html has it all.\n", o.folder);
    return beyond ? EXIT_FINDING : EXIT_DONE;
}
