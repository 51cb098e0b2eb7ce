/* SPDX-License-Identifier: MIT */
/* color_table.c - a hash table of colours with open addressing. */
#include "color_table.h"

static uint32_t make_key(const uint8_t *rgb)
{
    return 1u << 24 | (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2];
}

/* Returns the slot of a colour, or the free slot in which it belongs. At most 256 of the slots are in use, so the
 * search ends. */
static size_t find_slot(const color_table *table, uint32_t key)
{
    size_t slot = key * UINT32_C(0x9e3779b1) >> 22;
    while (table->keys[slot] != 0 && table->keys[slot] != key)
        slot = (slot + 1) % COLOR_SLOTS;
    return slot;
}

static void add_color(color_table *table, const uint8_t *rgb)
{
    image_palette *palette = &table->palette;
    const uint32_t key = make_key(rgb);
    const size_t slot = find_slot(table, key);
    if (table->keys[slot] != 0)
        return;
    table->is_full = palette->count == 256;
    if (table->is_full)
        return;
    table->keys[slot] = key;
    table->indices[slot] = (uint8_t)palette->count;
    palette->colors[palette->count++] = (image_color){rgb[0], rgb[1], rgb[2]};
}

/* Returns whether pixel i has the colour of the pixel before. Neighbouring pixels mostly do, so only the others are
 * looked up in the table. */
static bool repeats_pixel_before(const uint8_t *rgb, size_t i)
{
    return i > 0 && memcmp(rgb + 3 * i, rgb + 3 * i - 3, 3) == 0;
}

void color_table_add(color_table *table, const uint8_t *rgb, size_t count)
{
    for (size_t i = 0; i < count && !table->is_full; i++)
        if (!repeats_pixel_before(rgb, i))
            add_color(table, rgb + 3 * i);
}

void color_table_find(const color_table *table, const uint8_t *rgb, size_t count, uint8_t *indices)
{
    for (size_t i = 0; i < count; i++)
        indices[i] =
            repeats_pixel_before(rgb, i) ? indices[i - 1] : table->indices[find_slot(table, make_key(rgb + 3 * i))];
}
