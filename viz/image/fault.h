/* fault.h - how the PNG code tells what went wrong: one sentence that names the file. Private to this folder. */
#ifndef OCTREEL_IMAGE_FAULT_H
#define OCTREEL_IMAGE_FAULT_H

#include <png.h>
#include "image.h"

/* The file being worked on and where its sentence goes; libpng hands it back as its error pointer. */
typedef struct image_fault {
    const char *path;
    octreel_error *error;
} image_fault;

/* Write "<path>: <doing><reason>" and return false. The beginning of an overlong path is left out. */
bool image_fault_report(const image_fault *fault, const char *doing, const char *reason);

/* libpng's error handler: report the message and jump back to the setjmp. */
_Noreturn void image_fault_raise(png_structp png, png_const_charp message);

#endif
