/* SPDX-License-Identifier: MIT */
/* cloud_las.c - reads the points of a LAS file, version 1.0 to 1.5. LAS is the format of laser surveys by the ASPRS.
 *
 * A binary header gives the position, number, format and length of the point records, and a scale and an offset for
 * each axis. A record begins with three integers. A coordinate is integer * scale + offset in doubles. The product and
 * the sum are each rounded once, as the specification says and as other readers do. Intensity, class and colour have
 * positions in the record that depend on the point format.
 *
 * A LAZ file is a LAS file with compressed records. This file reads its header; cloud_laz.c reads its records. */
#include "cloud_format.h"
#include "cloud_laz.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static const char signature[] = {'L', 'A', 'S', 'F'};

/* Byte offsets in the header. */
enum {
    AT_VERSION = 24, /* the offset of the major version; the minor version is the next byte */
    AT_HEADER_SIZE = 94,
    AT_POINTS = 96,
    AT_FORMAT = 104,
    AT_LENGTH = 105,
    AT_COUNT = 107,
    AT_FACTORS = 131,      /* the offset of six doubles: the scales of x, y and z, then the offsets of x, y and z */
    AT_WAVEFORMS = 227,    /* the file offset of waveform data; in the header since version 1.3 */
    AT_RECORDS = 235,      /* the file offset of extended variable length records; in the header since version 1.4 */
    AT_RECORD_COUNT = 243, /* the number of extended variable length records; in the header since version 1.4 */
    AT_WIDE_COUNT = 247,   /* the number of points as a 64-bit integer; in the header since version 1.4 */
};

/* The size of the header in bytes, by minor version. */
static const unsigned header_sizes[] = {227, 227, 227, 235, 375, 393};
enum { VERSIONS = sizeof header_sizes / sizeof header_sizes[0] };

/* The minimal size of a record in bytes, by point format. A file may have larger records. The offsets of X, Y and Z
 * in a record are the same in all point formats. */
static const unsigned record_sizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
enum {
    FORMATS = sizeof record_sizes / sizeof record_sizes[0],
    COMPRESSED = 0xc0, /* the bits of the point format that mark compressed records (LAZ) */
};

const unsigned las_colors_at[FORMATS] = {[2] = 20, [3] = 28, [5] = 28, [7] = 30, [8] = 30, [10] = 30};

typedef struct las_reader {
    cloud_file *file;
    unsigned minor, format, header_size;
    bool compressed;
    unsigned withheld;             /* the bit in a record's flags that marks the record as withheld */
    uint64_t first, length, count; /* the file offset of the first point record; the size of a record; their number */
    double factors[6];             /* the scales of x, y and z, then the offsets of x, y and z */
} las_reader;

static bool is_las(cloud_file *file)
{
    return file->size >= sizeof signature && memcmp(file->bytes, signature, sizeof signature) == 0;
}

/* ---- Header ------------------------------------------------------------------------------------------------- */

static uint64_t read_unsigned(const las_reader *reader, size_t at, unsigned size)
{
    return cloud_read_bits(size, false, reader->file->bytes + at);
}

static bool read_version(las_reader *reader)
{
    const cloud_file *file = reader->file;
    if (file->size < header_sizes[0])
        return cloud_fail_byte(file, file->size, "the file ends in its header");
    const unsigned major = file->bytes[AT_VERSION];
    reader->minor = file->bytes[AT_VERSION + 1];
    if (major != 1 || reader->minor >= VERSIONS)
        return cloud_fail_byte(file, AT_VERSION,
                               "LAS %u.%u is not a supported version of LAS; versions 1.0 to 1.%d are", major,
                               reader->minor, VERSIONS - 1);
    reader->header_size = (unsigned)read_unsigned(reader, AT_HEADER_SIZE, 2);
    if (reader->header_size < header_sizes[reader->minor])
        return cloud_fail_byte(file, AT_HEADER_SIZE,
                               "the header gives its size as %u bytes, but a header of LAS 1.%u has at least %u",
                               reader->header_size, reader->minor, header_sizes[reader->minor]);
    return file->size >= header_sizes[reader->minor] ||
           cloud_fail_byte(file, file->size, "the file ends in its header");
}

static bool read_format(las_reader *reader)
{
    const cloud_file *file = reader->file;
    reader->format = file->bytes[AT_FORMAT];
    reader->length = read_unsigned(reader, AT_LENGTH, 2);
    reader->compressed = reader->format & COMPRESSED;
    if (reader->compressed && !cloud_can_read_laz())
        return cloud_fail(file,
                          "is compressed LAS (LAZ or COPC), but this octreel was built without liblaszip; install "
                          "liblaszip-dev (Debian 13) and build again, or decompress the file: pdal translate in.laz "
                          "out.las");
    reader->format &= ~(unsigned)COMPRESSED;
    if (reader->format >= FORMATS)
        return cloud_fail_byte(file, AT_FORMAT, "%u is not a supported point format; formats 0 to %d are",
                               reader->format, FORMATS - 1);
    if (reader->length < record_sizes[reader->format])
        return cloud_fail_byte(file, AT_LENGTH,
                               "the header says that a point has %" PRIu64
                               " bytes, but points of format %u have at least %u",
                               reader->length, reader->format, record_sizes[reader->format]);
    if (reader->minor > 0) /* in LAS 1.0 the class is the whole byte; since LAS 1.1 some bits of this byte are flags */
        reader->withheld = reader->format < 6 ? 0x80 : 0x04;
    return true;
}

/* Read the number of points. Since LAS 1.4 the header has two counts of points, and one of them may be 0. If both
 * are set and differ, the file is refused: the specification and common readers disagree on which count is right. */
static bool read_count(las_reader *reader)
{
    const uint64_t narrow = read_unsigned(reader, AT_COUNT, 4);
    const uint64_t wide = reader->minor >= 4 ? read_unsigned(reader, AT_WIDE_COUNT, 8) : 0;
    reader->count = wide ? wide : narrow;
    return !narrow || reader->count == narrow ||
           cloud_fail_byte(reader->file, AT_WIDE_COUNT,
                           "the count of points is %" PRIu64 " here but %" PRIu64 " at byte %d; correct the header",
                           wide, narrow, AT_COUNT);
}

static bool read_scales_and_offsets(las_reader *reader)
{
    static const cloud_scalar real = {CLOUD_FLOAT, 8};
    for (unsigned i = 0; i < 6; i++) {
        const bool is_scale = i < 3;
        const size_t at = AT_FACTORS + 8 * i;
        const double factor = cloud_read_scalar(real, false, reader->file->bytes + at);
        if (!isfinite(factor) || (is_scale && factor == 0))
            return cloud_fail_byte(reader->file, at, "the %s of %c is %g, which gives no valid coordinates",
                                   is_scale ? "scale" : "offset", "xyz"[i % 3], factor);
        reader->factors[i] = factor;
    }
    return true;
}

/* ---- Place of the points ------------------------------------------------------------------------------------ */

/* In LAS 1.0 two signature bytes precede the points. The header should hold the offset of the points, but some
 * writers store the offset of the signature. In such a file, skip the signature. */
static void skip_signature(las_reader *reader, uint64_t left)
{
    static const unsigned char start[] = {0xdd, 0xcc};
    if (reader->minor == 0 && left >= sizeof start && (left - sizeof start) / reader->length >= reader->count &&
        memcmp(reader->file->bytes + reader->first, start, sizeof start) == 0)
        reader->first += sizeof start;
}

static bool find_points(las_reader *reader)
{
    const cloud_file *file = reader->file;
    reader->first = read_unsigned(reader, AT_POINTS, 4);
    if (reader->first < reader->header_size)
        return cloud_fail_byte(
            file, AT_HEADER_SIZE,
            "the header gives its size as %u bytes, but the points begin inside it, at byte %" PRIu64,
            reader->header_size, reader->first);
    if (reader->first > file->size)
        return cloud_fail_byte(file, AT_POINTS,
                               "the header says that the points begin at byte %" PRIu64
                               ", but the file has only %zu bytes",
                               reader->first, file->size);
    skip_signature(reader, file->size - reader->first);
    const uint64_t left = file->size - reader->first;
    return reader->count <= left / reader->length ||
           cloud_fail_byte(file, (size_t)reader->first,
                           "%" PRIu64 " points of %" PRIu64 " bytes each should follow, but the file has only %" PRIu64
                           " bytes left",
                           reader->count, reader->length, left);
}

/* A part of the file may follow the points. The header holds the start of this part at offset `at`; 0 means that the
 * part is missing. If the start is lower than *next, *next becomes the start. Returns false with an error if the start
 * is outside the bytes after the points. */
static bool update_next_part_start(const las_reader *reader, size_t at, const char *what, uint64_t *next)
{
    const uint64_t end = reader->first + reader->count * reader->length, start = read_unsigned(reader, at, 8);
    if (start == 0)
        return true;
    if (start < end || start > reader->file->size)
        return cloud_fail_byte(reader->file, at,
                               "%s begin at byte %" PRIu64 ", outside of %" PRIu64 " (the end of the points) to %zu "
                               "(the end of the file)",
                               what, start, end, reader->file->size);
    if (start < *next)
        *next = start;
    return true;
}

/* Add a note if data other than waveforms and extended variable length records follow the points. Returns false with an
 * error if the header gives an impossible start of the waveforms or of the extended records. */
static bool check_data_after_points(const las_reader *reader)
{
    static const bool has_waveforms[FORMATS] = {[4] = true, [5] = true, [9] = true, [10] = true};
    cloud_file before = *reader->file;
    uint64_t next = before.size;
    if (reader->minor >= 3 && has_waveforms[reader->format] &&
        !update_next_part_start(reader, AT_WAVEFORMS, "the waveforms", &next))
        return false;
    if (reader->minor >= 4 && read_unsigned(reader, AT_RECORD_COUNT, 4) > 0 &&
        !update_next_part_start(reader, AT_RECORDS, "the extended records", &next))
        return false;
    before.size = (size_t)next;
    cloud_note_trailing_bytes(&before, (size_t)(reader->first + reader->count * reader->length));
    return true;
}

/* ---- Points ------------------------------------------------------------------------------------------------- */

static void read_values(const las_reader *reader, const unsigned char *record, double numbers[CLOUD_CHANNELS])
{
    const unsigned color = las_colors_at[reader->format];
    for (unsigned i = 0; color && i < 3; i++)
        numbers[CLOUD_RED + i] = (double)cloud_read_bits(2, false, record + color + 2 * i);
    numbers[CLOUD_INTENSITY] = (double)cloud_read_bits(2, false, record + LAS_AT_INTENSITY);
    numbers[CLOUD_CLASS] = reader->format >= 6  ? record[LAS_AT_CLASS]
                           : reader->minor == 0 ? record[LAS_AT_FLAGS]
                                                : record[LAS_AT_FLAGS] & 0x1f;
}

/* Add the point in a record. `at` is the byte offset of the record in the file and is used for errors. */
static bool add_record(const las_reader *reader, const unsigned char *record, size_t at)
{
    static const cloud_scalar integer = {CLOUD_SIGNED, 4};
    double numbers[CLOUD_CHANNELS];
    if (record[LAS_AT_FLAGS] & reader->withheld) {
        cloud_count_skipped(reader->file, "marked as withheld");
        return true;
    }
    for (int axis = 0; axis < 3; axis++) {
        numbers[axis] = cloud_read_scalar(integer, false, record + 4 * axis) * reader->factors[axis];
        numbers[axis] += reader->factors[3 + axis];
        if (!isfinite(numbers[axis]))
            return cloud_fail_byte(reader->file, at, "%c is beyond the largest double", "xyz"[axis]);
    }
    read_values(reader, record, numbers);
    return cloud_add_point(reader->file, numbers);
}

static bool add_decompressed_record(void *context, const unsigned char *record)
{
    const las_reader *reader = context;
    return add_record(reader, record, (size_t)reader->first);
}

/* Read compressed points. The decompressor finds the place of the points by itself. A number of points that no file of
 * this size can hold is an error. The limit leaves room for extreme files: ten million equal points take 68 kB, which
 * is 147 points for each byte. */
static bool read_compressed(las_reader *reader)
{
    enum { MOST_A_BYTE = 256 };
    const cloud_file *file = reader->file;
    reader->first = read_unsigned(reader, AT_POINTS, 4);
    if (reader->count / MOST_A_BYTE > file->size)
        return cloud_fail_byte(
            file, reader->minor >= 4 ? AT_WIDE_COUNT : AT_COUNT,
            "%" PRIu64
            " compressed points should follow, but the file is too short: each of its %zu bytes holds at most %d",
            reader->count, file->size, MOST_A_BYTE);
    return laz_read_records(reader->file, reader->format, reader->count, add_decompressed_record, reader);
}

static bool read_uncompressed(las_reader *reader)
{
    if (!find_points(reader) || !check_data_after_points(reader) || !cloud_reserve(reader->file, reader->count))
        return false;
    for (uint64_t i = 0; i < reader->count; i++) {
        const size_t at = (size_t)(reader->first + i * reader->length);
        cloud_report_progress(reader->file, i, i, reader->count);
        if (!add_record(reader, reader->file->bytes + at, at))
            return false;
    }
    return true;
}

static bool parse_las(cloud_file *file)
{
    las_reader reader = {.file = file};
    if (!is_las(file))
        return cloud_fail_byte(file, 0, "is not a LAS file: its first bytes are not LASF");
    if (!read_version(&reader) || !read_format(&reader) || !read_count(&reader) || !read_scales_and_offsets(&reader))
        return false;
    file->channels = 1U << CLOUD_INTENSITY | 1U << CLOUD_CLASS | (las_colors_at[reader.format] ? CLOUD_COLOR : 0);
    cloud_select_channels(file, 255);
    if (!(reader.compressed ? read_compressed : read_uncompressed)(&reader))
        return false;
    cloud_discard_zero_values(file);
    return true;
}

const cloud_format cloud_las = {is_las, parse_las};
