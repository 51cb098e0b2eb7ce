/* SPDX-License-Identifier: MIT */
/* page.c - see page.h. The page holds a JSON object that says what was measured, a CSV table for each chapter, and a
 * script that draws charts of both. */
#include "page.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <string.h>
#include <time.h>

#include "file.h"
#include "index.h"
#include "program.h"

static char *copy_text(const char *text)
{
    char *copy = resize_memory(NULL, strlen(text) + 1);
    return strcpy(copy, text);
}

/* ---- Where and when ----------------------------------------------------------------------------------------- */

/* The name of the processor, as Linux reports it. */
static char *read_machine(void)
{
    char line[256], *name = NULL;
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (!name && file && fgets(line, sizeof line, file))
        if (strncmp(line, "model name", 10) == 0 && strchr(line, ':')) {
            line[strcspn(line, "\n")] = '\0';
            name = copy_text(strchr(line, ':') + 2);
        }
    if (file)
        fclose(file);
    return name ? name : copy_text("unknown processor");
}

measured_where where_now(const run *r)
{
    char date[16], points[128];
    const time_t now = time(NULL);
    strftime(date, sizeof date, "%Y-%m-%d", gmtime(&now));
    snprintf(points, sizeof points, "%zu points and %zu targets in each scene, seed 7", r->loads->of[0].count,
             r->loads->of[0].target_count);
    return (measured_where){.date = copy_text(date),
                            .machine = read_machine(),
                            .compiler = copy_text(OCTREEL_COMPILER),
                            .libraries = list_libraries(),
                            .points = copy_text(points),
                            .quick = r->quick,
                            .rounds = r->rounds};
}

void where_free(measured_where *where)
{
    free(where->date);
    free(where->machine);
    free(where->compiler);
    free(where->libraries);
    free(where->points);
    *where = (measured_where){0};
}

/* ---- Writing ------------------------------------------------------------------------------------------------ */

char *read_text(const char *path)
{
    char *text;
    size_t size;
    octreel_error why;
    if (!file_read_whole(path, &text, &size, &why))
        stop_with_error("%s", why.text);
    text[size] = '\0';
    return text;
}

static void write_part(const char *name, FILE *out)
{
    char path[4200];
    snprintf(path, sizeof path, "%s/%s", OCTREEL_TRADE_PAGE, name);
    char *text = read_text(path);
    fputs(text, out);
    free(text);
}

/* Null for null. */
static const char *meaning_of(const knob *k, const char *name)
{
    if (!name)
        return NULL;
    for (size_t i = 0; i < k->column_count; i++)
        if (strcmp(k->columns[i].name, name) == 0)
            return k->columns[i].meaning;
    stop_with_error("%s has no column \"%s\"", k->name, name);
}

static json_t *describe_chart(const knob *k, const chart *c)
{
    return json_pack("{s:s, s:s?, s:s?, s:s?, s:s?, s:s?, s:b, s:b, s:b, s:b}", "title", c->title, "x", c->x, "y", c->y,
                     "bound", c->bound, "xLabel", c->x_label ? c->x_label : meaning_of(k, c->x), "yLabel",
                     c->y_label ? c->y_label : meaning_of(k, c->y), "xLog", c->x_log, "yLog", c->y_log, "byVariant",
                     c->by_variant, "matrix", c->matrix);
}

/* The largest gain, and the row that has it: "k8 at 2". */
static json_t *describe_gain(const gain *g, const table *t)
{
    double most = 0, at = NAN;
    char where[96];
    for (size_t i = 0; i < t->count; i++) {
        const row *r = &t->rows[i];
        pick fast = g->fast;
        if (strcmp(r->variant, fast.variant) != 0 || (!isnan(fast.setting) && r->values[0] != fast.setting))
            continue;
        if (!isnan(g->slow.setting))
            fast.setting = r->values[0];
        const double times = table_ratio(t, g->slow, fast, g->cost);
        if (times > most) {
            most = times;
            at = fast.setting;
        }
    }
    snprintf(where, sizeof where, isnan(at) ? "%s" : "%s at %g", g->fast.variant, at);
    return json_pack("{s:s, s:f, s:s}", "what", g->what, "times", most, "where", where);
}

static json_t *describe_chapter(const chapter *c)
{
    const knob *k = c->knob;
    json_t *charts = json_array(), *columns = json_array(), *gains = json_array();
    for (size_t i = 0; i < k->chart_count; i++)
        json_array_append_new(charts, describe_chart(k, &k->charts[i]));
    for (size_t i = 0; i < k->column_count; i++)
        json_array_append_new(columns,
                              json_pack("{s:s, s:s}", "name", k->columns[i].name, "meaning", k->columns[i].meaning));
    for (size_t i = 0; i < k->gain_count; i++)
        json_array_append_new(gains, describe_gain(&k->gains[i], &c->table));
    return json_pack("{s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:i, s:o, s:o, s:o}", "name", k->name, "title", k->title,
                     "trades", k->trades, "preset", k->preset, "proven", k->proven, "truth", k->truth, "headline",
                     c->headline, "defence", c->defence, "beyond", (int)c->beyond, "charts", charts, "columns", columns,
                     "gains", gains);
}

/* Write JSON into a page, where "<" might begin a tag. */
static void write_json(json_t *json, FILE *out)
{
    char *text = json ? json_dumps(json, JSON_COMPACT) : NULL;
    if (!text)
        stop_with_error("out of memory");
    for (const char *c = text; *c; c++)
        if (*c == '<')
            fputs("\\u003c", out);
        else
            fputc(*c, out);
    free(text);
    json_decref(json);
}

static void write_about(const chapter *chapters, size_t count, const measured_where *where, FILE *out)
{
    json_t *all = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(all, describe_chapter(&chapters[i]));
    write_json(json_pack("{s:s, s:s, s:s, s:s, s:s, s:b, s:i, s:o}", "date", where->date, "machine", where->machine,
                         "compiler", where->compiler, "libraries", where->libraries, "points", where->points, "quick",
                         where->quick, "rounds", where->rounds, "chapters", all),
               out);
}

#define ABOUT_TAG "<script type=\"application/json\" id=\"about\">"
#define TABLE_TAG "<script type=\"text/csv\" id=\"csv-%s\">\n"
#define NOTES_TAG "<script type=\"application/json\" id=\"notes-"
#define PICTURES_TAG "<script type=\"application/json\" id=\"pictures-"

/* Write a JSON array that belongs to a chapter, if it is not null. */
static void write_block(const char *tag, const char *name, json_t *array, FILE *out)
{
    if (!array)
        return;
    fprintf(out, "%s%s\">\n", tag, name);
    write_json(json_incref(array), out);
    fputs("\n</script>\n", out);
}

void page_write(const char *path, const chapter *chapters, size_t count, const measured_where *where)
{
    FILE *out = fopen(path, "w");
    if (!out)
        stop_with_error("%s: %s", path, strerror(errno));
    fputs("<!doctype html>\n<!-- SPDX-License-Identifier: MIT -->\n<html lang=\"en\"><head><meta "
          "charset=\"utf-8\"><meta name=\"viewport\" "
          "content=\"width=device-width\"><meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
          "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:\"><title>Octreel: what speed costs in "
          "accuracy</title>\n<style>\n",
          out);
    write_part("page.css", out);
    fputs("</style></head><body>\n<noscript>This page draws its charts with a script, which this browser does not run. "
          "The tables are in the text of the page.</noscript>\n" ABOUT_TAG "\n",
          out);
    write_about(chapters, count, where, out);
    fputs("\n</script>\n", out);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, TABLE_TAG, chapters[i].knob->name);
        table_write_csv(&chapters[i].table, true, out);
        fputs("</script>\n", out);
        write_block(NOTES_TAG, chapters[i].knob->name, chapters[i].table.notes, out);
        write_block(PICTURES_TAG, chapters[i].knob->name, chapters[i].table.pictures, out);
    }
    fputs("<script>\n", out);
    write_part("page.js", out);
    fputs("</script></body></html>\n", out);
    if (fclose(out) != 0)
        stop_with_error("%s cannot be written", path);
}

/* ---- Reading again ------------------------------------------------------------------------------------------ */

static char *member(const char *path, const json_t *about, const char *name)
{
    const char *text = json_string_value(json_object_get(about, name));
    if (!text)
        stop_with_error("%s: the description of the figures lacks \"%s\"", path, name);
    return copy_text(text);
}

measured_where page_read_where(const char *path, const char *text)
{
    const char *const start = strstr(text, ABOUT_TAG);
    json_t *about = start ? json_loads(start + strlen(ABOUT_TAG), JSON_DISABLE_EOF_CHECK, NULL) : NULL;
    if (!about)
        stop_with_error("%s is not a page of octree-tradeoff", path);
    const measured_where where = {.date = member(path, about, "date"),
                                  .machine = member(path, about, "machine"),
                                  .compiler = member(path, about, "compiler"),
                                  .libraries = member(path, about, "libraries"),
                                  .points = member(path, about, "points"),
                                  .quick = json_is_true(json_object_get(about, "quick")),
                                  .rounds = (int)json_integer_value(json_object_get(about, "rounds"))};
    json_decref(about);
    return where;
}

/* A JSON array of a chapter; null if there is none. */
static json_t *read_block(const char *text, const char *tag, const char *name)
{
    char whole[96];
    snprintf(whole, sizeof whole, "%s%s\">\n", tag, name);
    const char *const start = strstr(text, whole);
    return start ? json_loads(start + strlen(whole), JSON_DISABLE_EOF_CHECK, NULL) : NULL;
}

bool page_read_table(const char *path, const char *text, const knob *k, table *t)
{
    char tag[96];
    snprintf(tag, sizeof tag, TABLE_TAG, k->name);
    const char *const start = strstr(text, tag);
    *t = (table){.columns = k->columns, .column_count = k->column_count};
    if (start && !table_read_csv(t, start + strlen(tag)))
        stop_with_error("%s: the table of %s is cut off, or has other columns than this program", path, k->name);
    t->notes = read_block(text, NOTES_TAG, k->name);
    t->pictures = read_block(text, PICTURES_TAG, k->name);
    return start != NULL;
}
