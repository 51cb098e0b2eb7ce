/* SPDX-License-Identifier: MIT */
/* tradeoff.c - octree-tradeoff: its command line, and the chapters one after the other. */
#include <ctype.h>
#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "page.h"
#include "session_file.h"
#include "program.h"

const char program_name[] = "octree-tradeoff";

static const knob *const all_knobs[] = {
    &knob_index, &knob_breaks, &knob_mode, &knob_nearest_epsilon, &knob_range_epsilon, &knob_leaf,  &knob_float,
    &knob_sweep, &knob_tick,   &knob_fill, &knob_picture,         &knob_png,           &knob_shade, &knob_diff};
enum { KNOBS = sizeof all_knobs / sizeof all_knobs[0] };

typedef struct options {
    bool quick, json, chosen[KNOBS];
    const char *folder, *cloud, *session, *from, *readme;
    double tighten;
} options;

static void print_help(void)
{
    fputs("octree-tradeoff - what speed costs in accuracy, and accuracy in speed: Octreel and other libraries, and "
          "every\n"
          "knob of Octreel that trades the two, compared with a truth that is exact, on scenes from ordinary to "
          "extreme\n\n"
          "usage: octree-tradeoff [OPTION ...]\n\n"
          "  -o, --output FOLDER   write tradeoff.html and, for each chapter, a CSV file here (default tradeoff); a\n"
          "                        missing folder is created, existing files are replaced\n"
          "      --knob LIST       measure only these chapters, separated by commas:",
          stdout);
    for (int i = 0; i < KNOBS; i++)
        printf("%s %s", i % 5 == 0 ? "\n                       " : "", all_knobs[i]->name);
    fputs("\n      --cloud FILE      add a point cloud as a scene (x y z text, PLY, PCD or LAS)\n"
          "      --session FILE    use this session instead of a generated one\n"
          "      --quick           few points, one round: bounds are checked, times are rough\n"
          "      --from PAGE       measure nothing; take all figures from a page that this program wrote\n"
          "      --check FILE      write nothing; check that a text such as README.md contains the first sentence of\n"
          "                        each chapter of --knob\n"
          "      --json            print one JSON object per row instead of a summary\n"
          "      --tighten F       multiply every bound by F, to show that exceeded bounds are detected\n"
          "  -h, --help\n\n"
          "Exit status: 0 all worst cases are within their bounds, 1 one is not, or a sentence is not in the text;\n"
          "2 error.\n",
          stdout);
}

static void choose(void *to, const char *name)
{
    options *o = to;
    int i = 0;
    while (i < KNOBS && strcmp(all_knobs[i]->name, name) != 0)
        i++;
    if (i == KNOBS)
        stop_with_error("there is no chapter \"%s\"; --help lists them", name);
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
        {"from", required_argument, NULL, 'f'},
        {"check", required_argument, NULL, 'r'},
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
        case 'f':
            o.from = optarg;
            break;
        case 'r':
            o.readme = optarg;
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
    if (o.readme && !o.from)
        stop_with_error("--check needs the figures of a page: --from PAGE");
    for (int i = 0; !any && i < KNOBS; i++)
        o.chosen[i] = true;
    return o;
}

/* ---- The chapters ------------------------------------------------------------------------------------------- */

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
    workloads_make(loads, o->quick ? 2000 : 100000, o->quick ? 200 : 2000, o->session ? &session.session : NULL,
                   o->cloud ? &read : NULL);
    cloud_release(&read);
    session_release(&session);
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

static void write_csv(const chapter *c, const char *folder)
{
    char path[4200];
    snprintf(path, sizeof path, "%s/%s.csv", folder, c->knob->name);
    FILE *csv = fopen(path, "w");
    if (!csv)
        stop_with_error("%s: %s", path, strerror(errno));
    table_write_csv(&c->table, false, csv);
    if (fclose(csv) != 0)
        stop_with_error("%s cannot be written", path);
}

/* Finish a chapter whose table is known. */
static void finish_chapter(chapter *c, const options *o)
{
    c->beyond = table_judge(&c->table, c->knob->name, o->tighten, stderr);
    table_round(&c->table);
    c->headline = text_of(c->knob->tell, &c->table);
    c->defence = text_of(c->knob->defend, &c->table);
    if (o->readme)
        return;
    write_csv(c, o->folder);
    if (o->json)
        table_write_json(&c->table, c->knob->name, stdout);
    else
        printf("%s\n  %s\n  %s\n", c->knob->title, c->headline, c->defence);
    fflush(stdout);
}

static size_t measure_chapters(const options *o, chapter *chapters, measured_where *where)
{
    workloads loads;
    size_t count = 0;
    make_loads(o, &loads);
    const run r = {.quick = o->quick, .rounds = o->quick ? 1 : 5, .folder = o->folder, .loads = &loads};
    for (int i = 0; i < KNOBS; i++)
        if (o->chosen[i]) {
            const knob *k = all_knobs[i];
            chapter *c = &chapters[count++];
            *c = (chapter){.knob = k, .table = {.columns = k->columns, .column_count = k->column_count}};
            k->measure(&r, &c->table);
            finish_chapter(c, o);
        }
    *where = where_now(&r);
    workloads_free(&loads);
    return count;
}

static size_t read_chapters(const options *o, chapter *chapters, measured_where *where)
{
    char *const text = read_text(o->from);
    size_t count = 0;
    *where = page_read_where(o->from, text);
    for (int i = 0; i < KNOBS; i++) {
        chapters[count] = (chapter){.knob = all_knobs[i]};
        if (o->chosen[i] && page_read_table(o->from, text, all_knobs[i], &chapters[count].table))
            finish_chapter(&chapters[count++], o);
    }
    free(text);
    if (count == 0)
        stop_with_error("%s has none of these chapters", o->from);
    return count;
}

/* ---- Checking a text ---------------------------------------------------------------------------------------- */

/* Make all white space a single blank, in place. */
static void fold_blanks(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++)
        if (!isspace((unsigned char)*from))
            *to++ = *from;
        else if (to > text && to[-1] != ' ')
            *to++ = ' ';
    *to = '\0';
}

/* Returns the number of chapters whose first sentence is not in the text. */
static size_t check_text(const char *path, const chapter *chapters, size_t count)
{
    char *const text = read_text(path);
    size_t missing = 0;
    fold_blanks(text);
    for (size_t i = 0; i < count; i++)
        if (!strstr(text, chapters[i].headline)) {
            missing++;
            printf("%s lacks the sentence that follows from the figures of %s:\n%s\n", path, chapters[i].knob->name,
                   chapters[i].headline);
        }
    free(text);
    return missing;
}

int main(int argc, char **argv)
{
    const options o = read_options(argc, argv);
    chapter chapters[KNOBS];
    measured_where where;
    char path[4200];
    size_t findings = 0;
    if (!o.readme && mkdir(o.folder, 0777) != 0 && errno != EEXIST)
        stop_with_error("%s: %s", o.folder, strerror(errno));
    const size_t count = (o.from ? read_chapters : measure_chapters)(&o, chapters, &where);
    snprintf(path, sizeof path, "%s/tradeoff.html", o.folder);
    if (o.readme)
        findings = check_text(o.readme, chapters, count);
    else
        page_write(path, chapters, count, &where);
    for (size_t i = 0; i < count; i++) {
        findings += chapters[i].beyond;
        free(chapters[i].headline);
        free(chapters[i].defence);
        table_free(&chapters[i].table);
    }
    where_free(&where);
    if (!o.json && !o.readme)
        printf("%s has all figures.\n", path);
    exit_with_status(findings ? EXIT_FINDING : EXIT_DONE);
}
