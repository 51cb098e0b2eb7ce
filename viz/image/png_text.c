/* png_text.c - a text of a PNG file is replaced where it stands, by one of the same length. */
#include "image.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum {
    LENGTH_SIZE = 4,
    NAME_SIZE = 4,
    CRC_SIZE = 4,
    HEAD = 4096, /* of the file: the texts that are looked for stand before the pixels */
};

/* ISO 3309, as the PNG specification has it. */
static uint32_t crc_of(const unsigned char *bytes, size_t size)
{
    uint32_t crc = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc & 1 ? UINT32_C(0xedb88320) ^ crc >> 1 : crc >> 1;
    }
    return ~crc;
}

static void put_number(unsigned char *to, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        to[i] = (unsigned char)(value >> (24 - 8 * i));
}

/* Where the name of the chunk begins that has this keyword and a text of this length; 0 when there is none. */
static size_t find_chunk(const unsigned char *head, size_t size, const char *keyword, size_t text_length)
{
    const size_t key = strlen(keyword) + 1; /* its zero ends it in the file, too */
    unsigned char wanted[LENGTH_SIZE];
    put_number(wanted, (uint32_t)(key + text_length));
    for (size_t at = 0; at + LENGTH_SIZE + NAME_SIZE + key + text_length + CRC_SIZE <= size; at++)
        if (memcmp(head + at, wanted, sizeof wanted) == 0 && memcmp(head + at + LENGTH_SIZE, "tEXt", NAME_SIZE) == 0 &&
            memcmp(head + at + LENGTH_SIZE + NAME_SIZE, keyword, key) == 0)
            return at + LENGTH_SIZE;
    return 0;
}

/* Text and check sum stand side by side, in the file's first page: one write, which nothing tears. */
static bool replace(FILE *file, const char *keyword, const char *text)
{
    unsigned char head[HEAD];
    const size_t key = strlen(keyword) + 1, length = strlen(text), size = fread(head, 1, sizeof head, file);
    const size_t name = find_chunk(head, size, keyword, length);
    if (name == 0)
        return false;
    unsigned char *value = head + name + NAME_SIZE + key;
    memcpy(value, text, length);
    put_number(value + length, crc_of(head + name, NAME_SIZE + key + length));
    return fseek(file, (long)(value - head), SEEK_SET) == 0 &&
           fwrite(value, 1, length + CRC_SIZE, file) == length + CRC_SIZE;
}

bool image_replace_text(const char *path, const char *keyword, const char *text)
{
    FILE *file = fopen(path, "r+b");
    if (!file)
        return false;
    const bool replaced = replace(file, keyword, text);
    return fclose(file) == 0 && replaced;
}
