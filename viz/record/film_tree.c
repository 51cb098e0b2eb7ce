/* film_tree.c - one tree as one picture; see film.h. */
#include "film.h"
#include "frame_file.h"
#include "picture.h"
#include "tick_scene.h"
#include "ticks_write.h"
#include "image_digest.h"

static bool write_picture(const picture *p, const scene *s, const char *path, octreel_error *error)
{
    char digests[2][DIGEST_TEXT];
    const image_text texts[] = {
        {FRAME_SCENE_KEYWORD, digest_print(scene_digest(s), digests[0])},
        {FRAME_PIXELS_KEYWORD, digest_print(image_digest(&p->frame), digests[1])},
    };
    return picture_write(p, path, texts, sizeof texts / sizeof texts[0], error);
}

bool film_tree(const octree *tree, const tree_subject *about, const film_options *options, const char *path,
               film_summary *summary, octreel_error *error)
{
    picture p;
    scene s = {0};
    view v = options->view;
    *summary = (film_summary){0};
    if (!picture_fit(&v, tree, error) || !picture_open(&p, &v, &options->renderer, error))
        return false;
    bool ok = tree_scene_build(&s, &v, tree, about) || error_set(error, "there is no memory for a scene");
    ok = ok && picture_draw(&p, &s, error) && write_picture(&p, &s, path, error);
    if (ok)
        *summary = (film_summary){
            .frames = 1, .left_out = renderer_left_out(p.renderer), .over_budget = s.tally.beyond || s.tally.thinned};
    scene_release(&s);
    picture_close(&p);
    return ok;
}
