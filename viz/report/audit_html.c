/* SPDX-License-Identifier: MIT */
/* audit_html.c - writes an audit as an HTML page: see audit_print.h. Charts are SVG and need no script. Each point
 * of a chart is a link to the frame of its tick. If the tick has no frame, the link leads to the recording's page at
 * that tick. */
#include "audit_page.h"
#include "audit_print.h"
#include "file.h"
#include "frame_file.h"
#include "link.h"
#include "number.h"
#include "text.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Links -------------------------------------------------------------------------------------------------- */

/* The HTML page, and the recording to which the links of the page lead. */
typedef struct page {
    FILE *out;
    const audit_verdict *verdict;
    char *base;      /* the relative path of the recording, such as "./../flight/"; null: no recording to link to */
    bool has_viewer; /* the folder of the recording has an index.html, the page that plays the recording */
} page;

/* Set `base` and `has_viewer` of the page. Return false if memory runs out. */
static bool find_link_base(page *p, const char *from)
{
    if (!p->verdict->recording)
        return true;
    p->base = link_make_relative_path(from, p->verdict->path);
    p->has_viewer = link_has_page(p->verdict->path);
    return p->base;
}

/* Print the text `before` and begin a link to the frame of a tick. If there is no frame, print nothing and return
 * false. */
static bool begin_frame_link(const page *p, uint64_t tick, const char *before)
{
    char name[FRAME_NAME];
    if (!p->base || !folder_contains(p->verdict->path, frame_print_name(tick, name)))
        return false;
    fprintf(p->out, "%s<a href=\"", before);
    link_write_path(p->out, p->base);
    link_write_path(p->out, name);
    fputs("\">", p->out);
    return true;
}

/* An element that a link to the recording's page selects: `word` is "point" or "foreign" (a foreign node); null: no
 * element is selected. */
typedef struct link_target {
    const char *word;
    uint64_t id;
} link_target;

/* Print the text `before` and begin a link to the recording's page at a tick. If there is no page, print nothing and
 * return false. */
static bool begin_viewer_link(const page *p, uint64_t tick, link_target target, const char *before)
{
    if (!p->base || !p->has_viewer)
        return false;
    fprintf(p->out, "%s<a href=\"", before);
    link_write_path(p->out, p->base);
    fprintf(p->out, "index.html#t=%" PRIu64, tick);
    if (target.word)
        fprintf(p->out, "&amp;select=%s+%" PRIu64, target.word, target.id);
    fputs("\">", p->out);
    return true;
}

/* ---- Charts ------------------------------------------------------------------------------------------------- */

enum { WIDTH = 960, HEIGHT = 150, LEFT = 70, RIGHT = 20, TOP = 12, FOOT = 26 };

/* A chart of one value of the audit over the ticks: the recall, or the ratio of distances. */
typedef struct chart {
    const audit_kind *kind;
    bool ratio;          /* true: the value is the ratio of distances; false: the recall */
    double from, to;     /* the values at the lower and the upper end of the axis */
    double finite;       /* the largest finite value on the axis; infinite values are drawn at `to` */
    const double *limit; /* null: no limit is drawn */
} chart;

static double chart_value(const chart *c, const audit_tick *tick)
{
    return c->ratio ? tick->ratio : audit_tick_recall(tick);
}

static bool is_worse(const chart *c, const audit_tick *a, const audit_tick *than)
{
    return c->ratio ? a->ratio > than->ratio : audit_tick_recall(a) < audit_tick_recall(than);
}

/* Lay out a chart. One end of its axis is the value 1. The other end is the worst finite value or the limit,
 * whichever is worse. If some values are infinite, the axis is a quarter longer. */
static chart make_chart(const audit_kind *kind, bool ratio, const audit_limits *limits)
{
    chart c = {.kind = kind, .ratio = ratio, .from = 1, .to = 1};
    if (ratio ? limits->by_ratio : limits->by_recall)
        c.limit = ratio ? &limits->ratio : &limits->recall;
    double worst = c.limit ? *c.limit : 1;
    bool beyond = false;
    for (size_t i = 0; i < kind->tick_count; i++) {
        const double value = chart_value(&c, &kind->ticks[i]);
        beyond = beyond || isinf(value);
        worst = !isinf(value) && (ratio ? value > worst : value < worst) ? value : worst;
    }
    if (!ratio)
        c.from = worst < 1 ? worst : 0;
    else
        c.to = worst > 1 ? worst : 2;
    c.finite = c.to;
    c.to += beyond ? (c.to - c.from) / 4 : 0;
    return c;
}

static double chart_x(const chart *c, uint64_t tick)
{
    const uint64_t first = c->kind->ticks[0].tick, last = c->kind->ticks[c->kind->tick_count - 1].tick;
    return LEFT + (last > first ? (double)(tick - first) / (double)(last - first) : 0.5) * (WIDTH - LEFT - RIGHT);
}

/* Return the y coordinate of a value in the chart. An infinite value is drawn at the upper edge. */
static double chart_y(const chart *c, double value)
{
    const double share = isinf(value) ? 1 : (value - c->from) / (c->to - c->from);
    return HEIGHT - FOOT - share * (HEIGHT - FOOT - TOP);
}

static void write_grid_line(const page *p, const chart *c, double value)
{
    char number[NUMBER_TEXT];
    const double y = chart_y(c, value);
    fprintf(p->out, "<path class=\"axis\" d=\"M%d %.1fH%d\"/>", LEFT, y, WIDTH - RIGHT);
    fprintf(p->out, "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n", LEFT - 8, y + 4,
            value > c->finite ? "infinite" : number_format(value, 6, number));
}

static void write_tick_axis(const page *p, const chart *c)
{
    const uint64_t first = c->kind->ticks[0].tick, last = c->kind->ticks[c->kind->tick_count - 1].tick;
    fprintf(p->out, "<text x=\"%.1f\" y=\"%d\">tick %" PRIu64 "</text>", chart_x(c, first), HEIGHT - 8, first);
    if (last > first)
        fprintf(p->out, "<text x=\"%d\" y=\"%d\" text-anchor=\"end\">%" PRIu64 "</text>", WIDTH - RIGHT, HEIGHT - 8,
                last);
    putc('\n', p->out);
}

/* A point of the chart stands for a range of ticks. Return the worst tick of this range. */
static const audit_tick *find_worst_tick(const chart *c, size_t point, size_t points)
{
    const size_t count = c->kind->tick_count;
    const size_t first = (size_t)((double)point / (double)points * (double)count);
    const size_t end = point + 1 == points ? count : (size_t)((double)(point + 1) / (double)points * (double)count);
    const audit_tick *worst = &c->kind->ticks[first];
    for (size_t i = first + 1; i < end; i++)
        if (is_worse(c, &c->kind->ticks[i], worst))
            worst = &c->kind->ticks[i];
    return worst;
}

static void write_chart_point(const page *p, const chart *c, const audit_tick *tick)
{
    char text[AUDIT_RATIO_TEXT];
    const bool linked = begin_frame_link(p, tick->tick, "") || begin_viewer_link(p, tick->tick, (link_target){0}, "");
    fprintf(p->out, "<circle class=\"point%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"><title>tick %" PRIu64 ": ",
            tick->wrong ? " wrong" : "", chart_x(c, tick->tick), chart_y(c, chart_value(c, tick)),
            tick->wrong ? "5" : "2.5", tick->tick);
    fprintf(p->out, "%s %s, %" PRIu64 " of %" PRIu64 " wrong</title></circle>%s\n", c->ratio ? "ratio" : "recall",
            audit_ratio_text(chart_value(c, tick), text), tick->wrong, tick->asked, linked ? "</a>" : "");
}

static void write_chart(const page *p, const audit_kind *kind, bool ratio)
{
    const chart c = make_chart(kind, ratio, &p->verdict->report->limits);
    const size_t points = kind->tick_count < AUDIT_PAGE_POINTS ? kind->tick_count : AUDIT_PAGE_POINTS;
    fprintf(p->out, "<h3>%s, by tick</h3>\n<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"%s by tick\">\n",
            ratio ? "Ratio of distances" : "Recall", WIDTH, HEIGHT, ratio ? "Ratio of distances" : "Recall");
    write_grid_line(p, &c, c.from);
    write_grid_line(p, &c, c.finite);
    if (c.to > c.finite)
        write_grid_line(p, &c, c.to);
    if (c.limit)
        fprintf(p->out, "<path class=\"limit\" d=\"M%d %.1fH%d\"/>\n", LEFT, chart_y(&c, *c.limit), WIDTH - RIGHT);
    write_tick_axis(p, &c);
    fputs("<polyline class=\"way\" points=\"", p->out);
    for (size_t i = 0; i < points; i++) {
        const audit_tick *tick = find_worst_tick(&c, i, points);
        fprintf(p->out, "%s%.1f,%.1f", i ? " " : "", chart_x(&c, tick->tick), chart_y(&c, chart_value(&c, tick)));
    }
    fputs("\"/>\n", p->out);
    for (size_t i = 0; i < points; i++)
        write_chart_point(p, &c, find_worst_tick(&c, i, points));
    fputs("</svg>\n", p->out);
}

/* ---- Words -------------------------------------------------------------------------------------------------- */

/* Print " (frame, page)" with links to the frame and the page of a tick, if they exist. */
static void write_links(const page *p, uint64_t tick, link_target target)
{
    const bool frame = begin_frame_link(p, tick, " (");
    fputs(frame ? "frame</a>" : "", p->out);
    const bool viewer = begin_viewer_link(p, tick, target, frame ? ", " : " (");
    fputs(viewer ? "page</a>" : "", p->out);
    fputs(frame || viewer ? ")" : "", p->out);
}

/* Return the first missing point of a wrong answer. If no point is missing, return the first extra point. Return no
 * target for pairs. */
static link_target find_wrong_point(const audit_case *c)
{
    const octree_point *first = c->place == SIZE_MAX    ? NULL
                                : c->made.missing_count ? c->missing
                                : c->made.extra_count   ? c->extra
                                                        : NULL;
    return first ? (link_target){"point", first->id} : (link_target){0};
}

/* Return the wrong node or, if a point is in no node, this point. */
static link_target find_wrong_node(const octree_wrong_node *wrong)
{
    return wrong->kind == OCTREE_NODE_LOST_POINT ? (link_target){"point", wrong->point}
                                                 : (link_target){"foreign", wrong->node};
}

/* Print a wrong answer: first as a sentence, then as the JSON of its line in ticks.jsonl, which has all digits. */
static void write_wrong_answer(const page *p, const audit_case *c, const octree_query_traits *about)
{
    fprintf(p->out, "<li>tick %" PRIu64, c->tick);
    write_links(p, c->tick, find_wrong_point(c));
    fputs(", ", p->out);
    audit_print_wrong_answer(p->out, c, about);
    fputs("<details><summary>as in ticks.jsonl</summary><pre>", p->out);
    write_escaped(p->out, c->answer, escape_xml_text);
    fputs("</pre></details></li>\n", p->out);
}

static void write_nodes(const page *p, const audit_nodes *nodes)
{
    fprintf(p->out, "<section%s><h2>nodes</h2>\n<p>", nodes->wrong ? " class=\"fails\"" : "");
    audit_print_nodes_head(p->out, nodes);
    fputs(nodes->wrong ? "</p>\n<ul>\n" : "</p>\n", p->out);
    for (int i = 0; i < OCTREE_WRONG_NODE_KINDS; i++) {
        if (!nodes->wrong_by_kind[i])
            continue;
        fputs("<li>", p->out);
        audit_print_wrong_nodes(p->out, nodes, (octree_wrong_node_kind)i);
        if (nodes->first[i].known)
            write_links(p, nodes->first[i].tick, find_wrong_node(&nodes->first[i].node));
        fputs("</li>\n", p->out);
    }
    fputs(nodes->wrong ? "</ul>\n</section>\n" : "</section>\n", p->out);
}

static void write_kind(const page *p, int of)
{
    const audit_kind *kind = &p->verdict->report->kinds[of];
    const octree_query_traits *about = audit_kind_about(of);
    fprintf(p->out, "<section%s><h2>%s</h2>\n<p>",
            audit_kind_passes(kind, &p->verdict->report->limits) ? "" : " class=\"fails\"", about->name);
    audit_print_kind(p->out, p->verdict, of);
    fputs("</p>\n", p->out);
    write_chart(p, kind, false);
    if (about->neighbors)
        write_chart(p, kind, true);
    fputs(kind->worst_count ? "<h3>The worst</h3>\n<ol>\n" : "", p->out);
    for (size_t i = 0; i < kind->worst_count; i++)
        write_wrong_answer(p, &kind->worst[i], about);
    fputs(kind->worst_count ? "</ol>\n</section>\n" : "</section>\n", p->out);
}

/* Print the verdict, the path and the limits. If the audited path is a session and not a recording, also print that
 * the page has no links to frames. */
static void write_head(const page *p)
{
    const audit_verdict *v = p->verdict;
    fprintf(p->out, "<h1%s>", audit_passes(v->report) ? "" : " class=\"fails\"");
    audit_print_summary(p->out, v);
    fputs("</h1>\n<p>octreel audit of ", p->out);
    write_escaped(p->out, v->path, escape_xml_character);
    fputs("</p>\n", p->out);
    audit_print_limits(p->out, "<p>Allowed: ", &v->report->limits, "</p>\n");
    fputs(p->base
              ? "<p>Each point of a chart stands for one or several ticks and shows their worst answer. Click a point "
                "to open its frame. Large points are wrong answers. On the page of the frame you can play on from its "
                "tick.</p>\n"
              : "<p>This session has no frames. Record the session and audit the recording; then a click on a point "
                "of the chart opens the frame of its tick.</p>\n",
          p->out);
}

bool audit_print_page(FILE *out, const audit_verdict *verdict, const char *from)
{
    page p = {.out = out, .verdict = verdict};
    if (!find_link_base(&p, from))
        return false;
    fwrite(audit_page_head, 1, audit_page_head_size, out);
    write_head(&p);
    for (int i = 0; i < AUDIT_KINDS; i++)
        if (verdict->report->kinds[i].asked)
            write_kind(&p, i);
    if (verdict->report->nodes.given)
        write_nodes(&p, &verdict->report->nodes);
    fwrite(audit_page_tail, 1, audit_page_tail_size, out);
    free(p.base);
    return true;
}
