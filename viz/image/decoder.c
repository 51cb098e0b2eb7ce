/* decoder.c - see decoder.h. */
#include "png_read.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

/* Bounds on what a hostile file may claim beside its pixels. */
#define LARGEST_CHUNK 8000000
#define MOST_TEXTS 1000

static void read_bytes(png_structp png, png_bytep bytes, size_t size)
{
    FILE *file = (FILE *)png_get_io_ptr(png);
    if (fread(bytes, 1, size, file) != size)
        png_error(png, ferror(file) ? strerror(errno) : "the file is cut short");
}

static void ignore_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

/* Strict, because a damaged file that looks like a picture would be compared as one: a wrong CRC of any chunk and
 * broken streams are errors. The Adler-32 within the stream, a fifth of the time, is left alone where libpng was built
 * so that it can be (Debian 12's, not 13's): the CRCs are over the same bytes. Chunks that change no pixel here (gamma,
 * profiles, texts) are skipped, with all they might unpack to. */
static void set_rules(png_structp png, png_infop info, void *file)
{
    (void)info;
    png_set_read_fn(png, file, read_bytes);
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
#ifdef PNG_IGNORE_ADLER32
    png_set_option(png, PNG_IGNORE_ADLER32, PNG_OPTION_ON);
#endif
    png_set_benign_errors(png, 0);
    png_set_chunk_malloc_max(png, LARGEST_CHUNK);
    png_set_chunk_cache_max(png, MOST_TEXTS);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    /* Who reads pixels tests the sides: libpng's own test says only "Invalid IHDR data". */
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
}

/* The function that libpng's errors jump back to; nothing in it changes between setjmp and jump. */
bool decoder_run(decoder *d, decoder_task *task, void *context)
{
    if (setjmp(png_jmpbuf(d->png)) != 0)
        return false;
    task(d->png, d->info, context);
    return true;
}

bool decoder_open(decoder *d, FILE *file, const char *name, octreel_error *error)
{
    *d = (decoder){.fault = {name, error}};
    d->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &d->fault, image_fault_raise, ignore_warning);
    d->info = d->png == NULL ? NULL : png_create_info_struct(d->png);
    if (d->info == NULL)
        return image_fault_report(&d->fault, "libpng does not start: ", strerror(ENOMEM));
    return decoder_run(d, set_rules, file);
}

void decoder_close(decoder *d)
{
    png_destroy_read_struct(&d->png, &d->info, NULL);
}

/* Opening a pipe would wait for its other end; a device may never end. */
FILE *decoder_open_file(const image_fault *fault, uint64_t *size)
{
    struct stat status;
    FILE *file = NULL;
    if (stat(fault->path, &status) != 0)
        image_fault_report(fault, "", strerror(errno));
    else if (!S_ISREG(status.st_mode))
        image_fault_report(fault, "", S_ISDIR(status.st_mode) ? strerror(EISDIR) : "it is not a regular file");
    else if ((file = fopen(fault->path, "rb")) == NULL)
        image_fault_report(fault, "", strerror(errno));
    else
        *size = (uint64_t)status.st_size;
    return file;
}
