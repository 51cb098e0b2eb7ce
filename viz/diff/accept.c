/* SPDX-License-Identifier: MIT */
/* accept.c - compares references with new frames, replaces the references that differ, and reports the changes. */
#include "accepting.h"
#include "file_kind.h"
#include "png_read.h"
#include "json_write.h"
#include "text.h"
#include "diff_words.h"
#include "file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Deciding ----------------------------------------------------------------------------------------------- */

/* Check that the name of a new reference fits its kind. A folder may not have a name such as "x.json"; a picture
 * must have a name that ends in ".png". */
static bool check_new_name(const accept_options *o, diff_kind kind, octreel_error *error)
{
    const output_kind name = output_kind_of_name(o->reference);
    if (kind == DIFF_BASELINE)
        return name == NAME_OPEN || name == NAME_FILE ||
               error_set(error, "%s: cannot create a baseline under the name of a picture or film; use NAME.txt",
                         o->reference);
    if (kind == DIFF_PICTURE)
        return name == NAME_PNG || error_set(error,
                                             "%s: cannot create a reference picture from %s under this name; "
                                             "use NAME.png",
                                             o->reference, o->frames);
    return name == NAME_OPEN ||
           error_set(
               error,
               "%s: this is the name of a file, but the references are a folder; use the name of a folder, or add "
               "--reason TEXT to create a baseline, which is a file",
               o->reference);
}

/* Check that the options fit the kind of the reference. A baseline must be given a reason. A picture, a folder or a
 * recording may not be given a reason. */
static bool check_options(const accepting *a, octreel_error *error)
{
    const accept_options *o = a->options;
    if (a->reference.kind == DIFF_BASELINE)
        return o->note.reason ||
               error_set(error, "%s: accepting into a baseline needs a reason: add --reason TEXT", o->reference);
    return (!o->note.reason && !o->store && !o->variant) ||
           error_set(error, "%s: --reason, --store and --variant work with a baseline only, and this is a %s",
                     o->reference, diff_kind_name(a->reference.kind));
}

/* Return a side without frames, for a reference that does not exist yet. */
static diff_side make_empty_side(const char *path, diff_kind kind, bool no_frames)
{
    return (diff_side){.path = path, .source = path, .kind = kind, .background = IMAGE_WHITE, .no_frames = no_frames};
}

/* Open the reference and the frames. A reference that does not exist yet becomes a side without frames: a baseline
 * if a reason was given, else a side of the same kind as the frames. If a recording is accepted into an empty
 * folder, the reference is a recording. */
static bool open_sides(accepting *a, octreel_error *error)
{
    const accept_options *o = a->options;
    const diff_search in_frames = {o->flat, {o->reference, o->store}}, in_reference = {o->flat, {o->frames, o->store}};
    if (!diff_side_open(&a->frames, o->frames, &in_frames, error))
        return false;
    if (a->frames.kind == DIFF_BASELINE)
        return error_set(error, "%s: cannot accept a baseline; give the pictures themselves", o->frames);
    if (a->frames.count == 0 && !a->frames.no_frames)
        return error_set(error, "%s: contains no PNG files", o->frames);
    a->is_new = access(o->reference, F_OK) != 0 && errno == ENOENT;
    if (a->is_new) {
        const bool baseline = o->note.reason || o->store || o->variant;
        a->reference =
            make_empty_side(o->reference, baseline ? DIFF_BASELINE : a->frames.kind, a->frames.no_frames && !baseline);
        return check_new_name(o, a->reference.kind, error);
    }
    if (!diff_side_open(&a->reference, o->reference, &in_reference, error))
        return false;
    if (a->reference.kind == DIFF_RECORDING && a->frames.kind == DIFF_FOLDER)
        return error_set(error,
                         "the reference %s is a recording, but %s holds only frames, so the ticks of the reference "
                         "would not match them; record the "
                         "session again and accept that recording",
                         o->reference, o->frames);
    if (a->reference.kind == DIFF_FOLDER && a->reference.count == 0 && a->frames.kind == DIFF_RECORDING)
        a->reference = make_empty_side(o->reference, DIFF_RECORDING, a->frames.no_frames);
    return true;
}

static bool is_name_listed(const accept_options *options, const char *name)
{
    for (size_t i = 0; i < options->names->count; i++)
        if (strcmp(options->names->frames[i].name, name) == 0)
            return true;
    return options->names->count == 0 && !options->choose;
}

/* Frames in different folders may have the same file name. Return the name of the first frame, in any folder, that
 * has the file name of `name`. Return null if there is none. */
static const char *find_frame_with_file_name(const diff_result *result, const char *name)
{
    for (size_t i = 0; i < result->count; i++) {
        const char *other = diff_pair_name(&result->pairs[i]);
        if (strcmp(path_base_name(other), path_base_name(name)) == 0)
            return other;
    }
    return NULL;
}

static bool check_listed_names(const accepting *a, octreel_error *error)
{
    for (size_t i = 0; i < a->options->names->count; i++) {
        const listed_frame *listed = &a->options->names->frames[i];
        char line[48] = "";
        if (diff_find(&a->result, listed->name))
            continue;
        if (listed->line)
            snprintf(line, sizeof line, "line %zu of the list: ", listed->line);
        const char *meant = find_frame_with_file_name(&a->result, listed->name);
        return error_set(error, "%sno frame %s in %s or in %s%s%s%s", line, listed->name, a->frames.path,
                         a->reference.path, meant ? "; did you mean " : "", meant ? meant : "", meant ? "?" : "");
    }
    return true;
}

static action choose_action(diff_finding finding)
{
    if (finding == FOUND_NO_FRAME)
        return REMOVED;
    if (finding == FOUND_NO_REFERENCE)
        return ADDED;
    return finding == FOUND_SAME_BYTES || finding == FOUND_SAME_PIXELS ? KEPT : CHANGED;
}

/* Check that a new frame can be read, and compute its digest. If the reference cannot be read, this is no error,
 * because the new frame replaces it. */
static bool check_new_frame(const accepting *a, diff_pair *pair, octreel_error *error)
{
    pair->about[1].kind = IMAGE_DIGEST_NEWEST;
    return digest_picture(pair->b->path, a->reference.background, &pair->about[1], error);
}

/* Check that the new frame of a reference is really missing. The frames in folders that were not searched are
 * unknown, and their references must stay. */
static bool check_frame_is_missing(const accepting *a, const char *name, octreel_error *error)
{
    char *path = path_join(a->frames.path, name);
    bool ok = path || error_no_memory(error);
    if (ok && access(path, F_OK) == 0)
        ok = error_set(
            error,
            "%s: refusing to remove its reference: the frame exists, but its folder was not searched "
            "(it is a link or a recording, it contains evidence, or --no-recursive was given); name the frames to "
            "accept",
            path);
    else if (ok && errno != ENOENT && errno != ENOTDIR)
        ok = error_set(error, "%s: refusing to remove its reference: %s", path, strerror(errno));
    free(path);
    return ok;
}

static bool check_action(const accepting *a, action what, diff_pair *pair, octreel_error *error)
{
    if (what == REMOVED)
        return check_frame_is_missing(a, pair->a->name, error);
    return what == KEPT || check_new_frame(a, pair, error);
}

static bool decide_actions(accepting *a, octreel_error *error)
{
    a->actions = calloc(a->result.count + 1, sizeof *a->actions);
    if (!a->actions)
        return error_no_memory(error);
    for (size_t i = 0; i < a->result.count; i++) {
        diff_pair *pair = &a->result.pairs[i];
        if (pair->lacks_resources)
            return pair->trouble ? error_set(error, "%s", pair->trouble) : error_no_memory(error);
        a->actions[i] = is_name_listed(a->options, diff_pair_name(pair)) ? choose_action(pair->finding) : KEPT;
        a->counts[a->actions[i]]++;
        if (!check_action(a, a->actions[i], pair, error))
            return false;
    }
    return true;
}

/* Refuse to remove all references. If no reference has a new frame of the same name, the user probably gave the
 * wrong folder. */
static bool check_some_references_stay(const accepting *a, octreel_error *error)
{
    const size_t references = a->reference.count;
    return references == 0 || a->options->names->count > 0 || a->counts[REMOVED] < references ||
           error_set(
               error,
               "%s: refusing to remove all %zu references: %s has no frame of the same name; is it the wrong folder?",
               a->reference.path, references, a->frames.path);
}

static bool compare_sides(accepting *a, octreel_error *error)
{
    const accept_options *o = a->options;
    diff_options exact = diff_options_default();
    if (a->reference.kind == DIFF_BASELINE)
        exact.background = a->reference.background;
    else
        a->reference.background = exact.background;
    if (o->choose && !a->is_new)
        exact.store = o->store; /* its pictures are shown */
    return diff_run(&a->reference, &a->frames, &exact, &a->result, error) &&
           (!o->choose || o->choose(o->choose_context, &a->reference, &a->frames, &a->result, o->names, error)) &&
           check_listed_names(a, error) && decide_actions(a, error) && check_some_references_stay(a, error);
}

/* ---- Reporting ----------------------------------------------------------------------------------------------- */

static const char *const action_words[] = {[CHANGED] = "changed", [ADDED] = "new", [REMOVED] = "removed"};

static void print_action(const accepting *a, const diff_pair *pair, action what)
{
    fprintf(a->out, "  %-8s ", action_words[what]);
    if (what == CHANGED)
        diff_print_pair(a->out, pair);
    else
        write_escaped(a->out, diff_pair_name(pair), escape_nothing);
    if (what == ADDED)
        fprintf(a->out, ": %dx%d", pair->about[1].width, pair->about[1].height);
    fputc('\n', a->out);
}

static void print_changes(const accepting *a)
{
    size_t printed = 0;
    if (a->result.by_ticks) {
        write_escaped(a->out, a->reference.path, escape_nothing);
        fprintf(a->out, ": the ticks are %s\n", a->result.verdict == DIFF_SAME ? "unchanged" : "new");
        return;
    }
    for (size_t i = 0; i < a->result.count; i++)
        if (a->actions[i] != KEPT && printed++ < LIST_LINES)
            print_action(a, &a->result.pairs[i], a->actions[i]);
    print_remaining_count(a->out, printed, LIST_LINES, "");
    const size_t before = a->reference.count, after = before + a->counts[ADDED] - a->counts[REMOVED];
    write_escaped(a->out, a->reference.path, escape_nothing);
    fprintf(a->out, ": %zu before, %zu after: %zu changed, %zu new, %zu removed\n", before, after, a->counts[CHANGED],
            a->counts[ADDED], a->counts[REMOVED]);
    if (a->reference.kind == DIFF_RECORDING && a->options->names->count > 0 && printed > 0)
        fprintf(a->out, "ticks.jsonl was not changed; accept all frames to replace it too.\n");
}

static void write_frames_json(const accepting *a, json_writer *w)
{
    json_write_integer_member(w, "before", a->reference.count);
    json_write_integer_member(w, "after", a->reference.count + a->counts[ADDED] - a->counts[REMOVED]);
    for (action what = CHANGED; what <= REMOVED; what++)
        json_write_integer_member(w, action_words[what], a->counts[what]);
    json_begin_array_member(w, "frames");
    for (size_t i = 0; i < a->result.count; i++) {
        if (a->actions[i] == KEPT)
            continue;
        json_write_begin_object(w);
        json_write_text_member(w, "name", diff_pair_name(&a->result.pairs[i]));
        json_write_text_member(w, "action", action_words[a->actions[i]]);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

static void write_changes_json(const accepting *a)
{
    json_writer writer = {.out = a->out}, *w = &writer;
    json_write_begin_object(w);
    json_write_text_member(w, "reference", a->reference.path);
    if (a->result.by_ticks)
        json_write_text_member(w, "ticks", a->result.verdict == DIFF_SAME ? "same" : "new");
    else
        write_frames_json(a, w);
    json_write_end_object(w);
    json_write_end_line(w);
}

static bool replace_references(accepting *a, octreel_error *error)
{
    if (a->options->choose && a->options->names->count == 0)
        return true; /* for the functions below, an empty list means all frames */
    return (a->reference.kind == DIFF_BASELINE ? accept_digests : accept_pictures)(a, error);
}

bool accept_frames(const accept_options *options, FILE *out, octreel_error *error)
{
    accepting a = {.options = options, .out = out};
    const int lock = file_lock_parent_folder(options->reference);
    const bool ok = open_sides(&a, error) && check_options(&a, error) && accept_check_whole(&a.frames, error) &&
                    (a.is_new || accept_check_ended(&a.reference, error)) && compare_sides(&a, error) &&
                    replace_references(&a, error);
    if (ok && out)
        (options->json ? write_changes_json : print_changes)(&a);
    free(a.actions);
    diff_release(&a.result);
    diff_side_release(&a.reference);
    diff_side_release(&a.frames);
    if (lock >= 0)
        close(lock);
    return ok;
}
