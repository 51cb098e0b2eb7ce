/* cloud_scalar.c - numbers in binary data, of either byte order. */
#include "cloud_format.h"

#include <string.h>

static uint64_t read_bits(unsigned size, bool big_endian, const unsigned char *bytes)
{
    uint64_t bits = 0;
    for (unsigned i = 0; i < size; i++)
        bits = bits << 8 | bytes[big_endian ? i : size - 1 - i];
    return bits;
}

static double float_of_bits(unsigned size, uint64_t bits)
{
    if (size == 8) {
        double wide;
        memcpy(&wide, &bits, sizeof wide);
        return wide;
    }
    uint32_t low = (uint32_t)bits;
    float narrow;
    memcpy(&narrow, &low, sizeof narrow);
    return (double)narrow;
}

/* Two's complement: the sign bit counts as minus its value. */
static double signed_of_bits(unsigned size, uint64_t bits)
{
    uint64_t sign = UINT64_C(1) << (8 * size - 1);
    uint64_t low = bits & (sign - 1);
    return bits & sign ? -(double)(sign - low) : (double)low;
}

double cloud_scalar_read(cloud_scalar type, bool big_endian, const unsigned char *bytes)
{
    uint64_t bits = read_bits(type.size, big_endian, bytes);
    switch (type.kind) {
    case CLOUD_FLOAT:
        return float_of_bits(type.size, bits);
    case CLOUD_SIGNED:
        return signed_of_bits(type.size, bits);
    case CLOUD_UNSIGNED:
        break;
    }
    return (double)bits;
}

bool cloud_check_padding(const cloud_file *file, size_t offset)
{
    for (size_t i = offset; i < file->size; i++)
        if (file->bytes[i] != 0)
            return cloud_fail_byte(file, i, "more data follows than the header counts");
    return true;
}
