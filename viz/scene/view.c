#include "view.h"
#include "layer.h"

#include <stddef.h>
#include <string.h>

#define VIEW_TEXT(name, text) text,
static const char *const camera_names[CAMERA_COUNT] = {VIEW_CAMERA_MAP(VIEW_TEXT)};
static const char *const coloring_names[COLORING_COUNT] = {VIEW_COLORING_MAP(VIEW_TEXT)};
static const char *const diagram_names[DIAGRAM_COUNT] = {VIEW_DIAGRAM_MAP(VIEW_TEXT)};
#undef VIEW_TEXT

view view_default(void)
{
    return (view){.width = VIEW_DEFAULT_WIDTH,
                  .height = VIEW_DEFAULT_HEIGHT,
                  .camera = CAMERA_ISO,
                  .layers = VIEW_DEFAULT_LAYERS,
                  .aa = 1,
                  .lod = VIEW_DEFAULT_LOD,
                  .budget = VIEW_DEFAULT_BUDGET};
}

int view_unit(const view *v)
{
    const int wide = v->width / 16 * 9;
    const int height = v->height < wide ? v->height : wide;
    return height < 640 ? 1 : (height + 180) / 360;
}

const char *view_camera_name(view_camera camera)
{
    return (unsigned)camera < CAMERA_COUNT ? camera_names[camera] : NULL;
}

const char *view_coloring_name(view_coloring coloring)
{
    return (unsigned)coloring < COLORING_COUNT ? coloring_names[coloring] : NULL;
}

const char *view_diagram_name(view_diagram diagram)
{
    return (unsigned)diagram < DIAGRAM_COUNT ? diagram_names[diagram] : NULL;
}

/* The place of a name among others, or -1. */
static int find_name(const char *name, const char *const *names, int count)
{
    for (int i = 0; i < count; i++)
        if (strcmp(name, names[i]) == 0)
            return i;
    return -1;
}

#define PARSE(type, names, count)                                                                                      \
    const int found = find_name(name, names, count);                                                                   \
    if (found >= 0)                                                                                                    \
        *value = (type)found;                                                                                          \
    return found >= 0

bool view_camera_parse(const char *name, view_camera *value)
{
    PARSE(view_camera, camera_names, CAMERA_COUNT);
}

bool view_coloring_parse(const char *name, view_coloring *value)
{
    PARSE(view_coloring, coloring_names, COLORING_COUNT);
}

bool view_diagram_parse(const char *name, view_diagram *value)
{
    PARSE(view_diagram, diagram_names, DIAGRAM_COUNT);
}
