/* SPDX-License-Identifier: MIT */
/* cloud_laz.c - compressed LAS, decompressed by liblaszip in a process of its own: the library crashes at some damaged
 * files, as its version 3.5 does where a file is cut off, and such a file is to be refused like any other. */
#include "cloud_laz.h"

#ifdef OCTREEL_LASZIP

#include <errno.h>
#include <inttypes.h>
#include <laszip/laszip_api.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

bool laz_is_read(void)
{
    return true;
}

/* ---- The process that decompresses -------------------------------------------------------------------------- */

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

/* Where the points are, and where their records and the sentence of an error go. */
typedef struct unpacking {
    char path[32];
    unsigned format;
    uint64_t count;
    FILE *records, *why;
} unpacking;

/* The library's sentence may have lines. */
static bool fail(const unpacking *u, laszip_POINTER laszip, uint64_t i)
{
    laszip_CHAR *why = NULL;
    if (laszip_get_error(laszip, &why) != 0 || !why)
        why = "no reason is given";
    fprintf(u->why, "point %" PRIu64 " of %" PRIu64 " cannot be decompressed (%.*s)", i + 1, u->count,
            (int)strcspn(why, "\r\n"), why);
    return false;
}

static bool unpack(const unpacking *u)
{
    laszip_POINTER laszip;
    laszip_point_struct *point;
    laszip_BOOL compressed;
    unsigned char record[LAS_RECORD_READ] = {0};
    if (laszip_create(&laszip) != 0)
        return false;
    if (laszip_open_reader(laszip, u->path, &compressed) != 0 || laszip_get_point_pointer(laszip, &point) != 0)
        return fail(u, laszip, 0);
    for (uint64_t i = 0; i < u->count; i++) {
        if (laszip_read_point(laszip) != 0)
            return fail(u, laszip, i);
        pack(point, u->format, record);
        if (fwrite(record, 1, sizeof record, u->records) != sizeof record)
            return false;
    }
    return fflush(u->records) == 0;
}

/* Crashes end it in silence. What is open is closed by the system. */
static _Noreturn void run(unpacking *u, int records, int why)
{
    static const int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPIPE};
    for (size_t i = 0; i < sizeof crashes / sizeof crashes[0]; i++)
        signal(crashes[i], SIG_DFL);
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    u->records = fdopen(records, "wb");
    u->why = fdopen(why, "wb");
    const bool done = u->records && u->why && unpack(u);
    if (u->why)
        fflush(u->why);
    _exit(done ? 0 : 1);
}

/* ---- This process ------------------------------------------------------------------------------------------- */

/* Take the records that come. False where they are too few, or where `add` fails, with its error. */
static bool take_records(const cloud_file *file, FILE *records, uint64_t count, laz_add *add, void *context, bool *few)
{
    unsigned char record[LAS_RECORD_READ];
    for (uint64_t i = 0; i < count; i++) {
        cloud_tell(file, i, i, count);
        *few = fread(record, 1, sizeof record, records) != sizeof record;
        if (*few || !add(context, record))
            return false;
    }
    return true;
}

static bool fail_few(const cloud_file *file, int why, int status)
{
    char text[256];
    const ssize_t size = read(why, text, sizeof text);
    if (size > 0)
        return cloud_fail(file, "%.*s", (int)size, text);
    return cloud_fail(file, "cannot be decompressed: liblaszip %s at its data",
                      WIFSIGNALED(status) ? "crashed" : "broke off");
}

static bool take_all(const cloud_file *file, pid_t child, int from, int why, uint64_t count, laz_add *add,
                     void *context)
{
    FILE *records = fdopen(from, "rb");
    bool few = false;
    int status = 0;
    const bool done = records ? take_records(file, records, count, add, context, &few)
                              : cloud_fail(file, "the decompressed points cannot be read: %s", strerror(errno));
    if (records)
        fclose(records);
    else
        close(from);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    return few ? fail_few(file, why, status) : done;
}

static bool read_through_child(const cloud_file *file, unpacking *u, laz_add *add, void *context)
{
    int records[2], why[2];
    if (pipe(records) != 0)
        return cloud_fail(file, "a pipe for decompression cannot be made: %s", strerror(errno));
    if (pipe(why) != 0) {
        close(records[0]);
        close(records[1]);
        return cloud_fail(file, "a pipe for decompression cannot be made: %s", strerror(errno));
    }
    const pid_t child = fork();
    if (child == 0)
        run(u, records[1], why[1]);
    close(records[1]);
    close(why[1]);
    bool done = false;
    if (child > 0) {
        done = take_all(file, child, records[0], why[0], u->count, add, context);
    } else {
        cloud_fail(file, "a process for decompression cannot be started: %s", strerror(errno));
        close(records[0]);
    }
    close(why[0]);
    return done;
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
    done = done && read_through_child(file, &u, add, context);
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
