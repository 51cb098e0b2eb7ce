/* SPDX-License-Identifier: MIT */
/* report_comment.c - writes a comparison as the comment of a pull request: see report.h. GitHub refuses comments of
 * more than 65536 characters, so findings are written as long as they fit. Pictures have short names of their own,
 * because the programs that post a comment find them in its text. */
#include "diff_words.h"
#include "file.h"
#include "folder.h"
#include "hint.h"
#include "markdown_text.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum {
    MOST_BYTES = 60000,      /* the rest is for what a program adds, such as a link */
    MOST_NAMES = 20,         /* a line of octreel accept names at most so many frames */
    PICTURE_BYTES = 10 << 20 /* GitHub refuses larger pictures */
};

bool diff_comment_prepare(const char *folder, octreel_error *error)
{
    char **names = folder_create(folder, error) ? folder_names(folder, error) : NULL;
    const bool ok =
        names && (!names[0] || error_set(error, "%s: contains %s; choose a new or empty folder", folder, names[0]));
    free(names);
    return ok;
}

/* ---- Texts --------------------------------------------------------------------------------------------------- */

static void write_paragraph(FILE *out, const char *text)
{
    write_markdown_text(out, text);
    fputs("\n\n", out);
}

static bool is_one_line(const char *text)
{
    return !strpbrk(text, "\n\r");
}

static bool is_in_group(const diff_report *report, size_t pair, const frame_group *group)
{
    return report->groups->of[pair] == (size_t)(group - report->groups->groups);
}

/* Write a block with the command that accepts all frames, or those of one group. */
static void write_accept(FILE *out, const diff_report *report, const frame_group *group)
{
    fputs("```sh\noctreel accept ", out);
    hint_write_shell_word(out, report->a->path);
    fputc(' ', out);
    hint_write_shell_word(out, report->b->path);
    if (group && group->count > MOST_NAMES)
        fputs(" --from accept.txt", out);
    for (size_t i = group ? group->first : 0; group && group->count <= MOST_NAMES && i <= group->last; i++)
        if (is_in_group(report, i, group)) {
            fputc(' ', out);
            hint_write_shell_word(out, diff_pair_name(&report->result->pairs[i]));
        }
    fputs(report->a->kind == DIFF_BASELINE ? " --reason \"...\"\n```\n" : "\n```\n", out);
    if (group && group->count > MOST_NAMES)
        fputs("Select this finding in " EVIDENCE_PAGE " to save accept.txt.\n", out);
}

/* Return whether a person can type the command that accepts frames of this comparison. */
static bool can_accept(const diff_report *report)
{
    return is_one_line(report->a->path) && is_one_line(report->b->path) &&
           !file_is_standard_stream(report->a->source) && !file_is_standard_stream(report->b->source) &&
           report->b->kind != DIFF_BASELINE;
}

/* A name that begins with "-" would be read as an option, and octreel accept knows no other way to write it. */
static bool is_typeable_name(const char *name)
{
    return is_one_line(name) && name[0] != '-';
}

/* Return whether the frames of a group can be accepted: they can be read, and their names can be typed. */
static bool can_accept_group(const diff_report *report, const frame_group *group)
{
    bool ok = can_accept(report) && report->result->pairs[group->first].finding != FOUND_UNREADABLE;
    for (size_t i = group->first; ok && i <= group->last; i++)
        ok = !is_in_group(report, i, group) || is_typeable_name(diff_pair_name(&report->result->pairs[i]));
    return ok;
}

/* ---- Pictures ------------------------------------------------------------------------------------------------ */

/* Copy a picture of a pair into the folder of the comment, unless the evidence lacks it or it is too large. Set *copied
 * to whether it was copied. */
static bool copy_picture(const diff_report *report, size_t pair, evidence_picture picture, const char *to, bool *copied,
                         octreel_error *error)
{
    struct stat status;
    char *from = evidence_path(report->evidence, report->result, pair, picture);
    *copied = from && stat(from, &status) == 0 && status.st_size <= PICTURE_BYTES;
    const bool ok = !*copied || file_copy_to(from, to, error);
    free(from);
    return ok;
}

/* Write a table of the pictures of a finding. The comments around it let a program remove the table. */
static bool write_pictures(FILE *out, const diff_report *report, size_t pair, size_t number, const char *folder,
                           octreel_error *error)
{
    char head[96] = "|", line[96] = "|", cells[256] = "|";
    bool ok = true;
    for (int i = EVIDENCE_EXPECTED; ok && i <= EVIDENCE_DIFFERENCE; i++) {
        const char *word = evidence_picture_name((evidence_picture)i);
        char name[64];
        bool copied = false;
        snprintf(name, sizeof name, "%zu.%s.png", number, word);
        char *to = path_join(folder, name);
        ok = to ? copy_picture(report, pair, (evidence_picture)i, to, &copied, error) : error_no_memory(error);
        free(to);
        if (!ok || !copied)
            continue;
        snprintf(head + strlen(head), sizeof head - strlen(head), " %s |", word);
        snprintf(line + strlen(line), sizeof line - strlen(line), "---|");
        snprintf(cells + strlen(cells), sizeof cells - strlen(cells), " ![%s](./%s) |", word, name);
    }
    if (ok && head[1])
        fprintf(out, "<!-- pictures -->\n%s\n%s\n%s\n<!-- /pictures -->\n\n", head, line, cells);
    return ok;
}

/* ---- The comment --------------------------------------------------------------------------------------------- */

static bool write_finding(FILE *out, const diff_report *report, const frame_group *group, size_t number,
                          const char *folder, octreel_error *error)
{
    fprintf(out, "#### %zu. ", number);
    write_markdown_frames(out, report, group);
    fputs("\n\n", out);
    if (group->cause)
        write_paragraph(out, group->cause);
    write_paragraph(out, group->difference);
    if (!write_pictures(out, report, group->first, number, folder, error))
        return false;
    if (can_accept_group(report, group))
        write_accept(out, report, group);
    return true;
}

static void write_head(FILE *out, const diff_report *report)
{
    fputs("### octreel diff: ", out);
    write_paragraph(out, report->groups->verdict);
    if (report->why->headline)
        write_paragraph(out, report->why->headline);
    write_markdown_name(out, report->b->path);
    fputs(" against ", out);
    write_markdown_name(out, report->a->path);
    fputs(", ", out);
    write_markdown_text(out, report->groups->tolerance);
    fputs(".\n\n", out);
}

/* Write the findings as long as they fit, and count the others. */
static bool write_findings(FILE *out, const diff_report *report, const char *folder, octreel_error *error)
{
    const size_t failing = frame_groups_count_failing(report->groups, report->result);
    size_t written = 0, bytes = 0;
    bool ok = true;
    for (size_t i = 0; ok && i < report->groups->count && written < DIFF_COMMENT_FINDINGS; i++) {
        const frame_group *group = &report->groups->groups[i];
        text_stream s;
        char *text = NULL;
        if (!frame_group_fails(group, report->result))
            continue;
        ok = text_stream_begin(&s) && write_finding(s.stream, report, group, written + 1, folder, error);
        ok = (text_stream_end(&s, &text) || error_no_memory(error)) && ok;
        bytes += s.size;
        if (ok && bytes <= MOST_BYTES) {
            fputs(text, out);
            written++;
        }
        free(text);
        if (bytes > MOST_BYTES)
            break;
    }
    if (failing > written)
        fprintf(out, "\nand %zu more finding%s in " EVIDENCE_PAGE "\n", failing - written,
                plural_ending(failing - written));
    return ok;
}

static bool write_comment(FILE *out, const diff_report *report, const char *folder, octreel_error *error)
{
    const size_t failing = frame_groups_count_failing(report->groups, report->result);
    write_head(out, report);
    if (!write_findings(out, report, folder, error))
        return false;
    if (failing != 1 && report->result->verdict == DIFF_DIFFERENT && can_accept(report)) {
        fputs("\nTo accept everything:\n", out);
        write_accept(out, report, NULL);
    }
    return true;
}

bool diff_report_comment(const diff_report *report, const char *folder, octreel_error *error)
{
    char *path = path_join(folder, "comment.md");
    file_writer file;
    bool ok = path ? file_writer_open(&file, path, error) : error_no_memory(error);
    if (ok)
        ok = write_comment(file.stream, report, folder, error) ? file_writer_close(&file, error)
                                                               : file_writer_discard(&file);
    free(path);
    return ok;
}
