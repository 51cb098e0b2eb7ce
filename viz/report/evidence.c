/* SPDX-License-Identifier: MIT */
/* evidence.c - creates the folder of evidence and writes the pictures in it. */
#include "evidence.h"
#include "contact_sheet.h"
#include "file.h"
#include "flip.h"
#include "folder.h"
#include "octree/digest.h"
#include "parallel.h"
#include "png_read.h"
#include "png_write.h"

#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* The text of EVIDENCE_MARKER. It says which files the next comparison removes. */
static const char marker_text[] =
    EVIDENCE_MARKER_BEGINNING "What octreel diff found: open " EVIDENCE_PAGE ".\n"
                              "The next octreel diff -o into this folder removes the page, contact.png and all\n"
                              "pictures named *.expected.png, *.actual.png, *.difference.png and *.flip.png, also in\n"
                              "subfolders.\n";

/* ---- Names --------------------------------------------------------------------------------------------------- */

const char *evidence_picture_name(evidence_picture picture)
{
    static const char *const words[] = {
#define EVIDENCE_WORD(name, word) word,
        EVIDENCE_PICTURE_MAP(EVIDENCE_WORD)
#undef EVIDENCE_WORD
    };
    return words[picture];
}

/* The longest suffix of an evidence file's name. It includes the ".part" of an unfinished file. */
#define LONGEST_ENDING "~0123456789abcdef.difference.png.part"

/* Return how many bytes of a stem fit into a file name together with LONGEST_ENDING, without cutting a UTF-8
 * character. */
static size_t length_of_fitting_stem(const char *stem)
{
    size_t length = NAME_MAX - (sizeof LONGEST_ENDING - 1);
    while (length > 0 && ((unsigned char)stem[length] & 0xc0) == 0x80)
        length--;
    return length;
}

/* "expected", "actual" or "difference" is inserted before the suffix of the frame's name, so different frames get
 * different file names. A name that becomes too long is cut and ends with a digest of the whole name. */
char *evidence_file_name(const char *frame, evidence_picture picture)
{
    const char *file = path_base_name(frame);
    const size_t stem = diff_stem_length(file), size = strlen(frame) + sizeof LONGEST_ENDING;
    const bool fits = stem + sizeof ".difference.png.part" - 1 <= NAME_MAX;
    char digest[24] = "", *name = malloc(size);
    if (!fits)
        snprintf(digest, sizeof digest, "~%016" PRIx64, octree_digest_bytes(OCTREE_DIGEST_START, frame, strlen(frame)));
    if (name)
        snprintf(name, size, "%.*s%.*s%s.%s%s", (int)(file - frame), frame,
                 (int)(fits ? stem : length_of_fitting_stem(file)), file, digest, evidence_picture_name(picture),
                 file[stem] ? file + stem : ".png");
    return name;
}

static bool is_evidence_picture_name(const char *name)
{
    static const char part[] = ".part";
    size_t length = strlen(name);
    if (length > sizeof part - 1 && strcmp(name + length - (sizeof part - 1), part) == 0)
        length -= sizeof part - 1;
    for (int i = 0; i < EVIDENCE_PICTURES; i++) {
        char end[32];
        const size_t size = (size_t)snprintf(end, sizeof end, ".%s.png", evidence_picture_name((evidence_picture)i));
        if (length > size && strncasecmp(name + length - size, end, size) == 0)
            return true;
    }
    return false;
}

bool evidence_is_file_name(const char *name)
{
    static const char *const files[] = {EVIDENCE_PAGE, EVIDENCE_PAGE ".part", CONTACT_SHEET, CONTACT_SHEET ".part"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (strcmp(name, files[i]) == 0)
            return true;
    return is_evidence_picture_name(name);
}

static char *picture_path(const char *folder, const diff_pair *pair, evidence_picture picture)
{
    char *name = evidence_file_name(diff_pair_name(pair), picture), *path = name ? path_join(folder, name) : NULL;
    free(name);
    return path;
}

/* ---- The folder ---------------------------------------------------------------------------------------------- */

/* Return how many levels `outer` is above a folder: 0 if both are the same folder. Return -1 if the folder is not in
 * `outer`. */
static int find_depth(const char *folder, const struct stat *outer)
{
    char path[PATH_MAX];
    struct stat last = {0}, at;
    bool fits = path_print(folder, "", path);
    for (int depth = 0; fits && stat(path, &at) == 0 && !is_same_file(&at, &last); depth++, last = at) {
        if (is_same_file(&at, outer))
            return depth;
        fits = strlen(path) + sizeof "/.." <= sizeof path;
        if (fits)
            strcat(path, "/..");
    }
    return -1;
}

static bool check_folder_holds_no_side(const char *folder, const diff_side *side, octreel_error *error)
{
    struct stat status;
    if (side->kind == DIFF_BASELINE || file_is_standard_stream(side->source) || stat(folder, &status) != 0)
        return true;
    char *compared = side->kind == DIFF_PICTURE ? path_parent_folder(side->path) : strdup(side->path);
    if (!compared)
        return error_no_memory(error);
    const int depth = find_depth(compared, &status);
    free(compared);
    return depth < 0 ||
           error_set(error,
                     "%s: %s is compared, and writing evidence would remove it: choose another folder for evidence",
                     folder,
                     side->kind == DIFF_PICTURE ? "a picture in it"
                     : depth                    ? "a folder in it"
                                                : "it");
}

static bool remove_old_entries(const char *folder, bool top, octreel_error *error);

/* Remove one entry of the folder that an earlier comparison wrote. A file is removed. In a subfolder, the pictures
 * are removed, then the subfolder if it is empty. Other files, hidden folders and folders of other evidence stay. */
static bool remove_old_entry(const char *folder, const char *name, bool top, octreel_error *error)
{
    struct stat status;
    char *path = path_join(folder, name);
    bool ok = path || error_no_memory(error);
    if (ok && lstat(path, &status) == 0 && S_ISDIR(status.st_mode)) {
        const bool clears = name[0] != '.' && !diff_is_evidence_folder(path);
        ok = !clears || remove_old_entries(path, false, error);
        if (clears)
            rmdir(path); /* fails if the folder is not empty */
    } else if (ok && (top ? evidence_is_file_name(name) : is_evidence_picture_name(name)))
        ok = folder_remove_file(folder, name, error);
    free(path);
    return ok;
}

static bool remove_old_entries(const char *folder, bool top, octreel_error *error)
{
    char **names = folder_names(folder, error);
    bool ok = names;
    for (size_t i = 0; ok && names[i]; i++)
        ok = remove_old_entry(folder, names[i], top, error);
    free(names);
    return ok;
}

static bool check_folder_is_empty(const char *folder, octreel_error *error)
{
    char **names = folder_names(folder, error);
    bool ok = names;
    for (size_t i = 0; ok && names[i]; i++)
        ok = strcmp(names[i], EVIDENCE_MARKER ".part") == 0 ||
             error_set(error, "%s: contains %s but no evidence of octreel diff; choose a new or empty folder", folder,
                       names[i]);
    free(names);
    return ok;
}

bool evidence_prepare(const char *folder, const diff_side *a, const diff_side *b, octreel_error *error)
{
    return check_folder_holds_no_side(folder, a, error) && check_folder_holds_no_side(folder, b, error) &&
           folder_create(folder, error) &&
           (diff_is_evidence_folder(folder) ? remove_old_entries(folder, true, error)
                                            : check_folder_is_empty(folder, error)) &&
           folder_write_file(folder, EVIDENCE_MARKER, marker_text, sizeof marker_text - 1, error);
}

/* ---- The files of both sides --------------------------------------------------------------------------------- */

/* Return whether the file of a frame can be copied. Only regular files and standard input can be copied; all other
 * frames are reported as unreadable. */
static bool is_frame_copyable(const diff_frame *frame)
{
    struct stat status;
    if (!frame || !frame->path)
        return false;
    return file_is_standard_stream(frame->path) || (stat(frame->path, &status) == 0 && S_ISREG(status.st_mode));
}

static bool copy_frame(const diff_frame *frame, const diff_pair *pair, evidence_picture picture, const char *folder,
                       unsigned *written, octreel_error *error)
{
    if (!is_frame_copyable(frame))
        return true;
    char *path = picture_path(folder, pair, picture);
    const bool ok =
        path ? folder_create_parents(folder, diff_pair_name(pair), error) && file_copy_to(frame->path, path, error)
             : error_no_memory(error);
    free(path);
    *written |= ok ? 1u << picture : 0;
    return ok;
}

/* ---- The difference ------------------------------------------------------------------------------------------ */

/* Both images of a pair, and the settings with which the rows of their difference are computed. */
typedef struct canvas {
    image images[2];
    image_tolerance tolerance;
    uint8_t *row;
} canvas;

static const uint8_t *difference_row(int y, void *context)
{
    const canvas *c = context;
    image_draw_difference_row(&c->images[0], &c->images[1], &c->tolerance, y, c->row);
    return c->row;
}

/* The reading of both pictures of a pair, in parallel. */
typedef struct reading {
    canvas *c;
    const diff_frame *frames[2];
    image_color background;
    bool ok[2];
    octreel_error errors[2];
} reading;

static void read_picture(size_t i, void *context)
{
    reading *r = context;
    r->ok[i] = image_read_png_over(r->frames[i]->path, r->background, &r->c->images[i], &r->errors[i]);
}

static bool read_pictures(canvas *c, const diff_pair *pair, const diff_options *options, octreel_error *error)
{
    reading r = {.c = c, .frames = {pair->a, pair->b}, .background = options->background};
    if (!pair_tolerance(pair, options, &c->tolerance))
        return error_no_memory(error);
    parallel_for(2, read_picture, &r);
    for (int i = 0; i < 2; i++)
        if (!r.ok[i])
            return error_set(error, "%s", r.errors[i].text);
    return true;
}

static bool write_difference(canvas *c, const char *path, octreel_error *error)
{
    const image *a = &c->images[0], *b = &c->images[1];
    const image_palette palette = image_make_difference_palette();
    const image_rows rows = {.width = a->width > b->width ? a->width : b->width,
                             .height = a->height > b->height ? a->height : b->height,
                             .palette = &palette,
                             .row = difference_row,
                             .context = c};
    c->row = malloc((size_t)rows.width);
    const bool ok = c->row ? image_write_png_rows(&rows, path, error) : error_no_memory(error);
    free(c->row);
    return ok;
}

static const uint8_t *map_row(int y, void *context)
{
    const canvas *c = context;
    return c->row + (size_t)y * (size_t)c->images[0].width;
}

/* Write the FLIP map. c->row holds the whole map. */
static bool write_flip(canvas *c, const char *path, octreel_error *error)
{
    const image *a = &c->images[0];
    const image_palette palette = image_make_magma_palette();
    const image_rows rows = {.width = a->width, .height = a->height, .palette = &palette, .row = map_row, .context = c};
    image_flip flip;
    c->row = malloc((size_t)a->width * (size_t)a->height);
    const bool ok = c->row && image_measure_flip(a, &c->images[1], &c->tolerance, c->row, &flip)
                        ? image_write_png_rows(&rows, path, error)
                        : error_no_memory(error);
    free(c->row);
    return ok;
}

typedef bool picture_writer(canvas *c, const char *path, octreel_error *error);

static bool draw_picture(canvas *c, picture_writer *write, const char *folder, const diff_pair *pair,
                         evidence_picture picture, unsigned *written, octreel_error *error)
{
    char *path = picture_path(folder, pair, picture);
    const bool ok = path ? write(c, path, error) : error_no_memory(error);
    *written |= ok ? 1u << picture : 0;
    free(path);
    return ok;
}

static void release_pictures(canvas *c)
{
    image_release(&c->images[0]);
    image_release(&c->images[1]);
    pair_tolerance_release(&c->tolerance);
}

static bool draw_differences(const diff_pair *pair, const diff_options *options, const char *folder, unsigned *written,
                             octreel_error *error)
{
    canvas c = {0};
    bool ok = read_pictures(&c, pair, options, error) &&
              draw_picture(&c, write_difference, folder, pair, EVIDENCE_DIFFERENCE, written, error);
    if (ok && pair->difference.has_flip)
        ok = draw_picture(&c, write_flip, folder, pair, EVIDENCE_FLIP, written, error);
    release_pictures(&c);
    return ok;
}

bool evidence_has_difference(const diff_pair *pair)
{
    return (pair->finding == FOUND_PIXELS || pair->finding == FOUND_SIZE) && pair->a->path && pair->b->path;
}

bool evidence_write_difference(const diff_pair *pair, const diff_options *options, const char *path,
                               octreel_error *error)
{
    canvas c = {0};
    const bool ok = read_pictures(&c, pair, options, error) && write_difference(&c, path, error);
    release_pictures(&c);
    return ok;
}

bool evidence_write_pair(const diff_pair *pair, const diff_options *options, const char *folder, unsigned *written,
                         octreel_error *error)
{
    *written = 0;
    if (!copy_frame(pair->a, pair, EVIDENCE_EXPECTED, folder, written, error) ||
        !copy_frame(pair->b, pair, EVIDENCE_ACTUAL, folder, written, error))
        return false;
    return !evidence_has_difference(pair) || draw_differences(pair, options, folder, written, error);
}

/* ---- All pairs ----------------------------------------------------------------------------------------------- */

bool evidence_write_groups(evidence *e, const char *folder, const diff_result *result, const frame_groups *groups,
                           octreel_error *error)
{
    *e = (evidence){.folder = folder, .pictures = calloc(result->count + 1, sizeof *e->pictures)};
    bool ok = e->pictures || error_no_memory(error);
    for (size_t i = 0; ok && i < result->count; i++)
        if (diff_finding_verdict(result->pairs[i].finding) != DIFF_SAME && frame_groups_is_first(groups, i))
            ok = evidence_write_pair(&result->pairs[i], &result->options, folder, &e->pictures[i], error);
    if (!ok)
        evidence_release(e);
    return ok;
}

void evidence_release(evidence *e)
{
    free(e->pictures);
    *e = (evidence){0};
}

char *evidence_path(const evidence *e, const diff_result *result, size_t i, evidence_picture picture)
{
    return e->pictures[i] & 1u << picture ? picture_path(e->folder, &result->pairs[i], picture) : NULL;
}
