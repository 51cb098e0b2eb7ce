/* pick.c - see pick.h. */
#include "pick.h"
#include "frame_file.h"
#include "replay.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- The frame and its recording ---------------------------------------------------------------------------- */

/* The folder that a file is in; owned by the caller, null when there is no memory. */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    const size_t length = slash == path ? 1 : slash ? (size_t)(slash - path) : 1;
    char *folder = malloc(length + 1);
    if (folder) {
        memcpy(folder, slash ? path : ".", length);
        folder[length] = '\0';
    }
    return folder;
}

/* Read the picture, and look whether it has the pixel that is asked for. */
static bool read_picture(pick *p, image *frame, octreel_error *error)
{
    octreel_error unread;
    if (!image_read_png(p->path, frame, &unread))
        return error_set(error, "%s", unread.text);
    p->width = frame->width;
    p->height = frame->height;
    return (p->asked[0] >= 0 && p->asked[1] >= 0 && p->asked[0] < p->width && p->asked[1] < p->height) ||
           error_set(error, "%s: pixel (%d, %d) is outside the picture, which has %d x %d pixels", p->path, p->asked[0],
                     p->asked[1], p->width, p->height);
}

static bool check_beside(const pick *p, const char *folder, octreel_error *error)
{
    static const char *const needed[] = {"recording.json", "session.json"};
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++) {
        char *path = path_join(folder, needed[i]);
        const bool there = path && access(path, F_OK) == 0;
        free(path);
        if (!there)
            return error_set(error, "%s: there is no recording beside it: its folder has no %s", p->path, needed[i]);
    }
    return true;
}

/* Play to the frame's tick and make its scene, which must be the one that the frame is of. */
static bool remake(pick *p, replay *r, const char *folder, octreel_error *error)
{
    if (!replay_open(r, folder, error))
        return false;
    if (p->tick >= r->ticks)
        return error_set(error, "%s: is of tick %" PRIu64 ", and the session beside it ends with tick %" PRIu64,
                         p->path, p->tick, r->ticks - 1);
    if (!replay_to(r, p->tick, error) || !replay_scene(r, error))
        return false;
    frame_origin origin = {.tick = p->tick, .session = r->session_digest, .scene = scene_digest(&r->take.scene)};
    return frame_check_file(p->path, &origin, error);
}

/* ---- The pixel ---------------------------------------------------------------------------------------------- */

/* Whether anything is drawn at one of the samples of a pixel. */
static bool is_drawn(const uint32_t *numbers, size_t samples, size_t width, int x, int y)
{
    bool drawn = false;
    for (size_t i = 0; i < samples * samples; i++)
        drawn |=
            numbers[((size_t)y * samples + i / samples) * width * samples + (size_t)x * samples + i % samples] != 0;
    return drawn;
}

static int clamp(int value, int low, int high)
{
    return value < low ? low : value > high ? high : value;
}

/* The nearest pixel with something on it: of several as near, the first one in the order of rows. */
static void find_nearest(pick *p, const uint32_t *numbers, size_t samples)
{
    const int left = clamp(p->asked[0] - p->radius, 0, p->width), top = clamp(p->asked[1] - p->radius, 0, p->height);
    const int right = clamp(p->asked[0] + p->radius + 1, 0, p->width);
    const int bottom = clamp(p->asked[1] + p->radius + 1, 0, p->height);
    int64_t best = (int64_t)p->radius * p->radius + 1;
    for (int y = top; y < bottom; y++) {
        for (int x = left; x < right; x++) {
            const int64_t dx = x - p->asked[0], dy = y - p->asked[1], square = dx * dx + dy * dy;
            if (square >= best || !is_drawn(numbers, samples, (size_t)p->width, x, y))
                continue;
            best = square;
            p->pixel[0] = x;
            p->pixel[1] = y;
        }
    }
}

static bool seek_nearest(pick *p, renderer *r, const scene *s, octreel_error *error)
{
    const size_t samples = (size_t)view_samples(&s->view);
    octreel_error why;
    uint32_t *numbers = malloc((size_t)p->width * (size_t)p->height * samples * samples * sizeof *numbers);
    bool ok = numbers || error_set(error, "there is no memory for a frame");
    ok = ok && (renderer_pick(r, s, numbers, &why) || error_set(error, "%s", why.text));
    if (ok)
        find_nearest(p, numbers, samples);
    free(numbers);
    return ok;
}

static bool name_elements(pick *p, renderer *r, const replay *from, octreel_error *error)
{
    const scene *s = &from->take.scene;
    draw_touches touches = {0};
    octreel_error why;
    bool ok = renderer_pixel(r, s, p->pixel[0], p->pixel[1], &touches, &why) || error_set(error, "%s", why.text);
    p->elements = ok && touches.count ? calloc(touches.count, sizeof *p->elements) : NULL;
    ok = ok && (p->elements || touches.count == 0 || error_set(error, "there is no memory for what is there"));
    for (size_t i = 0; ok && i < touches.count; i++) {
        const draw_element element = draw_element_of(s, touches.items[i].number);
        p->elements[p->count++] = (pick_element){
            .touch = touches.items[i],
            .kind = element.kind,
            .layer = element_layer(s, element),
            .subject = element_words(from->take.game, &from->take.heat, s, element),
        };
    }
    draw_touches_release(&touches);
    return ok;
}

static bool look(pick *p, replay *from, const pick_options *options, octreel_error *error)
{
    const int samples = view_samples(&from->take.view);
    renderer *r = replay_renderer(from, &options->renderer, error);
    p->samples = samples * samples;
    if (!r || !name_elements(p, r, from, error))
        return false;
    if (p->count || p->radius == 0)
        return true;
    return seek_nearest(p, r, &from->take.scene, error) && name_elements(p, r, from, error);
}

bool pick_frame(const char *path, const pick_options *options, pick *found, octreel_error *error)
{
    *found = (pick){.path = malloc(strlen(path) + 1),
                    .asked = {options->x, options->y},
                    .pixel = {options->x, options->y},
                    .radius = options->radius};
    replay r = {.ticks = 0};
    image frame = {0};
    char *folder = folder_of(path);
    bool ok = (found->path && folder) || error_no_memory(error);
    if (found->path)
        strcpy(found->path, path);
    ok = ok && read_picture(found, &frame, error) && frame_read_tick(path, &found->tick, error) &&
         check_beside(found, folder, error) && remake(found, &r, folder, error) && look(found, &r, options, error);
    if (ok)
        found->color = image_color_at(&frame, found->pixel[0], found->pixel[1]);
    replay_close(&r);
    image_release(&frame);
    free(folder);
    if (!ok)
        pick_release(found);
    return ok;
}

void pick_release(pick *p)
{
    free(p->path);
    free(p->elements);
    *p = (pick){0};
}
