/* view.c - see view.h. */
#include "view.h"

#include <stddef.h>
#include <string.h>

#define VIEW_TEXT(name, text) text,
static const char *const camera_names[CAMERA_COUNT] = {VIEW_CAMERA_MAP(VIEW_TEXT)};
static const char *const coloring_names[COLORING_COUNT] = {VIEW_COLORING_MAP(VIEW_TEXT)};
static const char *const diagram_names[DIAGRAM_COUNT] = {VIEW_DIAGRAM_MAP(VIEW_TEXT)};
#undef VIEW_TEXT

#define VIEW_LAYER_NAME(name, text, ...) text,
#define VIEW_LAYER_WORDS(name, text, words, ...) words,
static const char *const layer_names[LAYER_COUNT] = {VIEW_LAYER_MAP(VIEW_LAYER_NAME)};
static const char *const layer_words[LAYER_COUNT] = {VIEW_LAYER_MAP(VIEW_LAYER_WORDS)};
#undef VIEW_LAYER_NAME
#undef VIEW_LAYER_WORDS

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

const char *view_layer_name(view_layer layer)
{
    if (layer == LAYER_DIAGRAM)
        return "diagram";
    return (unsigned)layer < LAYER_COUNT ? layer_names[layer] : NULL;
}

const char *view_layer_words(view_layer layer)
{
    if (layer == LAYER_DIAGRAM)
        return "the diagram";
    return (unsigned)layer < LAYER_COUNT ? layer_words[layer] : NULL;
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

bool view_camera_parse(const char *name, view_camera *camera)
{
    const int found = find_name(name, camera_names, CAMERA_COUNT);
    if (found >= 0)
        *camera = (view_camera)found;
    return found >= 0;
}

bool view_coloring_parse(const char *name, view_coloring *coloring)
{
    const int found = find_name(name, coloring_names, COLORING_COUNT);
    if (found >= 0)
        *coloring = (view_coloring)found;
    return found >= 0;
}

bool view_diagram_parse(const char *name, view_diagram *diagram)
{
    const int found = find_name(name, diagram_names, DIAGRAM_COUNT);
    if (found >= 0)
        *diagram = (view_diagram)found;
    return found >= 0;
}

static bool is_word(const char *name, size_t length, const char *word)
{
    return strlen(word) == length && strncmp(name, word, length) == 0;
}

/* The bits that a name of this length stands for; false when it is unknown. */
static bool find_layers(const char *name, size_t length, unsigned *bits)
{
    static const struct {
        const char *name;
        unsigned bits;
    } sets[] = {{"all", VIEW_ALL_LAYERS}, {"default", VIEW_DEFAULT_LAYERS}, {"none", 0}};
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        *bits = sets[i].bits;
        if (is_word(name, length, sets[i].name))
            return true;
    }
    for (int i = 0; i < LAYER_COUNT; i++) {
        *bits = 1u << i;
        if (is_word(name, length, layer_names[i]))
            return true;
    }
    return false;
}

bool view_layers_parse(const char *list, unsigned *layers, const char **bad)
{
    unsigned result = list[0] == '-' ? VIEW_DEFAULT_LAYERS : 0;
    for (const char *at = list;; at++) {
        const bool without = *at == '-';
        *bad = at;
        at += without;
        const size_t length = strcspn(at, ",");
        unsigned bits;
        if (!find_layers(at, length, &bits))
            return false;
        result = without ? result & ~bits : result | bits;
        at += length;
        if (*at == 0)
            break;
    }
    *layers = result;
    return true;
}
