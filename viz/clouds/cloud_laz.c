/* SPDX-License-Identifier: MIT */
/* cloud_laz.c - decompresses LAS records with liblaszip in a child process (laz_child.h).
 *
 * The library crashes on some damaged files (version 3.5 on truncated files). With a child process, a file that crashes
 * the library is refused like any other damaged file.
 */
#include "cloud_laz.h"

#ifdef OCTREEL_LASZIP

#include <errno.h>
#include <inttypes.h>
#include <laszip/laszip_api.h>
#include <stdio.h>
#include <string.h>

bool cloud_can_read_laz(void)
{
    return true;
}

static void write_little_endian(unsigned char *at, uint32_t number, unsigned size)
{
    for (unsigned i = 0; i < size; i++)
        at[i] = (unsigned char)(number >> 8 * i);
}

/* Writes the first LAS_RECORD_READ bytes of the uncompressed LAS record of a point. */
static void write_record(const laszip_point_struct *p, unsigned format, unsigned char record[LAS_RECORD_READ])
{
    const unsigned color = las_colors_at[format];
    write_little_endian(record, (uint32_t)p->X, 4);
    write_little_endian(record + 4, (uint32_t)p->Y, 4);
    write_little_endian(record + 8, (uint32_t)p->Z, 4);
    write_little_endian(record + LAS_AT_INTENSITY, p->intensity, 2);
    record[LAS_AT_FLAGS] =
        (unsigned char)(format >= 6 ? p->extended_classification_flags
                                    : (unsigned)p->classification | (unsigned)p->synthetic_flag << 5 |
                                          (unsigned)p->keypoint_flag << 6 | (unsigned)p->withheld_flag << 7);
    record[LAS_AT_CLASS] = p->extended_classification;
    for (unsigned i = 0; color && i < 3; i++)
        write_little_endian(record + color + 2 * i, p->rgb[i], 2);
}

/* The argument of decompress(), which runs in the child process. */
typedef struct decompression {
    char path[32]; /* the path of the compressed file */
    unsigned format;
    uint64_t count;
} decompression;

/* Writes to `why` the reason why point i cannot be decompressed. The reason contains the first line of the message of
 * liblaszip. Returns false. */
static bool write_failure_reason(const decompression *u, FILE *why, laszip_POINTER laszip, uint64_t i)
{
    laszip_CHAR *message = NULL;
    if (laszip_get_error(laszip, &message) != 0 || !message)
        message = "liblaszip gives no reason";
    fprintf(why, "point %" PRIu64 " of %" PRIu64 " cannot be decompressed (%.*s)", i + 1, u->count,
            (int)strcspn(message, "\r\n"), message);
    return false;
}

static bool decompress(void *context, FILE *records, FILE *why)
{
    const decompression *u = context;
    laszip_POINTER laszip;
    laszip_point_struct *point;
    laszip_BOOL compressed;
    unsigned char record[LAS_RECORD_READ] = {0};
    if (laszip_create(&laszip) != 0)
        return false;
    if (laszip_open_reader(laszip, u->path, &compressed) != 0 || laszip_get_point_pointer(laszip, &point) != 0)
        return write_failure_reason(u, why, laszip, 0);
    for (uint64_t i = 0; i < u->count; i++) {
        if (laszip_read_point(laszip) != 0)
            return write_failure_reason(u, why, laszip, i);
        write_record(point, u->format, record);
        if (fwrite(record, 1, sizeof record, records) != sizeof record)
            return false;
    }
    return true;
}

/* Returns the limit of the child's processor time in seconds. The limit has a wide margin: liblaszip decompresses
 * more than a million points a second. */
static unsigned find_time_limit(uint64_t count)
{
    enum { LEAST = 20, POINTS_A_SECOND = 50000, MOST = 1000000 };
    const uint64_t seconds = LEAST + count / POINTS_A_SECOND;
    return seconds < MOST ? (unsigned)seconds : MOST;
}

bool laz_read_records(const cloud_file *file, unsigned format, uint64_t count, laz_record_reader *add, void *context)
{
    decompression u = {.format = format, .count = count};
    FILE *copy = tmpfile();
    if (!copy)
        return cloud_fail(file, "cannot create a temporary file for decompression: %s", strerror(errno));
    bool done = fwrite(file->bytes, 1, file->size, copy) == file->size && fflush(copy) == 0;
    if (!done)
        cloud_fail(file, "cannot write the temporary file for decompression: %s", strerror(errno));
    snprintf(u.path, sizeof u.path, "/dev/fd/%d", fileno(copy));
    const laz_child child = {decompress, &u, find_time_limit(count)};
    done = done && laz_child_read_records(&child, file, count, add, context);
    fclose(copy);
    return done;
}

#else

bool cloud_can_read_laz(void)
{
    return false;
}

bool laz_read_records(const cloud_file *file, unsigned format, uint64_t count, laz_record_reader *add, void *context)
{
    (void)format, (void)count, (void)add, (void)context;
    return cloud_fail(file, "is compressed and cannot be read without liblaszip");
}

#endif
