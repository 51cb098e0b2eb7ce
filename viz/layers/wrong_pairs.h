/* SPDX-License-Identifier: MIT */
/* wrong_pairs.h - draws and describes the wrong pairs of a foreign index, for the layer of wrong answers. */
#ifndef LAYERS_WRONG_PAIRS_H
#define LAYERS_WRONG_PAIRS_H

#include "layer_type.h"

/* The element ids of wrong pairs have bit 63 set and bit 62 clear. No other element of the layer has such an id: the
 * ids of points and answers are small, and those of rings and foreign nodes have bit 62 set. */
static inline bool is_pair_element(uint64_t id)
{
    return id >> 62 == 2;
}

/* Return whether the tick has wrong pairs. */
bool has_wrong_pairs(const layer_source *in);

/* mark_wrong_pairs() adds a line between the two bodies of each missing and each extra pair, with a marker of half the
 * size `mark` where the boxes overlap or, if they do not, between the boxes; and one ring of half the size `ring`
 * around the first wrong pair. label_wrong_pairs() writes the error beside the ring, and returns false if there is no
 * room. `occupied` is the part of the picture that markers and texts already cover. */
void mark_wrong_pairs(scene *s, const layer_source *in, unsigned mark, unsigned ring, text_space *occupied);
bool label_wrong_pairs(scene *s, const layer_source *in, unsigned ring, text_space *occupied);

/* Return whether mark_wrong_pairs() adds a ring: not if no body of a wrong pair exists. */
bool has_ring_of_pairs(const layer_source *in);

/* Add the lines of the legend that explain the markers. */
void add_wrong_pairs_legend(legend *l, const layer_source *in);

/* Describe an element that mark_wrong_pairs() or label_wrong_pairs() added. */
void describe_wrong_pair(description *d, const described_element *element);

#endif
