/* json_place.h - a place in a JSON text, such as points[3].velocity: its name, and where it begins in the text.
 *
 * A parser gives values without their lines; an error about a value needs its line.
 */
#ifndef RECORD_JSON_PLACE_H
#define RECORD_JSON_PLACE_H

#include <stddef.h>

/* A member of an object or an element of an array, in the place above it. The text's own value is the null place. */
typedef struct json_place {
    const struct json_place *parent;
    const char *member; /* null: the element at index */
    size_t index;
} json_place;

/* Write "points[3].velocity", cut where it does not fit; nothing for the null place. Returns `text`. */
const char *json_place_format(const json_place *place, char *text, size_t size);

/* Where the value at a place begins in a JSON text that a parser has accepted; where there is none (a member that is
 * missing, or spelt with escapes), where the nearest place above it begins. Cost: O(size). */
const char *json_place_find(const json_place *place, const char *text, const char *limit);

#endif
