/* decoder.h - libpng while it reads a file: the strict rules, and errors as sentences. Private to this folder. */
#ifndef OCTREEL_IMAGE_DECODER_H
#define OCTREEL_IMAGE_DECODER_H

#include "fault.h"

/* Its address is libpng's error pointer: it stays where it was opened. */
typedef struct decoder {
    image_fault fault;
    png_structp png;
    png_infop info;
} decoder;

/* A step of the reading, between setjmp and the clean-up: png_error() ends it. */
typedef void decoder_task(png_structp png, png_infop info, void *context);

/* Open a regular file. Null, with a sentence, where there is none. */
FILE *decoder_open_file(const image_fault *fault, uint64_t *size);

/* Begin with a stream at its start; name, the path in sentences, and error must outlive the decoder. False, with a
 * sentence, without memory; closed is it in any case. */
bool decoder_open(decoder *d, FILE *file, const char *name, octreel_error *error);
void decoder_close(decoder *d);

/* Do a step. False, with a sentence, when it fails: nothing but closing is allowed then. */
bool decoder_run(decoder *d, decoder_task *task, void *context);

#endif
