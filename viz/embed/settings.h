/* settings.h - the definition of a recorder, checked and copied. Private to this folder. */
#ifndef EMBED_SETTINGS_H
#define EMBED_SETTINGS_H

#include "film.h"
#include "octreel/recorder.h"

typedef struct settings {
    octree_def tree; /* as a tree of it has it in force */
    octree_player player;
    film_options film; /* without a folder */
} settings;

/* Errors: NULL_ARGUMENT, BAD_OPTION, BAD_ID, with the sentence. */
octreel_status settings_make(settings *s, const octreel_recorder_def *def, octreel_error *error);

/* Whether a tree has the world and the options that were settled on; null has any. */
bool settings_fit(const settings *s, const octree *tree);

#endif
