/* SPDX-License-Identifier: MIT */
/* cloud_laz.c - compressed LAS, decompressed by liblaszip in a process of its own (laz_child.h): the library crashes at
 * some damaged files, as its version 3.5 does where a file is cut off, and such a file is to be refused like any other.
 */
#include "cloud_laz.h"

#ifdef OCTREEL_LASZIP

#include <errno.h>
#include <inttypes.h>
#include <laszip/laszip_api.h>
#include <stdio.h>
#include <string.h>

bool laz_is_read(void)
{
    return true;
}

static void put(unsigned char *at, uint32_t number, unsigned size)
{
    for (unsigned i = 0; i < size; i++)
        at[i] = (unsigned char)(number >> 8 * i);
}

static void pack(const laszip_point_struct *p, unsigned format, unsigned char record[LAS_RECORD_READ])
{
    const unsigned color = las_color_at(format);
    put(record, (uint32_t)p->X, 4);
    put(record + 4, (uint32_t)p->Y, 4);
    put(record + 8, (uint32_t)p->Z, 4);
    put(record + LAS_AT_INTENSITY, p->intensity, 2);
    record[LAS_AT_FLAGS] =
        (unsigned char)(format >= 6 ? p->extended_classification_flags
                                    : (unsigned)p->classification | (unsigned)p->synthetic_flag << 5 |
                                          (unsigned)p->keypoint_flag << 6 | (unsigned)p->withheld_flag << 7);
    record[LAS_AT_CLASS] = p->extended_classification;
    for (unsigned i = 0; color && i < 3; i++)
        put(record + color + 2 * i, p->rgb[i], 2);
}

/* Where the points are. */
typedef struct unpacking {
    char path[32];
    unsigned format;
    uint64_t count;
} unpacking;

/* The library's sentence may have lines. */
static bool fail(const unpacking *u, FILE *why, laszip_POINTER laszip, uint64_t i)
{
    laszip_CHAR *said = NULL;
    if (laszip_get_error(laszip, &said) != 0 || !said)
        said = "no reason is given";
    fprintf(why, "point %" PRIu64 " of %" PRIu64 " cannot be decompressed (%.*s)", i + 1, u->count,
            (int)strcspn(said, "\r\n"), said);
    return false;
}

static bool unpack(void *context, FILE *records, FILE *why)
{
    const unpacking *u = context;
    laszip_POINTER laszip;
    laszip_point_struct *point;
    laszip_BOOL compressed;
    unsigned char record[LAS_RECORD_READ] = {0};
    if (laszip_create(&laszip) != 0)
        return false;
    if (laszip_open_reader(laszip, u->path, &compressed) != 0 || laszip_get_point_pointer(laszip, &point) != 0)
        return fail(u, why, laszip, 0);
    for (uint64_t i = 0; i < u->count; i++) {
        if (laszip_read_point(laszip) != 0)
            return fail(u, why, laszip, i);
        pack(point, u->format, record);
        if (fwrite(record, 1, sizeof record, records) != sizeof record)
            return false;
    }
    return true;
}

/* It decompresses over a million points a second. */
static unsigned seconds_for(uint64_t count)
{
    enum { LEAST = 20, POINTS_A_SECOND = 50000, MOST = 1000000 };
    const uint64_t seconds = LEAST + count / POINTS_A_SECOND;
    return seconds < MOST ? (unsigned)seconds : MOST;
}

bool laz_read(const cloud_file *file, unsigned format, uint64_t count, laz_add *add, void *context)
{
    unpacking u = {.format = format, .count = count};
    FILE *copy = tmpfile();
    if (!copy)
        return cloud_fail(file, "a temporary file for decompression cannot be made: %s", strerror(errno));
    bool done = fwrite(file->bytes, 1, file->size, copy) == file->size && fflush(copy) == 0;
    if (!done)
        cloud_fail(file, "the temporary file for decompression cannot be written: %s", strerror(errno));
    snprintf(u.path, sizeof u.path, "/dev/fd/%d", fileno(copy));
    const laz_child child = {unpack, &u, seconds_for(count)};
    done = done && laz_child_take(&child, file, count, add, context);
    fclose(copy);
    return done;
}

#else

bool laz_is_read(void)
{
    return false;
}

bool laz_read(const cloud_file *file, unsigned format, uint64_t count, laz_add *add, void *context)
{
    (void)format, (void)count, (void)add, (void)context;
    return cloud_fail(file, "is compressed, and cannot be read");
}

#endif

bool cloud_reads_laz(void)
{
    return laz_is_read();
}
