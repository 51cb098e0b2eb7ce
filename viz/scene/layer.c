/* SPDX-License-Identifier: MIT */
/* layer.c - the table of layers, and parsing of lists such as "default,-text". */
#include "layer.h"

#include <string.h>

#define LAYER_ROW(layer, name, words, help, role, fades, shown) {name, words, help, role, fades},
const layer_row layer_rows[LAYER_ALL] = {LAYER_MAP(LAYER_ROW)};

/* Find the layer bits of a name, given by its start and length. Returns false if the name is unknown. */
static bool find_layer_bits(const char *name, size_t length, unsigned *bits)
{
    static const struct {
        const char *name;
        unsigned bits;
    } choices[] = {
#define LAYER_CHOICE(layer, name, ...) {name, 1u << LAYER_##layer},
        LAYER_MAP(LAYER_CHOICE){"all", VIEW_ALL_LAYERS}, {"default", VIEW_DEFAULT_LAYERS}, {"none", 0}};
    for (size_t i = 0; i < sizeof choices / sizeof choices[0]; i++) {
        *bits = choices[i].bits;
        if ((i < LAYER_COUNT || i >= LAYER_ALL) && strlen(choices[i].name) == length &&
            strncmp(name, choices[i].name, length) == 0)
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
        if (!find_layer_bits(at, length, &bits))
            return false;
        result = without ? result & ~bits : result | bits;
        at += length;
        if (*at == 0)
            break;
    }
    *layers = result;
    return true;
}
