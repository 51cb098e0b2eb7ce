/* SPDX-License-Identifier: MIT */
/* page.c - see page.h. */
#include "page.h"

#include <math.h>
#include <string.h>

#include "program.h"

static const char style[] =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:74rem;margin:2rem auto;padding:0 1rem;color:#1b2430;"
    "background:#fdfdfc}h1{margin-bottom:0}h2{margin:3rem 0 .5rem;border-top:1px solid #d8dce2;padding-top:1.5rem}"
    "img{max-width:100%;height:auto;display:block;margin:1rem 0}.headline{font-size:1.15rem;font-weight:600;"
    "border-left:4px solid #2a7f9e;padding-left:.8rem}dl{display:grid;grid-template-columns:7rem 1fr;gap:.2rem 1rem}"
    "dt{color:#5a6675}dd{margin:0}.holds{color:#17693a}.broken{color:#b3261e;font-weight:700}"
    ".scroll{overflow-x:auto;max-height:32rem;overflow-y:auto}table{border-collapse:collapse;font-size:.8rem;"
    "font-variant-numeric:tabular-nums}th,td{padding:.15rem .6rem;text-align:right;white-space:nowrap}"
    "th{position:sticky;top:0;background:#eef1f4}td:first-child,td:nth-child(2){text-align:left}"
    "tr:nth-child(even){background:#f6f7f8}summary{cursor:pointer;color:#2a5f86}";

static void write_escaped(const char *text, FILE *out)
{
    for (; *text; text++) {
        const char *entity = *text == '<' ? "&lt;" : *text == '>' ? "&gt;" : *text == '&' ? "&amp;" : NULL;
        if (entity)
            fputs(entity, out);
        else
            fputc(*text, out);
    }
}

static void write_base64(FILE *from, FILE *out)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned char three[3];
    size_t size;
    while ((size = fread(three, 1, 3, from)) > 0) {
        const unsigned bits =
            (unsigned)three[0] << 16 | (size > 1 ? (unsigned)three[1] << 8 : 0) | (size > 2 ? (unsigned)three[2] : 0);
        for (size_t i = 0; i < 4; i++)
            fputc(i <= size ? digits[bits >> (18 - 6 * i) & 63] : '=', out);
    }
}

static void write_plot(const knob *k, const char *folder, FILE *out)
{
    char path[4200];
    snprintf(path, sizeof path, "%s/%s.png", folder, k->name);
    FILE *plot = fopen(path, "rb");
    if (!plot)
        stop_with_error("cannot read %s", path);
    fprintf(out,
            "<img alt=\"%s: what is measured against what is proven, and what it costs\" "
            "src=\"data:image/png;base64,",
            k->title);
    write_base64(plot, out);
    fputs("\">\n", out);
    fclose(plot);
}

static void write_facts(const chapter *c, FILE *out)
{
    const struct {
        const char *name, *text;
    } facts[] = {{"Trades", c->knob->trades},
                 {"Default", c->knob->preset},
                 {"Why", c->defence},
                 {"Proven", c->knob->proven},
                 {"Truth", c->knob->truth}};
    fputs("<dl>", out);
    for (size_t i = 0; i < sizeof facts / sizeof facts[0]; i++) {
        fprintf(out, "<dt>%s</dt><dd>", facts[i].name);
        write_escaped(facts[i].text, out);
        fputs("</dd>", out);
    }
    fputs("<dt>Bounds</dt>", out);
    if (c->beyond)
        fprintf(out, "<dd class=\"broken\">%zu values are beyond their bound</dd></dl>\n", c->beyond);
    else
        fputs("<dd class=\"holds\">every measured value is within its bound</dd></dl>\n", out);
}

static void write_number(double value, FILE *out)
{
    if (isnan(value))
        fputs("<td>&ndash;</td>", out);
    else if (value == floor(value) && fabs(value) < 1e9)
        fprintf(out, "<td>%.0f</td>", value);
    else
        fprintf(out, "<td>%.5g</td>", value);
}

static void write_table(const chapter *c, FILE *out)
{
    const table *t = &c->table;
    fprintf(out, "<details><summary>All %zu rows (also in %s.csv)</summary><ul>", t->count, c->knob->name);
    for (size_t i = 0; i < t->column_count; i++) {
        fprintf(out, "<li><b>%s</b>: ", t->columns[i].name);
        write_escaped(t->columns[i].meaning, out);
        fputs("</li>", out);
    }
    fputs("</ul><div class=\"scroll\"><table><tr><th>scene</th><th>variant</th>", out);
    for (size_t i = 0; i < t->column_count; i++)
        fprintf(out, "<th>%s</th>", t->columns[i].name);
    fputs("</tr>\n", out);
    for (size_t i = 0; i < t->count; i++) {
        fprintf(out, "<tr><td>%s</td><td>%s</td>", t->rows[i].scene, t->rows[i].variant);
        for (size_t j = 0; j < t->column_count; j++)
            write_number(t->rows[i].values[j], out);
        fputs("</tr>\n", out);
    }
    fputs("</table></div></details>\n", out);
}

static void write_chapter(const chapter *c, const run *r, bool plotted, FILE *out)
{
    fprintf(out, "<h2 id=\"%s\">", c->knob->name);
    write_escaped(c->knob->title, out);
    fputs("</h2>\n<p class=\"headline\">", out);
    write_escaped(c->headline, out);
    fputs("</p>\n", out);
    if (plotted)
        write_plot(c->knob, r->folder, out);
    write_facts(c, out);
    write_table(c, out);
}

static void write_head(const run *r, bool plotted, FILE *out)
{
    fprintf(
        out,
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width\"><title>Octreel: the trade</title><style>%s</style></head><body>\n"
        "<h1>What speed costs in accuracy, and accuracy in speed</h1>\n<p>Every knob of Octreel that trades the two, "
        "measured against a truth that is exact: lines are proven bounds, points the worst that was measured. Times "
        "are processor time of this machine, medians of %d rounds in turn; counts are the same on every machine."
        "%s%s</p>\n",
        style, r->rounds, r->quick ? " This is the small version: its times mean little." : "",
        plotted ? "" : " There are no plots on this page, because gnuplot was not found.");
}

void page_write(const chapter *chapters, size_t count, const run *r, bool plotted)
{
    char path[4200];
    snprintf(path, sizeof path, "%s/tradeoff.html", r->folder);
    FILE *out = fopen(path, "w");
    if (!out)
        stop_with_error("cannot write %s", path);
    write_head(r, plotted, out);
    fputs("<ul>\n", out);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "<li><a href=\"#%s\">", chapters[i].knob->name);
        write_escaped(chapters[i].knob->title, out);
        fputs("</a></li>\n", out);
    }
    fputs("</ul>\n", out);
    for (size_t i = 0; i < count; i++)
        write_chapter(&chapters[i], r, plotted, out);
    fputs("</body></html>\n", out);
    if (fclose(out) != 0)
        stop_with_error("cannot write %s", path);
}
