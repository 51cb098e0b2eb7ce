/* film_commands.h - what ffmpeg makes of a recording: lines to paste into a shell. */
#ifndef RECORD_FILM_COMMANDS_H
#define RECORD_FILM_COMMANDS_H

#include "film.h"

#include <stdio.h>

/* A film, an animated PNG and a contact sheet of these many frames, beside the folder. Each name stands on a line of
 * its own, set in by two blanks, and the command behind it on the next, set in by four. */
void film_commands(FILE *out, const film_options *options, uint64_t frames);

#endif
