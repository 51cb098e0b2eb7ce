/* SPDX-License-Identifier: MIT */
/* frame_file.c - names, writes, reads and checks the PNG files of frames. */
#include "frame_file.h"
#include "ticks_write.h"
#include "png_chunks.h"
#include "png_read.h"
#include "png_write.h"

#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

static const char tick_keyword[] = "octreel-tick", session_keyword[] = "octreel-session",
                  scene_keyword[] = FRAME_SCENE_KEYWORD, pixels_keyword[] = FRAME_PIXELS_KEYWORD,
                  left_out_keyword[] = "octreel-left-out";

#define NUMBER_SIZE 24 /* the size of a PNG text that holds a number or a digest, in bytes */

char *frame_print_name(uint64_t tick, char name[FRAME_NAME])
{
    snprintf(name, FRAME_NAME, "frame_%06" PRIu64 ".png", tick);
    return name;
}

bool frame_parse_name(const char *name, uint64_t *tick)
{
    char again[FRAME_NAME];
    if (strncmp(name, "frame_", 6) != 0)
        return false;
    *tick = strtoull(name + 6, NULL, 10);
    return strcmp(name, frame_print_name(*tick, again)) == 0;
}

bool frame_is_due(uint64_t tick, uint64_t every)
{
    return every > 0 && tick % every == 0;
}

bool frame_is_name_of_recording(const char *name, uint64_t ticks, uint64_t every)
{
    uint64_t tick;
    return frame_parse_name(name, &tick) && tick < ticks && frame_is_due(tick, every);
}

/* Prints the path of a tick's frame. Returns false with an error if the path has PATH_MAX or more bytes, which the
 * system would refuse. */
static bool print_frame_path(const char *folder, uint64_t tick, char path[PATH_MAX], octreel_error *error)
{
    char name[FRAME_NAME];
    return path_print(folder, frame_print_name(tick, name), path) ||
           error_set(error, "%s: the path is too long", folder);
}

bool frame_write(const char *folder, const image *picture, const frame_origin *origin, octreel_error *error)
{
    char path[PATH_MAX], tick[NUMBER_SIZE], left_out[NUMBER_SIZE], digests[2][DIGEST_TEXT], pixels[IMAGE_DIGEST_TEXT];
    snprintf(tick, sizeof tick, "%" PRIu64, origin->tick);
    snprintf(left_out, sizeof left_out, "%" PRIu64, origin->left_out);
    const image_text texts[] = {
        {tick_keyword, tick},
        {session_keyword, digest_print(origin->session, digests[0])},
        {scene_keyword, digest_print(origin->scene, digests[1])},
        {pixels_keyword, image_digest_print(IMAGE_DIGEST_NEWEST, image_digest(picture), pixels)},
        {left_out_keyword, left_out},
    };
    const size_t count = sizeof texts / sizeof texts[0] - (origin->left_out == 0);
    return print_frame_path(folder, origin->tick, path, error) && image_write_png(picture, path, texts, count, error);
}

/* Parses the PNG text that holds the number of a frame's tick. Returns false with an error if the text differs from
 * the text that frame_write() writes for this number. */
static bool parse_tick(const char *path, const char *text, uint64_t *tick, octreel_error *error)
{
    char again[NUMBER_SIZE];
    *tick = strtoull(text, NULL, 10);
    snprintf(again, sizeof again, "%" PRIu64, *tick);
    return strcmp(text, again) == 0 ||
           error_set(error, "%s: its PNG text %s is not the number of a tick", path, tick_keyword);
}

/* Reads the PNG text with a given keyword from a frame. Returns false with an error if the frame has no such text. */
static bool read_text_chunk(const char *path, const char *keyword, char text[NUMBER_SIZE], octreel_error *error)
{
    return image_read_text(path, keyword, text, NUMBER_SIZE) ||
           error_set(error, "%s: has no PNG text %s; another program may have saved the file", path, keyword);
}

/* Checks that the PNG text with a given keyword is the expected digest. If the text is missing or differs, returns
 * false and sets the error to `message`. */
static bool check_digest(const char *path, const char *keyword, uint64_t expected, const char *message,
                         octreel_error *error)
{
    char text[NUMBER_SIZE], digest[DIGEST_TEXT];
    return read_text_chunk(path, keyword, text, error) &&
           (strcmp(text, digest_print(expected, digest)) == 0 || error_set(error, "%s: %s", path, message));
}

static const char pixels_changed[] =
    "its pixels do not match its PNG text octreel-pixels: the file was changed after drawing";

/* Reads the digest of the pixels from a frame's PNG text. The digest is stored in *stated, its kind in *kind. If the
 * text is not a digest, *kind is unchanged. */
static bool read_pixel_digest(const char *path, image_digest_kind *kind, uint64_t *stated, octreel_error *error)
{
    char text[NUMBER_SIZE];
    return read_text_chunk(path, pixels_keyword, text, error) &&
           (image_digest_parse(text, kind, stated) || error_set(error, "%s: %s", path, pixels_changed));
}

static bool check_pixels(const char *path, frame_origin *origin, octreel_error *error)
{
    octreel_error reason;
    image about;
    uint64_t stated = 0;
    origin->kind = IMAGE_DIGEST_NEWEST;
    const bool has_digest = read_pixel_digest(path, &origin->kind, &stated, error);
    if (!image_digest_png(origin->kind, path, IMAGE_WHITE, &about, &origin->pixels, &reason))
        return error_set(error, "%s", reason.text);
    return has_digest && (stated == origin->pixels || error_set(error, "%s: %s", path, pixels_changed));
}

static bool check_tick(const char *path, uint64_t expected, octreel_error *error)
{
    char text[NUMBER_SIZE];
    uint64_t tick;
    return read_text_chunk(path, tick_keyword, text, error) && parse_tick(path, text, &tick, error) &&
           (tick == expected || error_set(error, "%s: is the frame of tick %" PRIu64, path, tick));
}

/* The pixels are checked before the PNG texts: if the pixels are damaged, the texts may be damaged, too. */
bool frame_check_file(const char *path, frame_origin *origin, octreel_error *error)
{
    char text[NUMBER_SIZE];
    if (!check_pixels(path, origin, error) ||
        !check_digest(path, session_keyword, origin->session, "is a frame of another session", error) ||
        !check_tick(path, origin->tick, error) ||
        !check_digest(path, scene_keyword, origin->scene,
                      "shows another scene: it was drawn with another view, or by another version of octreel", error))
        return false;
    origin->left_out = image_read_text(path, left_out_keyword, text, sizeof text) ? strtoull(text, NULL, 10) : 0;
    return true;
}

bool frame_read_tick(const char *path, uint64_t *tick, octreel_error *error)
{
    char text[NUMBER_SIZE];
    if (image_read_text(path, tick_keyword, text, sizeof text))
        return parse_tick(path, text, tick, error);
    if (image_read_text(path, scene_keyword, text, sizeof text))
        return error_set(
            error, "%s: is a picture of a single tree, drawn by octreel inspect; it has no session to replay", path);
    return error_set(error,
                     "%s: is not a frame of a recording: it has no PNG text %s; give the file as octreel record wrote "
                     "it, because other programs drop this text when they save a PNG",
                     path, tick_keyword);
}

static bool read_digest(const char *path, const char *keyword, uint64_t *digest)
{
    char text[DIGEST_TEXT];
    const bool found = image_read_text(path, keyword, text, sizeof text);
    if (found)
        *digest = strtoull(text, NULL, 16);
    return found;
}

static bool read_digest_of_frame(const char *folder, uint64_t tick, const char *keyword, uint64_t *digest)
{
    octreel_error ignored;
    char path[PATH_MAX];
    return print_frame_path(folder, tick, path, &ignored) && read_digest(path, keyword, digest);
}

bool frame_read_session_digest(const char *folder, uint64_t tick, uint64_t *session)
{
    return read_digest_of_frame(folder, tick, session_keyword, session);
}

bool frame_read_scene_digest(const char *folder, uint64_t tick, uint64_t *scene)
{
    return read_digest_of_frame(folder, tick, scene_keyword, scene);
}

bool frame_read_origin(const char *path, frame_origin *origin)
{
    char tick[NUMBER_SIZE];
    octreel_error ignored;
    *origin = (frame_origin){0};
    if (!image_read_text(path, tick_keyword, tick, sizeof tick))
        return false;
    origin->tick = strtoull(tick, NULL, 10);
    return read_digest(path, session_keyword, &origin->session) && read_digest(path, scene_keyword, &origin->scene) &&
           read_pixel_digest(path, &origin->kind, &origin->pixels, &ignored);
}

bool frame_replace_session_digest(const char *folder, uint64_t tick, uint64_t session, octreel_error *error)
{
    char text[DIGEST_TEXT], path[PATH_MAX];
    return print_frame_path(folder, tick, path, error) &&
           (image_replace_text(path, session_keyword, digest_print(session, text)) ||
            error_set(error, "%s: cannot be written", path));
}

bool frame_check_tick(const char *folder, frame_origin *origin, octreel_error *error)
{
    char path[PATH_MAX];
    return print_frame_path(folder, origin->tick, path, error) && frame_check_file(path, origin, error);
}
