/* same_bytes.c - see same_bytes.h. */
#include "same_bytes.h"

#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Read at a time, so that memory does not grow with the files. */
enum { PIECE = 1 << 14 };

/* Bytes that were read: fewer than asked for at the end, or -1. */
static ssize_t read_piece(int file, unsigned char piece[PIECE])
{
    size_t size = 0;
    while (size < PIECE) {
        const ssize_t more = read(file, piece + size, PIECE - size);
        if (more < 0)
            return -1;
        if (more == 0)
            break;
        size += (size_t)more;
    }
    return (ssize_t)size;
}

static bool same_content(int a, int b)
{
    unsigned char from_a[PIECE], from_b[PIECE];
    for (;;) {
        const ssize_t size = read_piece(a, from_a);
        if (size < 0 || size != read_piece(b, from_b) || memcmp(from_a, from_b, (size_t)size) != 0)
            return false;
        if (size < PIECE)
            return true;
    }
}

bool same_bytes(const char *a, const char *b)
{
    struct stat of_a, of_b;
    if (stat(a, &of_a) != 0 || stat(b, &of_b) != 0 || !S_ISREG(of_a.st_mode) || !S_ISREG(of_b.st_mode) ||
        of_a.st_size != of_b.st_size)
        return false;
    const int file_a = open(a, O_RDONLY), file_b = open(b, O_RDONLY);
    const bool same = file_a >= 0 && file_b >= 0 && same_content(file_a, file_b);
    if (file_a >= 0)
        close(file_a);
    if (file_b >= 0)
        close(file_b);
    return same;
}
