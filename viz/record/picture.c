/* picture.c - see picture.h. */
#include "picture.h"

static image_palette theme_palette(void)
{
    image_palette palette = {.count = THEME_COLORS};
    for (int i = 0; i < THEME_COLORS; i++) {
        const theme_color color = theme_color_at((uint8_t)i);
        palette.colors[i] = (image_color){color.r, color.g, color.b};
    }
    return palette;
}

bool picture_open(picture *p, int width, int height, record_error *error)
{
    draw_error why;
    *p = (picture){.renderer = renderer_open(width, height, &why)};
    if (!p->renderer)
        return record_fail(error, "%s", why.text);
    if (!image_create(&p->frame, width, height, 1)) {
        picture_close(p);
        return record_fail(error, "there is no memory for a frame of %d x %d pixels", width, height);
    }
    p->frame.palette = theme_palette();
    return true;
}

void picture_close(picture *p)
{
    renderer_close(p->renderer);
    image_release(&p->frame);
    p->renderer = NULL;
}

bool picture_draw(picture *p, const scene *s, record_error *error)
{
    draw_error why;
    return renderer_draw(p->renderer, s, p->frame.pixels, &why) || record_fail(error, "%s", why.text);
}

bool picture_write(const picture *p, const char *path, const image_text *texts, size_t count, record_error *error)
{
    image_error why;
    return image_write_png(&p->frame, path, texts, count, &why) || record_fail(error, "%s", why.text);
}
