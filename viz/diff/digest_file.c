/* SPDX-License-Identifier: MIT */
/* digest_file.c - files of digests, read and written. */
#include "digest_file.h"
#include "baseline.h"
#include "file_kind.h"
#include "parallel.h"
#include "text.h"
#include "file.h"
#include "image_digest.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Reading ------------------------------------------------------------------------------------------------- */

bool digest_file_take_hexadecimal(const char **at, size_t digits, char end, uint64_t *value)
{
    if (strspn(*at, "0123456789abcdef") != digits || (*at)[digits] != end)
        return false;
    *value = strtoull(*at, NULL, 16);
    *at += digits + 1;
    return true;
}

static bool take_side_length(const char **at, char end, int *value)
{
    char *end_of_number;
    if (**at < '1' || **at > '9')
        return false;
    const long length = strtol(*at, &end_of_number, 10);
    *value = (int)length;
    *at = end_of_number + 1;
    return *end_of_number == end && length <= IMAGE_MAX_SIDE;
}

bool digest_file_take_size(const char **at, char end, frame_digest *digest)
{
    return take_side_length(at, 'x', &digest->width) && take_side_length(at, end, &digest->height);
}

bool digest_file_holds_control(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 127)
            return true;
    return false;
}

static bool parse_background(const char *line, image_color *color)
{
    static const char word[] = "background ";
    uint64_t value;
    if (strncmp(line, word, sizeof word - 1) != 0)
        return false;
    line += sizeof word - 1;
    if (!digest_file_take_hexadecimal(&line, 6, 0, &value))
        return false;
    *color = (image_color){(uint8_t)(value >> 16), (uint8_t)(value >> 8), (uint8_t)value};
    return true;
}

static bool parse_frame(const char *line, frame_digest *digest, const char **name)
{
    *digest = (frame_digest){.kind = IMAGE_DIGEST_RUNS};
    const bool ok =
        digest_file_take_hexadecimal(&line, 16, ' ', &digest->pixels) && digest_file_take_size(&line, ' ', digest);
    *name = line;
    return ok && *line && !digest_file_holds_control(line) && !strchr(line, '/');
}

/* What is between "<<<<<<< ours" and ">>>>>>> theirs" is of two files. */
static bool is_conflict(const char *line)
{
    return strlen(line) >= 7 && strchr("<=>|", line[0]) && strspn(line, (char[]){line[0], 0}) == 7 &&
           (line[7] == 0 || line[7] == ' ');
}

static bool take_head(diff_side *side, const char *line, size_t number, octreel_error *error)
{
    static const char first[] = DIGEST_FILE_BEGINNING;
    const char *version = line + sizeof first - 1;
    if (number == 2)
        return parse_background(line, &side->background) ||
               error_set(error, "%s:2: expected a background, as in \"background ffffff\"", side->path);
    if (strncmp(line, first, sizeof first - 1) != 0 || (strcmp(version, "1") != 0 && strcmp(version, "2") != 0))
        return error_set(error, "%s:1: this version reads \"%s1\" and \"%s2\" alone", side->path, first, first);
    side->baseline = *version == '2';
    return true;
}

static bool take_frame(diff_side *side, const char *line, size_t number, octreel_error *error)
{
    frame_digest digest;
    const char *name;
    if (!parse_frame(line, &digest, &name))
        return error_set(error, "%s:%zu: expected a digest, a size and a name, as in \"%016d 1280x720 frame.png\"",
                         side->path, number, 0);
    if (side->count > 0 && strcmp(side->frames[side->count - 1].name, name) >= 0)
        return error_set(error, "%s:%zu: names must be in order, each but once", side->path, number);
    return diff_side_add(side, name, digest, error);
}

static bool take_line(diff_side *side, char *line, size_t number, octreel_error *error)
{
    if (is_conflict(line))
        return error_set(error, "%s:%zu: a conflict that git has left; choose among the lines between its marks",
                         side->path, number);
    if (number <= 2)
        return take_head(side, line, number, error);
    return side->baseline ? baseline_take_line(side, line, number, error) : take_frame(side, line, number, error);
}

bool digest_file_parse(diff_side *side, char *text, size_t size, octreel_error *error)
{
    char *const limit = text + size;
    size_t number = 0;
    side->kind = DIFF_DIGESTS;
    if (memchr(text, 0, size))
        return error_set(error, "%s: it holds a zero byte, so it is no text", side->path);
    for (char *line = text, *next; line < limit; line = next) {
        char *end = line + strcspn(line, "\n");
        next = end + 1;
        if (end > line && end[-1] == '\r')
            end[-1] = 0;
        *end = 0;
        if (!take_line(side, line, ++number, error))
            return false;
    }
    if (number < 2)
        return error_set(error, "%s: it ends before its second line", side->path);
    return !side->baseline || baseline_collect(side, error);
}

bool digest_file_read(diff_side *side, octreel_error *error)
{
    char *bytes, reason[FILE_REASON];
    size_t size;
    if (!file_read_whole(side->source, &bytes, &size, reason))
        return error_set(error, "%s: %s", side->path, reason);
    bytes[size] = 0;
    const bool ok = digest_file_parse(side, bytes, size, error);
    free(bytes);
    return ok;
}

/* ---- Writing ------------------------------------------------------------------------------------------------- */

bool digest_file_fail_name(const diff_side *side, const char *name, octreel_error *error)
{
    char *shown = strdup(name);
    error_set(error, "%s: the name \"%s\" has a character that a line cannot hold", side->path,
              shown ? make_printable(shown) : "");
    free(shown);
    return false;
}

void digest_file_write_head(FILE *out, int version, image_color ground)
{
    fprintf(out, "%s%d\nbackground %02x%02x%02x\n", DIGEST_FILE_BEGINNING, version, ground.r, ground.g, ground.b);
}

bool digest_file_write(FILE *out, const diff_side *side, octreel_error *error)
{
    for (size_t i = 0; i < side->count; i++)
        if (digest_file_holds_control(side->frames[i].name))
            return digest_file_fail_name(side, side->frames[i].name, error);
    digest_file_write_head(out, 1, side->background);
    for (size_t i = 0; i < side->count; i++) {
        const diff_frame *frame = &side->frames[i];
        fprintf(out, "%016" PRIx64 " %dx%d %s\n", frame->digest.pixels, frame->digest.width, frame->digest.height,
                frame->name);
    }
    return true;
}

/* ---- Digests of pictures ------------------------------------------------------------------------------------- */

bool digest_frame(const char *path, image_color background, frame_digest *digest, octreel_error *error)
{
    image about;
    uint64_t pixels;
    if (!image_digest_png_by(digest->kind, path, background, &about, &pixels, error))
        return false;
    *digest = (frame_digest){pixels, about.width, about.height, digest->kind, 0};
    return true;
}

typedef struct digesting {
    diff_side *side;
    octreel_error *errors; /* one a frame; empty where it was read */
} digesting;

static void digest_one(size_t i, void *context)
{
    const digesting *d = context;
    diff_frame *frame = &d->side->frames[i];
    frame->digest.kind = IMAGE_DIGEST_RUNS; /* of version 1 */
    if (!digest_frame(frame->path, d->side->background, &frame->digest, &d->errors[i]))
        frame->digest = (frame_digest){0};
}

bool digest_all(diff_side *side, image_color background, octreel_error *error)
{
    if (side->kind == DIFF_DIGESTS)
        return true;
    digesting d = {side, calloc(side->count + 1, sizeof *d.errors)};
    if (!d.errors)
        return error_no_memory(error);
    side->background = background;
    parallel_for(side->count, digest_one, &d);
    bool ok = true;
    for (size_t i = 0; ok && i < side->count; i++)
        if (side->frames[i].digest.width == 0)
            ok = error_set(error, "%s", d.errors[i].text);
    free(d.errors);
    return ok;
}
